// Version 2 of the cell file: what is read, what is refused and where, and the ready cells. Sawn stock:
// sawn_stock_test.cpp.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "cam/cell/cell.h"
#include "cam/cell/cell_check.h"
#include "tests/cam/cell/ready_cells.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;

constexpr double degree = std::numbers::pi / 180;

TEST(CellVersion2, EveryFileOfTheFolderIsACell) {
    int files = 0;
    for (const auto& entry : fs::directory_iterator(cells)) {
        const Cell cell = read_cell(entry.path());
        EXPECT_EQ(cell.name, entry.path().stem().string());
        EXPECT_EQ(cell.machine.has_value(), cell.name != "foam-1");
        ++files;
    }
    EXPECT_EQ(files, 5);
}

TEST(CellVersion2, ARobotIsReadAsItIsWritten) {
    const Cell cell = parse_cell(robot_cell(), "shop/cell.toml");
    ASSERT_TRUE(cell.machine && cell.machine->robot);
    const CellMachine& machine = *cell.machine;
    const Robot& robot = *machine.robot;
    EXPECT_EQ(robot.name, "KUKA KR 120 R2500 pro");
    const ArmGeometry geometry{350, 41, 0, 675, 1150, 1000, 215, {0, -90 * degree, 0, 0, 0, 0}, {-1, 1, 1, -1, 1, -1}};
    EXPECT_EQ(robot.geometry, geometry);
    EXPECT_EQ(robot.ranges[1], (JointRange{-140 * degree, -5 * degree, 130 * degree, 260 * degree}));
    EXPECT_EQ(robot.payload_kg, 120);
    EXPECT_EQ(robot.base_in_cell, Pose{});
    EXPECT_EQ(robot.cable, (CableLimits{{-180 * degree, 180 * degree}, {-180 * degree, 180 * degree}}));
    ASSERT_EQ(robot.capsules.size(), 3U);
    EXPECT_EQ(robot.capsules[0], (LinkCapsule{2, {{350, 0, 675}, {350, 0, 1825}, 200}}));
    ASSERT_TRUE(machine.rotary_table);
    EXPECT_EQ(machine.rotary_table->table_in_cell.shift, (Vec3{1450, 0, 300}));
    EXPECT_EQ(machine.rotary_table->speed, 30 * degree);
    EXPECT_EQ(machine.spindle.spindle_in_flange.shift, (Vec3{0, 0, 350}));
    EXPECT_EQ(machine.spindle.on, (Signal{SignalKind::output, "1", 1}));
    EXPECT_EQ(machine.spindle.speed, (Signal{SignalKind::output, "1", 0.0000555556}));
    EXPECT_EQ(machine.spindle.at_speed, (Signal{SignalKind::input, "1", 1}));
    ASSERT_TRUE(machine.extraction);
    EXPECT_EQ(machine.extraction->off, (Signal{SignalKind::output, "2", 1}));
    EXPECT_EQ(machine.max_tilt, 60 * degree);
    EXPECT_EQ(machine.max_unreachable, 0.02);
    EXPECT_EQ(cell.margins, (Margins{5, 3, 10}));
    EXPECT_EQ(machine.holding, (Holding{20, 0.1, 4}));
    ASSERT_EQ(machine.obstacles.size(), 1U);
    EXPECT_EQ(machine.obstacles[0].box, (Box{{-600, 1800, 0}, {600, 2600, 1400}}));
    EXPECT_EQ(machine.start.joints[1], -90 * degree);
    ProgramSettings program;
    program.link_feed_mm_per_s = 300;
    EXPECT_EQ(machine.program, program);
    ASSERT_EQ(machine.tools.size(), 10U);
    CuttingTool tool;
    tool.number = 4;
    tool.name = "ball nose 6 mm";
    tool.diameter = 6;
    tool.corner_radius = 3;
    tool.flute_length = 50;
    tool.stick_out = 100;
    tool.holder = {{20, 50}, {32, 50}};
    tool.feed_min_mm_per_s = 10;
    tool.feed_max_mm_per_s = 60;
    tool.rpm_min = 12000;
    tool.rpm_max = 18000;
    tool.mass_kg = 0.9;
    tool.removal_mm3_per_s = 1500;
    EXPECT_EQ(machine.tools[3], tool);
    EXPECT_EQ(gauge_length(tool), 200);
    EXPECT_TRUE(is_drill(machine.tools[4]));
    EXPECT_EQ(machine.tools[4].diameter, 8);
    EXPECT_NEAR(point_height(machine.tools[4]), 2.4034, 1e-4);  // 4 mm / tan 59 degrees
    EXPECT_EQ(cell.stock[2], (Stock{"large", {1000, 600, 500}, Material::pu_foam, true, 3, 0.6}));
}

