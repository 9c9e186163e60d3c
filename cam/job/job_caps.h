// Which caps of a piece are joined, and who drills their holes.
//
// Tests: tests/cam/job/job_caps_test.cpp.

#pragma once

#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "cam/cell/cell.h"
#include "cam/job/job_cap.h"
#include "cam/setup/setup.h"
#include "segment/joint/piece_joints.h"

namespace qchopper {

// The caps of piece number `index` that have joints, in the order of the cuts. A hole is for the hand if its
// cap is the base or a sawn side of the block, or the tool may not lean so far; of the others no reason is given yet,
// and who drills them is decided with the program (JobHole::by_hand).
std::vector<DrawnCap> caps_of(std::span<const Piece> pieces, std::size_t index, std::span<const PieceJoint> joints,
                              const Setup& setup, const Cell& cell);

// Says of every hole who drills it: the robot those of the numbers `drilled`, ascending; the others are for the hand,
// because of the reason that they have already, or that of their number, or else `because`.
void decide_holes(std::vector<DrawnCap>& caps, const std::vector<std::size_t>& drilled,
                  const std::map<std::size_t, std::string>& reasons, const std::string& because);

}  // namespace qchopper
