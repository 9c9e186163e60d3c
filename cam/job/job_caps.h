// Which caps of a piece are joined, and who drills their holes.
//
// Tests: tests/cam/job/job_caps_test.cpp.

#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "cam/cell/cell.h"
#include "cam/job/job_cap.h"
#include "cam/setup/setup.h"
#include "segment/joint/piece_joints.h"

namespace qchopper {

// The caps of piece number `index` that have joints, in the order of the cuts. A hole is the robot's if its cap is not
// the base, the tool may lean and the arm holds it along the cap's normal (held_directions.h), and a tool fits into the
// hole and is long enough.
std::vector<DrawnCap> caps_of(std::span<const Piece> pieces, std::size_t index, std::span<const PieceJoint> joints,
                              const Setup& setup, const Cell& cell);

}  // namespace qchopper