// What setup, jobs and simulation read of every cell.
TEST(CellVersion2, IsAlsoACellForThoseThatKnowNoRobot) {
    const Cell cell = parse_cell(robot_cell(), "shop/cell.toml");
    EXPECT_EQ(cell.tool, (Tool{1, "ball nose 20 mm", 20, 18000, 9000, 24000}));
    EXPECT_EQ(cell.stock_margin(), 5);
    EXPECT_EQ(cell.clearance, 20);
    EXPECT_EQ(cell.table.height, 300);
    // The corners of the square lie on the rim.
    EXPECT_NEAR(std::hypot(cell.table.size_x / 2, cell.table.size_y / 2), 750, 1e-9);
    EXPECT_EQ(cell.link.drop, "shop/drop");
}

TEST(CellVersion2, AGantryHasNoRobot) {
    const Cell cell = parse_cell(gantry_cell(), "cell.toml");
    ASSERT_TRUE(cell.machine);
    EXPECT_FALSE(cell.machine->robot);
    EXPECT_FALSE(cell.machine->rotary_table);
    EXPECT_EQ(cell.machine->max_tilt, 0);
    EXPECT_EQ(cell.machine->start.tip, (Vec3{100, 100, 850}));
    EXPECT_EQ(cell.machine->program.dialect, Dialect::ngc);
}

// A, B and C turn about z, then the new y, then the new x.
TEST(CellVersion2, AFrameIsReadInTheOrderOfKuka) {
    const std::string text = replaced(robot_cell(), "abc_deg = [0.0, 0.0, 0.0]", "abc_deg = [90.0, 0.0, 90.0]");
    const Pose base = parse_cell(text, "cell.toml").machine->robot->base_in_cell;
    EXPECT_NEAR(norm(rotate(base, {1, 0, 0}) - Vec3{0, 1, 0}), 0, 1e-12);
    EXPECT_NEAR(norm(rotate(base, {0, 1, 0}) - Vec3{0, 0, 1}), 0, 1e-12);
    EXPECT_NEAR(norm(rotate(base, {0, 0, 1}) - Vec3{1, 0, 0}), 0, 1e-12);
    const std::string tilted = replaced(robot_cell(), "abc_deg = [0.0, 0.0, 0.0]", "abc_deg = [0.0, 90.0, 0.0]");
    const Pose down = parse_cell(tilted, "cell.toml").machine->robot->base_in_cell;
    EXPECT_NEAR(norm(rotate(down, {1, 0, 0}) - Vec3{0, 0, -1}), 0, 1e-12);
}

TEST(CellVersion2, DefaultsAreKnownAsSuch) {
    std::string text = robot_cell();
    for (const char* line : {"max_tilt_deg = 60.0", "max_unreachable = 0.02", "lines_per_chunk = 1400", "spoil = 10.0",
                             "cutting_force = 20.0", "bending_strength = 0.6"}) {
        text = replaced(text, line, "");
    }
    const Cell cell = parse_cell(text, "cell.toml");
    const Cell whole = parse_cell(robot_cell(), "cell.toml");
    EXPECT_EQ(cell.machine->max_tilt, whole.machine->max_tilt);
    EXPECT_EQ(cell.machine->program, whole.machine->program);
    EXPECT_EQ(cell.margins, whole.margins);
    EXPECT_EQ(cell.machine->holding, whole.machine->holding);
    EXPECT_EQ(bending_strength(cell.stock[0]), 0.6);
    const std::vector<ValueOrigin>& origins = cell.origins;
    for (const ValueOrigin& value :
         {ValueOrigin{"", "max_tilt_deg", Origin::by_default}, ValueOrigin{"", "max_unreachable", Origin::by_default},
          ValueOrigin{"program", "lines_per_chunk", Origin::by_default},
          ValueOrigin{"holding", "cutting_force", Origin::by_default},
          ValueOrigin{"stock small", "bending_strength", Origin::by_default},
          ValueOrigin{"margin", "spoil", Origin::by_default}}) {
        EXPECT_NE(std::find(origins.begin(), origins.end(), value), origins.end()) << value.key;
    }
}

