// How long a program takes: with the acceleration of the tip, the speeds of the joints, tool changes and table turns.
//
// Seconds; mm. Every straight move has a trapezoid of speed. A corner that is not rounded is a stop; a rounded one is
// passed at the speed at which the acceleration of the cell file holds the tip on the parabola between the points where
// the rounding begins and ends. Joint moves run from stop to stop, all axes together. The spindle's starting and the
// controller's own waiting are not known here (tests/cam/program/program_time_test.cpp).

#pragma once

#include <cstddef>

#include "cam/cell/cell.h"
#include "cam/program/program.h"

namespace qchopper {

struct ProgramTime {
    double cut_s = 0;
    double approach_s = 0;
    double link_s = 0;    // links, retracts, from run to run, raises
    double joint_s = 0;   // joint moves
    double table_s = 0;   // turns of the table
    double change_s = 0;  // tool changes
    double cut_mm = 0;
    double link_mm = 0;
    std::size_t lowered_moves = 0;  // slower than the toolpath asks for, because of a joint
    double total_s() const { return cut_s + approach_s + link_s + joint_s + table_s + change_s; }
    bool operator==(const ProgramTime&) const = default;
};

inline constexpr double tool_change_s = 60;  // by hand, with the check of its length

// Precondition: the program is of the cell. O(moves).
ProgramTime program_time(const Program& program, const Cell& cell);

// Of a joint move with this share of the speed and the acceleration of each axis.
double joint_move_s(const JointRanges& ranges, double share, const Joints& from, const Joints& to);

}  // namespace qchopper
