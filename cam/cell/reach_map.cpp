// Asks for the joints of every direction and turn until one holds the pose, over a section as large as the stretched
// arm, from which what nothing reaches is cut off. O(squares x tilts x azimuths x turns)
// answers of the inverse kinematics.

#include "cam/cell/reach_map.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/parallel.h"
#include "base/units.h"

namespace qchopper {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double joint_margin = radians(3);
constexpr double max_squares = 500;  // in a row or column

// A frame with z along the tool axis, in the frame of the spindle.
Pose axis_in_spindle(ToolAxis axis) {
    if (axis == ToolAxis::z) return {};
    return {{Vec3{0, 0, 1}, Vec3{1, 0, 0}, Vec3{0, 1, 0}}, {}};
}

// Rz(azimuth) Ry(pi - tilt) Rz(turn).
Pose tip_in_cell(Vec3 tip, double tilt, double azimuth, double turn) {
    const double ca = std::cos(azimuth);
    const double sa = std::sin(azimuth);
    const double ct = std::cos(tilt);
    const double st = std::sin(tilt);
    const Pose leaning{{Vec3{-ca * ct, -sa, ca * st}, Vec3{-sa * ct, ca, sa * st}, Vec3{-st, 0, -ct}}, tip};
    const double c = std::cos(turn);
    const double s = std::sin(turn);
    return leaning * Pose{{Vec3{c, -s, 0}, Vec3{s, c, 0}, Vec3{0, 0, 1}}, {}};
}

struct Interval {
    double min = 0;
    double max = 0;
    void add(double value) {
        min = std::min(min, value);
        max = std::max(max, value);
    }
};

// Of the plane of the section.
struct Area {
    Interval x;
    Interval z;
    void add(Vec3 point) {
        x.add(point.x);
        z.add(point.z);
    }
};

Area fixed_area(const Cell& cell) {
    Area area{{cell.workspace.min.x, cell.workspace.max.x}, {cell.workspace.min.z, cell.workspace.max.z}};
    const Table& table = cell.table;
    area.add({table.centre_x - table.size_x / 2, 0, table.height});
    area.add({table.centre_x + table.size_x / 2, 0, table.height});
    if (!cell.machine) return area;
    if (const auto& rotary = cell.machine->rotary_table) {
        area.x.add(table.centre_x - rotary->radius);
        area.x.add(table.centre_x + rotary->radius);
    }
    if (cell.machine->robot) area.add(cell.machine->robot->base_in_cell.shift);
    return area;
}

// Beside the fixed area what the stretched arm could reach from its shoulder, on the table's side.
Area largest_area(const Cell& cell, const Area& fixed, const ToolArm& arm) {
    const ArmGeometry& g = arm.geometry;
    const Vec3 shoulder = apply(arm.base_in_cell, {0, 0, g.c1});
    const Vec3 tip_from_wrist = arm.tip_in_flange.shift + Vec3{0, 0, g.c4};
    const double length = std::abs(g.a1) + std::abs(g.b) + g.c2 + std::hypot(g.a2, g.c3) + norm(tip_from_wrist);
    Area area = fixed;
    area.z.add(shoulder.z + length);
    area.x.add(shoulder.x + (cell.table.centre_x < shoulder.x ? -length : length));
    return area;
}

// Whole squares, with the corners at multiples of the step.
ReachSection section_of(const Area& area, double y, double step) {
    const double extent = std::max(area.x.max - area.x.min, area.z.max - area.z.min);
    ReachSection section;
    section.y = y;
    section.step = std::max(step, extent / max_squares);
    const auto count = [&](const Interval& interval, double start) {
        return static_cast<std::size_t>(std::max(1.0, std::ceil((interval.max - start) / section.step)));
    };
    section.x_min = section.step * std::floor(area.x.min / section.step);
    section.z_min = section.step * std::floor(area.z.min / section.step);
    section.columns = count(area.x, section.x_min);
    section.rows = count(area.z, section.z_min);
    return section;
}

template <class Held>
TiltReach reach_at(const ReachSection& section, double tilt, const Held& held) {
    TiltReach reach{tilt, tilt == 0 ? 1 : reach_azimuths, {}};
    reach.held.resize(section.columns * section.rows);
    parallel_for(0, section.rows, [&](std::size_t row) {
        for (std::size_t column = 0; column < section.columns; ++column) {
            reach.held[row * section.columns + column] = static_cast<std::uint8_t>(held(section.middle(column, row)));
        }
    });
    return reach;
}

// The part of a map that holds the area and every square that is reached.
ReachMap cropped(const ReachMap& map, Area area) {
    const ReachSection& from = map.section;
    for (const TiltReach& reach : map.tilts) {
        for (std::size_t i = 0; i < reach.held.size(); ++i) {
            if (reach.held[i] > 0) area.add(from.middle(i % from.columns, i / from.columns));
        }
    }
    const auto before = [&](double length) {
        return static_cast<std::size_t>(std::max(0.0, std::floor(length / from.step)));
    };
    const auto until = [&](double length) { return static_cast<std::size_t>(std::ceil(length / from.step)); };
    const std::size_t left = before(area.x.min - from.x_min);
    const std::size_t below = before(area.z.min - from.z_min);
    ReachMap part;
    part.section = from;
    part.section.x_min += from.step * static_cast<double>(left);
    part.section.z_min += from.step * static_cast<double>(below);
    part.section.columns = std::min(from.columns, until(area.x.max - from.x_min)) - left;
    part.section.rows = std::min(from.rows, until(area.z.max - from.z_min)) - below;
    for (const TiltReach& reach : map.tilts) {
        TiltReach kept{reach.tilt, reach.azimuths, {}};
        for (std::size_t row = 0; row < part.section.rows; ++row) {
            const auto first = reach.held.begin() + static_cast<std::ptrdiff_t>((below + row) * from.columns + left);
            kept.held.insert(kept.held.end(), first, first + static_cast<std::ptrdiff_t>(part.section.columns));
        }
        part.tilts.push_back(std::move(kept));
    }
    return part;
}

bool is_in(const Box& box, Vec3 p) {
    for (int i = 0; i < 3; ++i) {
        if (!(p[i] >= box.min[i] && p[i] <= box.max[i])) return false;
    }
    return true;
}

}  // namespace