TEST(CellVersion2, OriginsAreThoseOfTheTableUnlessAKeyHasItsOwn) {
    const Cell cell = parse_cell(robot_cell(), "cell.toml");
    const auto origin = [&](const std::string& table, const std::string& key) {
        for (const ValueOrigin& value : cell.origins) {
            if (value.table == table && value.key == key) return std::string(to_word(value.origin));
        }
        return std::string("none");
    };
    EXPECT_EQ(origin("robot", "a1"), "data sheet");
    EXPECT_EQ(origin("robot", "min_deg"), "assumed");
    EXPECT_EQ(origin("robot.capsule 3", "radius"), "assumed");
    EXPECT_EQ(origin("tool 4", "holder"), "assumed");
    EXPECT_EQ(origin("robot", "name"), "none");
    EXPECT_EQ(origin("stock small", "kerf"), "assumed");
}

TEST(CellVersion2, CycleAndToolChangeHaveAnOrigin) {
    const auto origin = [](const std::string& text, const std::string& key) {
        for (const ValueOrigin& value : parse_cell(text, "cell.toml").origins) {
            if (value.table == "program" && value.key == key) return value.origin;
        }
        return Origin::unstated;
    };
    const std::string given =
        replaced(robot_cell(), "link_feed = 300.0", "link_feed = 300.0\ninterpolation_cycle = 0.004");
    EXPECT_EQ(origin(robot_cell(), "interpolation_cycle"), Origin::by_default);
    EXPECT_EQ(origin(robot_cell(), "tool_change_time"), Origin::by_default);
    EXPECT_EQ(origin(given, "interpolation_cycle"), Origin::assumed) << "as the table says";
}

TEST(CellVersion2, ReadsTheLimitsOfPrograms) {
    const Cell by_default = parse_cell(robot_cell(), "cell.toml");
    EXPECT_EQ(by_default.machine->program.acceleration, 2000);
    EXPECT_NEAR(by_default.machine->program.turn_speed, 100 * degree, 1e-12);
    EXPECT_EQ(by_default.machine->program.joint_share, 0.5);
    EXPECT_EQ(by_default.machine->program.scallop, 0.25);
    EXPECT_EQ(by_default.machine->program.interpolation_cycle_s, 0.012);
    EXPECT_EQ(by_default.machine->program.tool_change_s, 60);
    EXPECT_EQ(by_default.machine->load_tolerance, LoadTolerance{});
    std::string text =
        replaced(robot_cell(), "link_feed = 300.0",
                 "link_feed = 300.0\nacceleration = 1500\nturn_speed_deg_per_s = 45\n"
                 "joint_move_percent = 20\nscallop = 0.4\ninterpolation_cycle = 0.004\ntool_change_time = 0");
    text = replaced(text, "[margin]", "[load_tolerance]\nmass_kg = 1\ncentre_mm = 5\ninertia_kg_m2 = 0.2\n[margin]");
    const CellMachine machine = *parse_cell(text, "cell.toml").machine;
    EXPECT_EQ(machine.program.acceleration, 1500);
    EXPECT_NEAR(machine.program.turn_speed, 45 * degree, 1e-12);
    EXPECT_NEAR(machine.program.joint_share, 0.2, 1e-12);
    EXPECT_EQ(machine.program.scallop, 0.4);
    EXPECT_EQ(machine.program.interpolation_cycle_s, 0.004);
    EXPECT_EQ(machine.program.tool_change_s, 0);
    EXPECT_EQ(machine.load_tolerance, (LoadTolerance{1, 5, 0.2}));
}

