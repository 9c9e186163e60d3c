// Moves the points in which loops touch themselves or each other apart, so that a triangulation of what is left without
// contact is one of the loops as they are, but for slivers as thin as the move.
//
// Plane coordinates, mm. A point that touches moves by 1e-10 of the region's size, away from what it touches: out of
// the material where the material is non-manifold there, into it where the void is
// (tests/segment/score/touching_test.cpp).

#pragma once

#include <optional>
#include <span>
#include <vector>

#include "segment/mesh/polygon.h"

namespace qchopper {

// The points after the move. Nothing if no point touches, or if a loop then runs the wrong way round: counter-clockwise
// is the first one, the outer; clockwise are the others, its holes.
std::optional<std::vector<Point2>> without_contacts(std::span<const Point2> points, std::span<const Loop* const> loops);

}  // namespace qchopper
