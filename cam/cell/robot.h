// What a cell file tells of the robot, its spindle and the rotary table.
//
// mm, radians, seconds, kg. A pose is a_in_b (base/pose.h). In what read_cell returns, lengths of links are not
// negative, min is below max for every axis, speeds, accelerations and radii are above zero, and the payload is at
// least the mass of the spindle with the heaviest tool.

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/pose.h"
#include "cam/cell/arm.h"
#include "cam/cell/shape_distance.h"

namespace qchopper {

// A capsule around a part of the arm, which moves with its link. A robot has it as it lies in the frame of its base
// while the arm stands straight up (all angles of ArmGeometry zero).
struct LinkCapsule {
    int link = 0;  // 0: the base, which does not move; k: what axis k moves and axis k + 1 does not
    Capsule shape;
    bool operator==(const LinkCapsule&) const = default;
};

struct AngleRange {
    double min = 0;
    double max = 0;
    bool operator==(const AngleRange&) const = default;
};

// How far the hoses and cables let two axes turn, beside their joint ranges.
struct CableLimits {
    AngleRange axis_4;
    AngleRange axis_6;
    bool operator==(const CableLimits&) const = default;
};

struct Robot {
    std::string name;  // the maker's name of the type
    ArmGeometry geometry;
    JointRanges ranges;
    double payload_kg = 0;
    Pose base_in_cell;
    std::optional<CableLimits> cable;
    std::vector<LinkCapsule> capsules;
    bool operator==(const Robot&) const = default;
};

// The ranges of the axes, those of axes 4 and 6 narrowed to what the cables allow.
JointRanges ranges_with_cable(const JointRanges& ranges, const std::optional<CableLimits>& cable);

// The table turns about the z axis of its frame, whose origin is the middle of the table's top.
struct RotaryTable {
    Pose table_in_cell;  // at angle 0; z within 1 degree of the cell's z
    double radius = 0;
    double speed = 0;       // largest, radians/s
    int external_axis = 1;  // 1..6
    bool operator==(const RotaryTable&) const = default;
};

enum class SignalKind { output, input, call };

struct Signal {
    SignalKind kind = SignalKind::output;
    std::string target;  // number (KRL, NGC) or name (RAPID) of the output or input; name of the program called
    double scale = 1;    // of the speed: value given to the output or the program per revolution/min
    bool operator==(const Signal&) const = default;
};

enum class ToolAxis { z, x };

// The spindle's frame has its origin in the middle of the spindle nose, where the holder begins, and its tool axis
// points out of the spindle.
struct Spindle {
    Pose spindle_in_flange;  // the identity in a gantry
    ToolAxis tool_axis = ToolAxis::z;
    double body_radius = 0;  // the body is a cylinder about the tool axis
    double body_length = 0;
    double body_offset = 0;  // from the nose back to the body's front
    double mass_kg = 0;
    std::optional<Signal> on;
    std::optional<Signal> speed;
    std::optional<Signal> at_speed;
    std::optional<Signal> off;  // an output: it is switched off
    bool operator==(const Spindle&) const = default;
};

// Of dust and chips.
struct Extraction {
    std::optional<Signal> on;
    std::optional<Signal> off;
    std::optional<Signal> running;  // input or call: it has started; in KRL
    bool operator==(const Extraction&) const = default;
};

}  // namespace qchopper