// One wrong text per row; `place` is a text of the changed file in the line that the message names.
TEST(CellVersion2, NamesLineAndKeyOfEveryFault) {
    struct Case {
        std::string from, to, place, key, word;
    };
    const std::vector<Case> of_robot{
        {"version = 2", "version = 3", "version", "version", "out of bounds"},
        {"version = 2", "version = \"2\"", "version", "version", "whole number"},
        {"payload_kg", "payload", "payload =", "unknown key robot.payload", ""},
        {"radius = 200.0", "radius = 200.0\nlenght = 1", "lenght", "unknown key robot.capsule.lenght", ""},
        {"[obstacle", "[obstcle", "obstcle", "unknown key obstcle", ""},
        {"c2 = 1150.0", "c2 = -1150.0", "c2 =", "robot.c2", "out of bounds"},
        {"c2 = 1150.0", "c2 = nan", "c2 =", "robot.c2", "finite"},
        {"c4 = 215.0", "c4 = 6000.0", "c4 =", "robot.c4", "out of bounds"},
        {"sign = [-1, 1,", "sign = [-1, 0,", "sign =", "robot.sign", "axis 2"},
        {"sign = [-1, 1,", "sign = [1,", "sign =", "robot.sign", "6 numbers"},
        {"min_deg = [-185.0, -140.0", "min_deg = [-185.0, -5.0", "max_deg =", "robot.max_deg", "axis 2"},
        {"min_deg = [-185.0", "min_deg = [nan", "min_deg =", "robot.min_deg", "finite"},
        {"speed_deg_per_s = [136.0", "speed_deg_per_s = [0", "speed_deg_per_s =", "robot.speed_deg_per_s", "bounds"},
        {"acceleration_deg_per_s2 = [272.0", "acceleration_deg_per_s2 = [inf", "acceleration_deg",
         "robot.acceleration_deg_per_s2", "finite"},
        {"position = [0.0, 0.0, 0.0]", "position = [0.0, 0.0, 5001.0]", "position =", "robot.base.position", "bounds"},
        {"abc_deg = [0.0, 0.0, 0.0]", "abc_deg = [0.0, 0.0]", "abc_deg =", "robot.base.abc_deg", "3 numbers"},
        {"axis_4_deg = [-180.0, 180.0]", "axis_4_deg = [180.0, -180.0]", "axis_4_deg", "robot.cable.axis_4_deg",
         "below the second"},
        {"axis_6_deg = [-180.0, 180.0]", "axis_6_deg = [400.0, 500.0]", "axis_6_deg", "robot.cable.axis_6_deg",
         "outside"},
        {"link = 2", "link = 7", "link = 7", "robot.capsule.link", "out of bounds"},
        {"radius = 200.0", "radius = 0", "radius = 0", "robot.capsule.radius", "out of bounds"},
        {"tool_axis = \"z\"", "tool_axis = \"y\"", "tool_axis", "spindle.tool_axis", "must be"},
        {"mass_kg = 15.0", "mass_kg = 119.0", "mass_kg = 119", "spindle.mass_kg", "payload_kg"},
        {"on = { output = 1 }", "on = { output = 0 }", "on = { output = 0 }", "spindle.on.output", "out of bounds"},
        {"on = { output = 1 }", "on = { output = \"one\" }", "on = { output", "spindle.on.output", "whole number"},
        {"on = { output = 1 }", "on = { input = 1 }", "on = { input", "unknown key spindle.on.input", ""},
        {"on = { output = 1 }", "on = {}", "on = {}", "spindle.on", "which signal"},
        {"on = { output = 1 }", "on = { call = \"2X\" }", "on = { call", "spindle.on.call", "not a name"},
        {"on = { output = 1 }", "on = { output = 1, call = \"X\" }", "on = { output", "spindle.on.call", "one of"},
        {"external_axis = 1", "external_axis = 0", "external_axis", "rotary_table.external_axis", "out of bounds"},
        {"abc_deg = [0.0, 0.0, 0.0]        # it", "abc_deg = [0.0, 2.0, 0.0]  # it", "# it turns",
         "rotary_table.abc_deg", "upright"},
        {"position = [1450.0, 0.0, 300.0]", "position = [1450.0, 0.0, 200.0]", "position = [1450",
         "rotary_table.position", "below the reach"},
        {"max = [600.0, 2600.0, 1400.0]", "max = [600.0, 1600.0, 1400.0]", "max = [600.0", "obstacle.max", "along y"},
        {"joints_deg = [0.0, -90.0", "joints_deg = [0.0, 0.0", "joints_deg", "start.joints_deg", "axis 2"},
        {"joints_deg = [0.0, -90.0, 90.0, 0.0", "joints_deg = [0.0, -90.0, 90.0, 181.0", "joints_deg",
         "start.joints_deg", "axis 4"},
        {"[start]\n", "[start]\ntip = [0, 0, 0]\n", "tip = [", "start.tip", "gantry"},
        {"dialect = \"krl\"", "dialect = \"ngc\"", "dialect", "program.dialect", "krl or rapid"},
        {"dialect = \"krl\"", "dialect = \"gcode\"", "dialect", "program.dialect", "unknown dialect"},
        {"memory_bytes = 3000000", "memory_bytes = 3", "memory_bytes", "program.memory_bytes", "out of bounds"},
        {"link_feed = 300.0", "link_feed = -1.0", "link_feed", "program.link_feed", "out of bounds"},
        {"tool_change = \"stop\"", "tool_change = \"call 7\"", "tool_change", "program.tool_change", "call NAME"},
        {"link_feed = 300.0", "acceleration = 5.0\nlink_feed = 300.0", "acceleration = 5", "program.acceleration",
         "out of bounds"},
        {"link_feed = 300.0", "turn_speed_deg_per_s = 0.5\nlink_feed = 300.0", "turn_speed_deg",
         "program.turn_speed_deg_per_s", "out of bounds"},
        {"link_feed = 300.0", "joint_move_percent = 50.5\nlink_feed = 300.0", "joint_move",
         "program.joint_move_percent", "whole"},
        {"link_feed = 300.0", "interpolation_cycle = 0\nlink_feed = 300.0", "interpolation_cycle",
         "program.interpolation_cycle", "out of bounds"},
        {"link_feed = 300.0", "tool_change_time = -1\nlink_feed = 300.0", "tool_change_time",
         "program.tool_change_time", "out of bounds"},
        {"link_feed = 300.0", "tool_change_time = 3601\nlink_feed = 300.0", "tool_change_time",
         "program.tool_change_time", "out of bounds"},
        {"link_feed = 300.0", "scallop = 2.5\nlink_feed = 300.0", "scallop", "program.scallop", "out of bounds"},
        {"[margin]", "[load_tolerance]\ncentre_mm = -1.0\n[margin]", "centre_mm", "load_tolerance.centre_mm",
         "out of bounds"},
        {"[margin]", "[load_tolerance]\nmass_kg = inf\n[margin]", "mass_kg = inf", "load_tolerance.mass_kg", "finite"},
        {"[margin]", "[load_tolerance]\ncenter_mm = 1.0\n[margin]", "center_mm", "unknown key load_tolerance.center_mm",
         ""},
        {"number = 2", "number = 1", "name = \"flat", "tool.number", "second tool"},
        {"shape = \"flat\"", "shape = \"square\"", "shape = \"square", "tool.shape", "unknown shape"},
        {"shape = \"flat\"", "shape = \"flat\"\ncorner_radius = 1.0", "corner_radius", "tool.corner_radius",
         "no meaning"},
        {"shape = \"flat\"", "shape = \"bull\"\ncorner_radius = 10.0", "corner_radius", "tool.corner_radius", "half"},
        {"shape = \"flat\"", "shape = \"bull\"", "name = \"flat", "tool.corner_radius", "missing"},
        {"shape = \"flat\"", "shape = \"cone\"", "name = \"flat", "tool.tip_angle_deg", "missing"},
        {"shape = \"flat\"", "shape = \"flat\"\ntip_angle_deg = 30.0", "tip_angle", "tool.tip_angle_deg", "no meaning"},
        {"tip_angle_deg = 118.0", "tip_angle_deg = 30.0", "tip_angle_deg = 30", "tool.tip_angle_deg", "out of bounds"},
        {"tip_angle_deg = 118.0\n", "", "name = \"drill 8", "tool.tip_angle_deg", "missing"},
        {"tip_angle_deg = 118.0", "tip_angle_deg = 118.0\ncorner_radius = 1.0", "corner_radius = 1.0",
         "tool.corner_radius", "no meaning"},
        {"flute_length = 80.0\nstick_out = 120.0", "flute_length = 80.0\nstick_out = 70.0", "stick_out = 70",
         "tool.stick_out", "flute_length"},
        {"shape = \"ball\"", "shape = \"drill\"\ntip_angle_deg = 118.0", "shape = \"drill", "tool.shape", "first tool"},
        {"stick_out = 150.0", "stick_out = 99.0", "stick_out = 99", "tool.stick_out", "flute_length"},
        {"flute_length = 100.0", "flute_length = 0.0", "flute_length = 0", "tool.flute_length", "out of bounds"},
        {"removal_mm3_per_s = 24000.0", "removal_mm3_per_s = 0.0", "removal_mm3_per_s = 0", "tool.removal_mm3_per_s",
         "out of bounds"},
        {"removal_mm3_per_s = 24000.0", "removal_mm3_per_s = 400000.0", "removal_mm3_per_s = 4",
         "tool.removal_mm3_per_s", "needs a feed of 200 mm/s with the whole flute in the foam, and the largest is 150"},
        {"holder = [[40.0, 50.0]]", "holder = [[19.0, 50.0]]", "holder = [[19", "tool.holder", "narrower"},
        {"holder = [[40.0, 50.0]]", "holder = [40.0, 50.0]", "holder = [40", "tool.holder", "two numbers"},
        {"holder = [[40.0, 50.0]]", "holder = []", "holder = []", "tool.holder", "at least one"},
        {"feed_mm_per_s = [20.0, 150.0]", "feed_mm_per_s = [20.0, 501.0]", "feed_mm_per_s = [20.0, 501",
         "tool.feed_mm_per_s", "out of bounds"},
        {"feed_mm_per_s = [20.0, 150.0]", "feed_mm_per_s = [20.0, 20.0]", "feed_mm_per_s = [20.0, 20.0]",
         "tool.feed_mm_per_s", "below the second"},
        {"rpm = [6000, 18000]", "rpm = [6000, 1800.5]", "rpm = [6000, 1800.5", "tool.rpm", "below the second"},
        {"rpm = [6000, 18000]", "rpm = [6000.5, 18000]", "rpm = [6000.5", "tool.rpm", "whole"},
        {"length_measured = false", "length_measured = 0", "length_measured = 0", "tool.length_measured",
         "true or false"},
        {"length_measured = false", "length_measured = false\ncentre_cutting = false", "centre_cutting",
         "tool.centre_cutting", "no meaning for the shape ball"},
        {"sawn = true  # may be sawn down\n", "", "kerf = 3", "stock.kerf", "not sawn"},
        {"kerf = 3.0", "", "name = \"large\"", "stock.kerf", "missing"},
        {"max_tilt_deg = 60.0", "max_tilt_deg = 91.0", "max_tilt_deg", "max_tilt_deg", "out of bounds"},
        {"max_unreachable = 0.02", "max_unreachable = 2", "max_unreachable", "max_unreachable", "out of bounds"},
        {"max_tilt_deg = 60.0", "max_tilt_deg = nan", "max_tilt_deg", "max_tilt_deg", "finite"},
        {"max_unreachable = 0.02", "max_unreachable = nan", "max_unreachable", "max_unreachable", "finite"},
        {"max_deg = [185.0", "max_deg = [inf", "max_deg = [inf", "robot.max_deg", "finite"},
        {"axis_4_deg = [-180.0", "axis_4_deg = [-inf", "axis_4_deg", "robot.cable.axis_4_deg", "finite"},
        {"cutting_force = 20.0", "cutting_force = 0", "cutting_force", "holding.cutting_force", "out of bounds"},
        {"strength = 0.1 ", "strength = nan ", "strength = nan", "holding.strength", "finite"},
        {"max_slenderness = 4.0", "max_slendernes = 4.0", "max_slendernes", "unknown key holding.max_slendernes", ""},
        {"bending_strength = 0.6", "bending_strength = -1", "bending_strength", "stock.bending_strength", "out of"},
        {"spoil = 10.0", "spoil = -1.0", "spoil", "margin.spoil", "out of bounds"},
        {"spoil = 10.0", "spoil = inf", "spoil", "margin.spoil", "finite"},
        {"sides = 5.0", "sides = nan", "sides", "margin.sides", "finite"},
        {"top = 3.0", "top = inf", "top = inf", "margin.top", "finite"},
        {"source = \"data sheet\"", "source = \"guessed\"", "\"guessed\"", "robot.source", "unknown origin"},
        {"payload_kg = \"assumed\"", "payload_kg = \"?\"", "payload_kg = \"?\"", "robot.sources.payload_kg",
         "unknown origin"},
        {"sources = {", "sources = { name = \"assumed\",", "sources = {", "unknown key robot.sources.name", ""},
        {"[rotary_table]", "[table]\ncentre = [1450, 0]\nsize = [9, 9]\nheight = 300\n[rotary_table]",
         "abc_deg = [0.0, 0.0, 0.0]        # it", "", "one table"},
    };
    for (const Case& one : of_robot) {
        const std::string text = replaced(robot_cell(), one.from, one.to);
        const std::string what = refused(text);
        EXPECT_NE(what.find(one.key), std::string::npos) << one.to << " -> " << what;
        EXPECT_NE(what.find(one.word), std::string::npos) << one.to << " -> " << what;
        if (what.find("is missing") != std::string::npos || one.word == "one table") continue;  // the table's line
        if (one.key == "tool.number") continue;  // a line before its place
        EXPECT_EQ(what.find("cell.toml:" + std::to_string(line_of(text, one.place)) + ": "), 0U)
            << one.to << " -> " << what;
    }
    const std::vector<Case> of_gantry{
        {"max_unreachable = 0.02", "max_unreachable = 0.02\nmax_tilt_deg = 30.0", "", "max_tilt_deg", "does not tilt"},
        {"dialect = \"ngc\"", "dialect = \"krl\"", "", "program.dialect", "ngc"},
        {"tip = [100.0", "tip = [-1.0", "", "start.tip", "outside of the reach"},
        {"[start]\n", "[start]\njoints_deg = [0, 0, 0, 0, 0, 0]\n", "", "start.joints_deg", "robot"},
        {"[spindle]\n", "[spindle]\nposition = [0, 0, 0]\n", "", "spindle.position", "no flange"},
        {"tool_axis = \"z\"", "tool_axis = \"x\"", "", "spindle.tool_axis", "gantry"},
        {"[table]", "[rotary_table]", "", "rotary_table", "three axes"},
    };
    for (const Case& one : of_gantry) {
        const std::string what = refused(replaced(gantry_cell(), one.from, one.to));
        EXPECT_NE(what.find(one.key), std::string::npos) << one.to << " -> " << what;
        EXPECT_NE(what.find(one.word), std::string::npos) << one.to << " -> " << what;
    }
}

