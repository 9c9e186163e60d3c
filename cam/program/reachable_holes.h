// Which holes of a drilling the arm can hold, and to which angle a rotary table is turned for them.
//
// mm, radians. A hole that no arm configuration takes is left to the hand, with what refuses it.
// tests/cam/program/reachable_holes_test.cpp.

#pragma once

#include <cstddef>
#include <string>

#include "base/context.h"
#include "cam/cell/cell.h"
#include "cam/setup/placement/machine_reachability.h"
#include "cam/setup/setup.h"
#include "cam/toolpath/drilling.h"

namespace qchopper {

// Takes from the operations the holes that the arm does not hold, and operations without holes; gives the directions
// their table angles: of those tried the first at which most holes are held. They are those that turn the hole to where
// the arm mills another direction of the setup, those of these directions, and steps of 15 degrees. Preconditions:
// the drilling is of this setup, the cell has a machine. O(angles * holes * poses) answers of the arm.
void keep_reachable_holes(Drilling& drilling, const Setup& setup, const MachineReachability& reachability,
                          const Cell& cell, const Context& context = {});

// Leaves a hole to the hand for this reason; its operation and its direction go with it if no other hole needs them.
// Precondition: the drilling has this hole and is of this setup.
void leave_to_hand(Drilling& drilling, std::size_t number, const std::string& reason, const Setup& setup);

}  // namespace qchopper
