// Every made cell file is read, describes the arm of its row, marks what is assumed, and has a table that the arm
// reaches.

#include "cam/cell/new_cell/new_cell.h"

#include <gtest/gtest.h>

#include <map>

#include "base/units.h"
#include "cam/cell/cell_check.h"
#include "cam/cell/new_cell/new_cell_tools.h"
#include "cam/cell/new_cell/straight_down_box.h"

namespace qchopper {
namespace {

// Made once, because the search for the table's place takes a while.
const Cell& made_cell(const KnownArm& arm) {
    static std::map<std::string_view, Cell> cells;
    const auto found = cells.find(arm.id);
    if (found != cells.end()) return found->second;
    return cells[arm.id] = parse_cell(new_cell_text(arm, {std::string(arm.id), 7}), std::string(arm.id) + ".toml");
}

TEST(NewCell, OfEveryArmIsReadAndDescribesIt) {
    for (const KnownArm& arm : known_arms()) {
        const Cell& cell = made_cell(arm);
        EXPECT_EQ(cell.name, arm.id);
        EXPECT_EQ(cell.id, 7);
        ASSERT_TRUE(cell.machine && cell.machine->robot) << arm.id;
        const Robot& robot = *cell.machine->robot;
        EXPECT_EQ(robot.name, arm.name);
        const Joints joints = comparison_joints(geometry_of(arm))[3];
        EXPECT_LT(norm(forward(robot.geometry, joints).shift - forward(geometry_of(arm), joints).shift), 1e-9)
            << arm.id;
        for (std::size_t axis = 0; axis < axes_of_arm; ++axis) {
            EXPECT_NEAR(robot.ranges[axis].min, ranges_of(arm)[axis].min, 1e-12) << arm.id;
            EXPECT_NEAR(robot.ranges[axis].max, ranges_of(arm)[axis].max, 1e-12) << arm.id;
            EXPECT_NEAR(robot.ranges[axis].speed, ranges_of(arm)[axis].speed, 1e-12) << arm.id;
        }
        EXPECT_EQ(robot.base_in_cell.shift.z, arm.base_height);
        EXPECT_EQ(to_word(cell.machine->program.dialect), maker_of(arm).dialect);
    }
}

// Nothing that nobody measured on the cell may pass for certain.
TEST(NewCell, MarksWhatIsAssumed) {
    const Cell& cell = made_cell(known_arm("kr210-r2700"));
    const CellCheck check = check_cell(cell);
    EXPECT_FALSE(check.may_be_dispatched());
    EXPECT_TRUE(check.missing.empty()) << check.missing[0];
    for (const ValueOrigin& value : cell.origins) {
        if (value.origin == Origin::by_default) continue;  // not in the file
        const bool is_of_the_arm = value.table == "robot" && value.key != "acceleration_deg_per_s2";
        EXPECT_EQ(value.origin, is_of_the_arm ? Origin::data_sheet : Origin::assumed)
            << value.table << "." << value.key;
    }
    for (const ValueOrigin& value : made_cell(known_arm("m20ia")).origins) {
        if (value.table == "robot" && value.key == "max_deg") {
            EXPECT_EQ(value.origin, Origin::assumed);
        }
    }
}

TEST(NewCell, TheArmHoldsTheToolOverTheWholeTable) {
    for (const KnownArm& arm : known_arms()) {
        const Cell& cell = made_cell(arm);
        const CellMachine& machine = *cell.machine;
        const double tool = machine.spindle.spindle_in_flange.shift.z + gauge_length(machine.tools[0]);
        const Vec3 size = cell.workspace.size();
        EXPECT_GE(size.x, 150) << arm.id;
        for (const double x : {0.0, 0.3, 1.0}) {
            for (const double y : {0.0, 0.6, 1.0}) {
                for (const double z : {0.0, 1.0}) {
                    const Vec3 tip = cell.workspace.min + Vec3{x * size.x, y * size.y, z * size.z};
                    Pose flange{{Vec3{1, 0, 0}, Vec3{0, -1, 0}, Vec3{0, 0, -1}}, tip + Vec3{0, 0, tool}};
                    flange = inverse(machine.robot->base_in_cell) * flange;
                    EXPECT_FALSE(inverse_within(machine.robot->geometry, machine.robot->ranges, 0, flange).empty())
                        << arm.id;
                }
            }
        }
        const Stock& block = cell.stock[0];
        EXPECT_LE(block.size.x, cell.table.size_x) << arm.id;
        EXPECT_LE(block.size.z + cell.table.height + cell.clearance, cell.workspace.max.z) << arm.id;
    }
}

// A small box gets a block of its own size, a large one all blocks of the ready cells.
TEST(NewCell, BlocksAndToolsFollowTheArm) {
    EXPECT_NE(new_stock_text({1200, 1200, 800}).find("[1000.0, 600.0, 500.0]"), std::string::npos);
    EXPECT_EQ(new_stock_text({1000, 1000, 800}).find("[1000.0, 600.0, 500.0]"), std::string::npos);
    EXPECT_NE(new_stock_text({250, 260, 180}).find("[150.0, 150.0, 120.0]"), std::string::npos);
    EXPECT_NE(new_tools_text(false).find("long"), std::string::npos);
    EXPECT_EQ(new_tools_text(true).find("long"), std::string::npos);
}

TEST(NewCell, NoBoxWhereTheToolIsLongerThanTheArm) {
    const KnownArm& arm = known_arm("kr10-r1100-2");
    EXPECT_FALSE(straight_down_box({geometry_of(arm), ranges_of(arm), {}, 3000, 200}));
}

}  // namespace
}  // namespace qchopper
