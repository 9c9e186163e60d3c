// Both forms of fragility for all offsets of one normal in one pass over faces or vertices.
//
// Equal to fragility.h for each offset (tests/segment/score/sweep_test.cpp); one way per face serves all offsets
// that do not cross it.

#pragma once

#include <span>
#include <vector>

#include "segment/score/prepared.h"

namespace qchopper {

// Per offset the sum of thinness before it is divided by the cap area (mm2).
std::vector<double> sweep_thinness(const PreparedPiece& prepared, Vec3 normal, std::span<const double> offsets,
                                   double distance);

std::vector<double> sweep_thesis_fragility(const PreparedPiece& prepared, Vec3 normal, std::span<const double> offsets,
                                           double distance);

}  // namespace qchopper
