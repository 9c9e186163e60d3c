// Drills the holes of the dowels into the mesh of a piece.
//
// mm. A hole is a straight prism on a regular polygon of 32 corners, which lie on the circle of its diameter. The
// result is closed, and its volume is that of the piece less that of the prisms, to rounding. Caps keep their labels;
// walls and bottoms of holes are of no cap (tests/segment/joint/drill_test.cpp).

#pragma once

#include <span>

#include "segment/cut/piece.h"
#include "segment/joint/piece_joints.h"

namespace qchopper {

constexpr std::size_t hole_sides = 32;

// The piece with number `index`, with the holes of all its joints. Precondition: `joints` are those of the pieces.
// O(triangles + c log c) for c corners of caps.
TriangleMesh drilled(const Piece& piece, std::size_t index, std::span<const PieceJoint> joints);

}  // namespace qchopper
