// Moves points apart in which loops touch themselves or each other.
//
// Plane coordinates, mm. A point that touches moves by 1e-10 of the size of the region, away from what it touches: out
// of the material where two parts of the material touch there, into it where two parts of the void do. So the result
// has no contact, and a triangulation of it is one of the given loops, but for slivers as thin as the move
// (tests/segment/objectives/sweep/touching_test.cpp).

#pragma once

#include <optional>
#include <span>
#include <vector>

#include "segment/mesh/polygon.h"

namespace qchopper {

// The points after the move, all of them. The first loop is the outer one and counter-clockwise, the others are its
// holes and clockwise. Nothing if no point touches, or if a loop has another orientation after the move.
std::optional<std::vector<Point2>> without_contacts(std::span<const Point2> points, std::span<const Loop* const> loops);

}  // namespace qchopper