ToolArm tool_arm(const Robot& robot, const Spindle& spindle, const CuttingTool& tool) {
    ToolArm arm;
    arm.geometry = robot.geometry;
    arm.ranges = ranges_with_cable(robot.ranges, robot.cable);
    arm.margin = joint_margin;
    arm.base_in_cell = robot.base_in_cell;
    const Pose tip_in_axis{Pose{}.row, {0, 0, gauge_length(tool)}};
    arm.tip_in_flange = spindle.spindle_in_flange * (axis_in_spindle(spindle.tool_axis) * tip_in_axis);
    return arm;
}

bool holds(const ToolArm& arm, Vec3 tip, double tilt, double azimuth) {
    const Pose cell_in_base = inverse(arm.base_in_cell);
    const Pose flange_in_tip = inverse(arm.tip_in_flange);
    for (int turn = 0; turn < reach_redundancy_angles; ++turn) {
        const Pose tip_pose = tip_in_cell(tip, tilt, azimuth, turn * 2 * pi / reach_redundancy_angles);
        const Pose flange = cell_in_base * (tip_pose * flange_in_tip);
        if (!inverse_within(arm.geometry, arm.ranges, arm.margin, flange).empty()) return true;
    }
    return false;
}

int held_azimuths(const ToolArm& arm, Vec3 tip, double tilt) {
    if (tilt == 0) return holds(arm, tip, 0, 0) ? 1 : 0;
    int held = 0;
    for (int i = 0; i < reach_azimuths; ++i) {
        if (holds(arm, tip, tilt, i * 2 * pi / reach_azimuths)) ++held;
    }
    return held;
}

ReachMap reach_map(const Cell& cell, const std::vector<double>& tilts, double step) {
    const Area fixed = fixed_area(cell);
    ReachMap map;
    map.section = section_of(fixed, cell.table.centre_y, step);
    if (!cell.machine) return map;
    if (!cell.machine->robot) {
        for (const double tilt : tilts) {
            map.tilts.push_back(
                reach_at(map.section, tilt, [&](Vec3 tip) { return tilt == 0 && is_in(cell.workspace, tip) ? 1 : 0; }));
        }
        return map;
    }
    const ToolArm arm = tool_arm(*cell.machine->robot, cell.machine->spindle, cell.machine->tools.front());
    map.section = section_of(largest_area(cell, fixed, arm), cell.table.centre_y, step);
    for (const double tilt : tilts) {
        map.tilts.push_back(reach_at(map.section, tilt, [&](Vec3 tip) { return held_azimuths(arm, tip, tilt); }));
    }
    return cropped(map, fixed);
}

}  // namespace qchopper
