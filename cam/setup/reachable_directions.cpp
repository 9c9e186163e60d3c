// Asks for points and angles of the table until a point is not held or all are. What decided for one direction mostly
// decides for the next: the point that was not held is asked for first, and the angle that held all. The order has no
// influence on the answer.

#include "cam/setup/reachable_directions.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cam/cell/reach_map.h"
#include "cam/setup/holder_clearance.h"

namespace qchopper {
namespace {

constexpr double pi = std::numbers::pi;
constexpr int table_angles = 24;  // 15 degrees apart

// About the axis of the table.
Pose turned(const Pose& table_in_cell, double angle) {
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    const Pose turn{{Vec3{c, -s, 0}, Vec3{s, c, 0}, Vec3{0, 0, 1}}, {}};
    return table_in_cell * turn * inverse(table_in_cell);
}

std::vector<Vec3> asked_points(const Box& box, Vec3 direction) {
    std::vector<Vec3> points;
    for (int corner = 0; corner < 8; ++corner) {
        Vec3 point;
        bool faces = false;
        for (int i = 0; i < 3; ++i) {
            const bool is_far = ((corner >> i) & 1) != 0;
            point[i] = is_far ? box.max[i] : box.min[i];
            faces = faces || (is_far ? direction[i] : -direction[i]) > 1e-9;
        }
        if (faces) points.push_back(point);
    }
    points.push_back(box.centre());
    return points;
}

class ReachTest {
 public:
    ReachTest(const Cell& cell, const Box& box, double spoil)
        : setup_in_cell_(setup_in_cell(cell, spoil)), box_(box), rotary_table_(cell.machine->rotary_table) {
        const CellMachine& machine = *cell.machine;
        arm_ = tool_arm(*machine.robot, machine.spindle, longest_tool(machine.tools));
    }

    bool is_held(Vec3 direction) {
        std::vector<Vec3> points = asked_points(box_, direction);
        if (!rotary_table_) return holds_all(setup_in_cell_, points, direction);
        const Pose& table = rotary_table_->table_in_cell;
        const Vec3 in_table = rotate_inverse(table, rotate(setup_in_cell_, direction));
        const Vec3 base = apply_inverse(table, arm_.base_in_cell.shift);
        const double own = std::atan2(in_table.y, in_table.x);
        const double towards_base = std::atan2(base.y, base.x) - own;
        std::vector<double> angles{towards_base, towards_base + pi};
        for (int i = 0; i < table_angles; ++i) angles.push_back(i * 2 * pi / table_angles);
        // First those that turn the direction to where the last one was held.
        const auto difference = [&](double angle) { return std::abs(std::remainder(angle + own - held_at_, 2 * pi)); };
        std::sort(angles.begin(), angles.end(), [&](double a, double b) { return difference(a) < difference(b); });
        return std::any_of(angles.begin(), angles.end(), [&](double angle) {
            if (!holds_all(turned(table, angle) * setup_in_cell_, points, direction)) return false;
            held_at_ = angle + own;
            return true;
        });
    }

 private:
    // A point that is not held comes to the front.
    bool holds_all(const Pose& pose, std::vector<Vec3>& points, Vec3 direction) const {
        const Vec3 tool_axis = rotate(pose, direction);
        const double tilt = std::acos(std::clamp(tool_axis.z, -1.0, 1.0));
        const double azimuth = std::atan2(-tool_axis.y, -tool_axis.x);
        const auto failed = std::find_if(points.begin(), points.end(),
                                         [&](Vec3 point) { return !holds(arm_, apply(pose, point), tilt, azimuth); });
        if (failed == points.end()) return true;
        std::rotate(points.begin(), failed, failed + 1);
        return false;
    }

    Pose setup_in_cell_;
    Box box_;
    std::optional<RotaryTable> rotary_table_;
    ToolArm arm_;
    double held_at_ = 0;  // where the last direction that was held leant, about the axis of the table
};

}  // namespace

Pose setup_in_cell(const Cell& cell, double spoil) {
    if (cell.machine && cell.machine->rotary_table) {
        return cell.machine->rotary_table->table_in_cell * Pose{Pose{}.row, {0, 0, spoil}};
    }
    return {Pose{}.row, {cell.table.centre_x, cell.table.centre_y, cell.table.height + spoil}};
}

std::vector<std::uint8_t> reachable_directions(const Cell& cell, const Box& box, double spoil,
                                               std::span<const Vec3> directions) {
    std::vector<std::uint8_t> held(directions.size(), 1);
    if (!cell.machine) return held;
    if (!cell.machine->robot) {
        const auto is_up = [](Vec3 d) { return std::hypot(d.x, d.y) < 1e-6 && d.z > 0; };
        std::transform(directions.begin(), directions.end(), held.begin(), [&](Vec3 d) { return is_up(d) ? 1 : 0; });
        return held;
    }
    ReachTest test(cell, box, spoil);
    std::transform(directions.begin(), directions.end(), held.begin(), [&](Vec3 d) { return test.is_held(d) ? 1 : 0; });
    return held;
}

}  // namespace qchopper