TEST(CellVersion2, DowelsAreAListLargestFirst) {
    EXPECT_EQ(parse_cell(robot_cell(), "cell.toml").dowels, default_dowels());
    const std::string two =
        "\n[[dowel]]\ndiameter = 12.0\ndepth = 30.0\nwall = 8.0\n[[dowel]]\ndiameter = 6.0\ndepth = 20.0\nwall = 4.0\n";
    const Cell cell =
        parse_cell(replaced(robot_cell(), "version = 2", "version = 2\ndowel_play = 0.5") + two, "cell.toml");
    EXPECT_EQ(cell.dowels, (std::vector<DowelSize>{{12, 30, 8}, {6, 20, 4}}));
    EXPECT_EQ(cell.dowel_play, 0.5);
    EXPECT_NE(refused(robot_cell() + replaced(two, "12.0", "5.0")).find("not smaller"), std::string::npos);
    EXPECT_NE(refused(robot_cell() + replaced(two, "12.0", "0.5")).find("bounds"), std::string::npos);
    EXPECT_NE(refused(robot_cell() + replaced(two, "12.0", "nan")).find("finite"), std::string::npos);
    EXPECT_NE(refused(robot_cell() + replaced(two, "depth = 30.0\n", "")).find("depth"), std::string::npos);
    EXPECT_NE(refused(replaced(robot_cell(), "version = 2", "version = 2\ndowel_play = 9.0")).find("bounds"),
              std::string::npos);
    EXPECT_TRUE(parse_cell(replaced(robot_cell(), "version = 2", "version = 2\ndowel = []"), "c.toml").dowels.empty());
}

