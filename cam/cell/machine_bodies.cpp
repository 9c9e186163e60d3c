// Every axis turns what lies behind it about a line that is known while the arm stands straight up; the motion of a
// link is the product of these turns (R. W. Brockett, "Robotic manipulators and the product of exponentials formula",
// 1984). O(links): six sines and cosines and as many products of poses.

#include "cam/cell/machine_bodies.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "cam/cell/reach_map.h"

namespace qchopper {
namespace {

// Pairs that may touch, by link; 6: the flange with the spindle, 7: holder and tool. Neighbours meet in their axis;
// axes 4, 5 and 6 meet in the wrist centre at the end of link 3, and there the range of axis 5 keeps the spindle off.
constexpr std::array<std::array<bool, 8>, 8> may_touch_table{{
    // 0     1      2      3      4      5      6      7
    {true, true, false, false, false, false, false, false},
    {true, true, true, false, false, false, false, false},
    {false, true, true, true, false, false, false, false},
    {false, false, true, true, true, true, true, false},
    {false, false, false, true, true, true, true, true},
    {false, false, false, true, true, true, true, true},
    {false, false, false, true, true, true, true, true},
    {false, false, false, false, true, true, true, true},
}};

Pose about_z(Vec3 point, double angle) {
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    return {{Vec3{c, -s, 0}, Vec3{s, c, 0}, Vec3{0, 0, 1}},
            {point.x - c * point.x + s * point.y, point.y - s * point.x - c * point.y, 0}};
}

Pose about_y(Vec3 point, double angle) {
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    return {{Vec3{c, 0, s}, Vec3{0, 1, 0}, Vec3{-s, 0, c}},
            {point.x - c * point.x - s * point.z, 0, point.z + s * point.x - c * point.z}};
}

Cylinder along_axis(double front, double length, double radius) {
    return {{0, 0, -front}, {0, 0, -front - length}, radius};
}

}  // namespace

std::vector<AxisBody> bodies_on_axis(const CuttingTool& tool, const Spindle& spindle) {
    std::vector<AxisBody> bodies{{BodyPart::tool, along_axis(0, tool.stick_out, 0.5 * tool.diameter)}};
    double above = tool.stick_out;
    for (const HolderStep& step : tool.holder) {
        bodies.push_back({BodyPart::holder, along_axis(above, step.length, 0.5 * step.diameter)});
        above += step.length;
    }
    const double front = above + spindle.body_offset;
    if (spindle.body_radius > 0) {
        bodies.push_back({BodyPart::spindle, along_axis(front, spindle.body_length, spindle.body_radius)});
    }
    return bodies;
}

bool is_about_tool_axis(const LinkCapsule& link, const Robot& robot, const Spindle& spindle) {
    constexpr double rounding = 1e-6;  // mm
    const Pose& nose = spindle.spindle_in_flange;
    const double cosine = nose.row[2][spindle.tool_axis == ToolAxis::z ? 2 : 0];  // of the tool axis to axis 6
    if (std::hypot(nose.shift.x, nose.shift.y) > rounding || cosine < 1 - 1e-12) return false;
    const ArmGeometry& arm = robot.geometry;
    const auto is_on_axis_6 = [&](Vec3 p) { return std::hypot(p.x - arm.a1 - arm.a2, p.y - arm.b) < rounding; };
    return link.link == 5 && is_on_axis_6(link.shape.from) && is_on_axis_6(link.shape.to);
}

std::vector<AxisBody> bodies_over_tip(const CuttingTool& tool, const CellMachine& machine, double around) {
    std::vector<AxisBody> bodies = bodies_on_axis(tool, machine.spindle);
    if (!machine.robot) return bodies;
    const Robot& robot = *machine.robot;
    const ArmGeometry& arm = robot.geometry;
    const double flange_z = arm.c1 + arm.c2 + arm.c3 + arm.c4;  // while the arm stands straight up
    const double flange = tool_arm(robot, machine.spindle, tool).tip_in_flange.shift.z;  // above the tip
    for (const LinkCapsule& link : robot.capsules) {
        if (!is_about_tool_axis(link, robot, machine.spindle)) continue;
        const double radius = link.shape.radius + around;
        const double inner = bodies.back().shape.radius;
        if (radius <= inner) continue;
        // The rounded end is inside of what is below it down to where it becomes wider.
        const double end = flange + flange_z - std::max(link.shape.from.z, link.shape.to.z);
        const double front = std::max(-bodies.back().shape.from.z, end - std::sqrt(radius * radius - inner * inner));
        const double back = flange + flange_z - std::min(link.shape.from.z, link.shape.to.z) + radius;
        bodies.push_back({BodyPart::link, along_axis(front, back - front, radius)});
    }
    return bodies;
}

LinkMotions link_motions(const ArmGeometry& arm, const Joints& joints, const Pose& base_in_cell) {
    const auto angle = [&](std::size_t axis) { return arm.sign[axis] * joints[axis] - arm.offset[axis]; };
    const Vec3 axis_2{arm.a1, 0, arm.c1};
    const Vec3 axis_3{arm.a1, 0, arm.c1 + arm.c2};
    const Vec3 wrist{arm.a1 + arm.a2, arm.b, arm.c1 + arm.c2 + arm.c3};
    LinkMotions motions;
    motions[0] = base_in_cell;
    motions[1] = base_in_cell * about_z({}, angle(0));
    motions[2] = motions[1] * about_y(axis_2, angle(1));
    motions[3] = motions[2] * about_y(axis_3, angle(2));
    motions[4] = motions[3] * about_z(wrist, angle(3));
    motions[5] = motions[4] * about_y(wrist, angle(4));
    motions[6] = motions[5] * about_z(wrist, angle(5));
    return motions;
}

MovingBodies bodies_at(const Cell& cell, const CuttingTool& tool, const Joints& joints, Vec3 gantry_tip) {
    assert(cell.machine);
    const CellMachine& machine = *cell.machine;
    MovingBodies bodies{{}, bodies_on_axis(tool, machine.spindle)};
    Pose tip_in_cell{{Vec3{1, 0, 0}, Vec3{0, -1, 0}, Vec3{0, 0, -1}}, gantry_tip};
    if (machine.robot) {
        const Robot& robot = *machine.robot;
        const ToolArm arm = tool_arm(robot, machine.spindle, tool);
        tip_in_cell = robot.base_in_cell * (forward(robot.geometry, joints) * arm.tip_in_flange);
        const LinkMotions motions = link_motions(robot.geometry, joints, robot.base_in_cell);
        for (const LinkCapsule& own : robot.capsules) {
            bodies.links.push_back({own.link, moved(motions[static_cast<std::size_t>(own.link)], own.shape)});
        }
    }
    for (AxisBody& body : bodies.on_axis) body.shape = moved(tip_in_cell, body.shape);
    return bodies;
}

StandingBodies standing_bodies(const Cell& cell) {
    assert(cell.machine);
    const CellMachine& machine = *cell.machine;
    StandingBodies bodies;
    bodies.floor_z = std::min(0.0, cell.table.height);
    if (machine.robot) bodies.floor_z = std::min(bodies.floor_z, machine.robot->base_in_cell.shift.z);
    const Table& table = cell.table;
    if (machine.rotary_table) {
        const RotaryTable& rotary = *machine.rotary_table;
        const Pose& frame = rotary.table_in_cell;
        const double depth = std::max(0.0, frame.shift.z - bodies.floor_z);
        bodies.rotary = Cylinder{frame.shift, apply(frame, {0, 0, -depth}), rotary.radius};
    } else {
        const Vec3 half{0.5 * table.size_x, 0.5 * table.size_y, 0};
        const Vec3 top{table.centre_x, table.centre_y, table.height};
        bodies.table = placed({}, {top - half - Vec3{0, 0, table.height - bodies.floor_z}, top + half});
    }
    for (const Obstacle& obstacle : machine.obstacles) bodies.obstacles.push_back(placed({}, obstacle.box));
    return bodies;
}

bool may_touch(int link, int other_link) {
    assert(link >= 0 && link < 8 && other_link >= 0 && other_link < 8);
    return may_touch_table[static_cast<std::size_t>(link)][static_cast<std::size_t>(other_link)];
}

}  // namespace qchopper
