// The corner that a controller may round, in its worst case.
//
// mm. The corner at P is replaced by the parabola with the tangents P - a * d1 and P + a * d2, where a is the smallest
// of $APO.CDIS and half of each move; its largest deviation from P is a * cos(b / 2) / 2 with b the angle between the
// moves: the middle of a quadratic Bezier curve. The true curve of the controller is not
// published. O(1) (tests/sim/program/rounded_corner_test.cpp).

#pragma once

#include <array>

#include "base/vec3.h"

namespace qchopper {

struct RoundedCorner {
    Vec3 before;  // where the line to the corner is left
    Vec3 corner;
    Vec3 after;            // where the line from it begins
    double a = 0;          // distance of both from the corner; 0: it is not rounded
    double deviation = 0;  // of the parabola from the corner point
    double radius = 0;     // of curvature in the middle; infinite where the moves go straight on
    // A point of the parabola, 0 <= t <= 1.
    Vec3 at(double t) const { return (1 - t) * (1 - t) * before + 2 * t * (1 - t) * corner + t * t * after; }
};

// Of the moves from -> corner -> to. Moves without length are not rounded.
RoundedCorner round_corner(Vec3 from, Vec3 corner, Vec3 to, double distance);

}  // namespace qchopper