TEST(CellVersion2, AnOriginOfAValueThatIsNotGivenIsRefused) {
    const std::string text =
        replaced(robot_cell(), "shape = \"ball\"", "shape = \"ball\"\nsources = { corner_radius = \"measured\" }");
    EXPECT_NE(refused(text).find("tool.sources.corner_radius: the table does not give this value"), std::string::npos)
        << refused(text);
}

TEST(CellCheck, AReadyCellMayNotBeDispatched) {
    const CellCheck check = check_cell(parse_cell(robot_cell(), "cell.toml"));
    EXPECT_FALSE(check.may_be_dispatched());
    const std::vector<std::string>& reasons = check.against_dispatch;
    for (const char* reason : {"robot.min_deg is assumed: a joint limit", "robot.base.position is assumed: a frame",
                               "tool 2: its length is not measured"}) {
        EXPECT_NE(std::find(reasons.begin(), reasons.end(), reason), reasons.end()) << reason;
    }
    EXPECT_TRUE(check.missing.empty());
}

TEST(CellCheck, WhatIsMeasuredMayBeDispatched) {
    for (std::string text : {robot_cell(), gantry_cell()}) {
        for (const auto& [from, to] : {std::pair{"\"assumed\"", "\"measured\""},
                                       std::pair{"length_measured = false", "length_measured = true"}}) {
            while (text.find(from) != std::string::npos) text = replaced(text, from, to);
        }
        text = replaced(text, "[program]\n", "[program]\ninterpolation_cycle = 0.012\ntool_change_time = 90\n");
        const CellCheck check = check_cell(parse_cell(text, "cell.toml"));
        EXPECT_TRUE(check.may_be_dispatched());
        EXPECT_TRUE(check.uncertain.empty());
        // One value of unstated origin is enough, if it decides where the tool is.
        const std::size_t table = text.find("table]");
        const std::size_t at = text.find("source = \"measured\"\n", table);
        std::string unstated = text;
        unstated.erase(at, std::string("source = \"measured\"\n").size());
        const CellCheck second = check_cell(parse_cell(unstated, "cell.toml"));
        EXPECT_FALSE(second.may_be_dispatched());
        EXPECT_EQ(second.uncertain.front().origin, Origin::unstated);
    }
}

