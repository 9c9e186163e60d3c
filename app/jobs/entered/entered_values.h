// The values that a person enters at the controller in place of the planned ones: the base, as the block was touched
// off, and the lengths of tools, as they were measured. A replay with them says whether the program carves the piece
// from the block where it stands, with the tools as they are.
//
// Lengths in mm. An entered value that is the planned one to the last digit of a program changes nothing, so that the
// proof is the same to the last bit (tests/app/jobs/entered_values_test.cpp).

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/pose.h"
#include "base/vec3.h"

namespace qchopper {

struct Cell;
struct ReadJob;
struct Setup;

// As the controller shows it: of a fixed table the frame of the setup in the frame of the robot's base, of a rotary
// table on the table.
struct EnteredBase {
    Vec3 shift;
    Vec3 abc_deg;  // turns about z, y and x
    bool operator==(const EnteredBase&) const = default;
};

struct EnteredLength {
    std::uint16_t tool = 1;  // CuttingTool::number
    double length = 0;       // from the spindle nose to the tip
    bool operator==(const EnteredLength&) const = default;
};

struct EnteredValues {
    std::optional<EnteredBase> base;     // nothing: the planned one
    std::vector<EnteredLength> lengths;  // of the other tools: the planned ones
    bool is_empty() const { return !base && lengths.empty(); }
    bool operator==(const EnteredValues&) const = default;
};

// By how much a value may be off the planned one.
inline constexpr double max_base_shift = 20;
inline constexpr double max_base_turn_deg = 1;
inline constexpr double max_length_off = 2;

// What was entered, and how far it is from the plan.
struct BaseDifference {
    EnteredBase entered;
    EnteredBase planned;
    double shift = 0;
    double turn_deg = 0;
};

struct LengthDifference {
    std::uint16_t tool = 1;
    double entered = 0;
    double planned = 0;
};

struct EnteredDifference {
    std::optional<BaseDifference> base;
    std::vector<LengthDifference> lengths;
};

// Throws InputError (use) for values that no replay is made of: the job has no program, is made for another cell or for
// a gantry, does not use a tool, a tool is named twice, a value is not finite or farther from the planned one than the
// limits above. `job_file` is named in the messages.
EnteredDifference difference_from_plan(const EnteredValues& values, const ReadJob& job, const std::string& job_file,
                                       const Cell& cell);

// What the base of the program is by the plan, whose frames in the cell are `setup_in_cell`. Precondition of this and
// of what follows: the cell has an arm, and difference_from_plan() took the values for it.
Pose planned_base(const Cell& cell, const Setup& setup, const std::vector<Pose>& setup_in_cell);

// The entered base and the planned length of a tool, where another value is entered than the planned one.
std::optional<Pose> other_base(const EnteredValues& values, const Pose& planned);
std::optional<double> other_length(const EnteredLength& entered, const Cell& planned);

}  // namespace qchopper