TEST(CellVersion2, ExtractionMaySayThatItRuns) {
    const std::string on = "[extraction]\non = { output = 2 }\n";
    const std::string running = "running = { input = 9 }\n";
    const Cell cell = parse_cell(replaced(robot_cell(), on, on + running), "cell.toml");
    EXPECT_EQ(cell.machine->extraction->running, (Signal{SignalKind::input, "9", 1}));
    EXPECT_THROW(parse_cell(replaced(robot_cell(), on, "[extraction]\n" + running), "cell.toml"), InputError);
    EXPECT_THROW(parse_cell(replaced(robot_cell(), on, on + "running = { output = 9 }\n"), "cell.toml"), InputError);
    const std::string gantry = gantry_cell();
    EXPECT_THROW(parse_cell(gantry + "\n[extraction]\non = { output = 2 }\n" + running, "cell.toml"), InputError);
}

TEST(CellCheck, TellsWhatIsNotDescribed) {
    std::string text = robot_cell();
    const std::size_t at = text.find("[extraction]");
    text.erase(at, text.find("# The box", at) - at);
    text = replaced(text, "at_speed = { input = 1 }\n", "");
    const CellCheck check = check_cell(parse_cell(text, "cell.toml"));
    ASSERT_EQ(check.missing.size(), 3U);
    EXPECT_EQ(check.missing[0], "spindle.at_speed: no signal tells that the spindle has its speed");
    EXPECT_EQ(check.missing[1], "extraction.on: no signal switches the extraction on");
    const CellCheck boxes = check_cell(read_cell(cells / "foam-1.toml"));
    EXPECT_EQ(boxes.against_dispatch.front(), "reach.min is assumed: the travel of an axis");
    ASSERT_EQ(boxes.missing.size(), 1U);
    EXPECT_NE(boxes.missing[0].find("no machine is described"), std::string::npos);
}

// Whatever the bytes: a possible cell or an InputError.
TEST(CellVersion2, DamagedTextNeverEscapes) {
    std::mt19937 random(12);
    int refusals = 0;
    for (int round = 0; round < 1500; ++round) {
        std::string text = round % 2 == 0 ? robot_cell() : gantry_cell();
        for (int k = 0; k < 1 + round % 4; ++k) {
            const std::size_t at = random() % text.size();
            if (round % 3 == 0) text[at] = static_cast<char>(random());
            if (round % 3 == 1) text.erase(at, 1 + random() % 6);
            if (round % 3 == 2) text.insert(at, 1, "[]{}=\"'\n.0e-"[random() % 12]);
        }
        try {
            const Cell cell = parse_cell(text, "c.toml");
            ASSERT_TRUE(cell.machine);
            EXPECT_FALSE(cell.machine->tools.empty());
            for (const CuttingTool& tool : cell.machine->tools) EXPECT_GE(tool.stick_out, tool.flute_length);
            check_cell(cell);
        } catch (const InputError& error) {
            ++refusals;
            EXPECT_EQ(error.fault, InputFault::config);
        }
    }
    EXPECT_GT(refusals, 300);
}

}  // namespace
}  // namespace qchopper
