// Dowels that hold two pieces together, and the holes for them.
//
// mm. A hole is perpendicular to the cap that it is drilled into and goes equally deep into both pieces. The sizes are
// a list of the workshop (docs/user/cell-file.md); the defaults are those of the specification of joints in foam.

#pragma once

#include <cstddef>
#include <vector>

#include "base/vec3.h"

namespace qchopper {

struct DowelSize {
    double diameter = 0;  // of the hole
    double depth = 0;     // of the hole, in each of the two pieces
    double wall = 0;      // least material left around and below the hole
    double radius() const { return diameter / 2; }
    // What a piece's surface and the axes of thinner holes keep from the axis of a hole.
    double clearance() const { return radius() + wall; }
    bool operator==(const DowelSize&) const = default;
};

inline std::vector<DowelSize> default_dowels() {
    return {{8, 22, 6}, {6, 16, 3}, {4, 12, 2}};
}

// By how much a hole is wider than its dowel.
constexpr double default_dowel_play = 0.3;

struct Dowel {
    DowelSize size;
    Vec3 point;  // of its axis, on the plane of the joint
    bool operator==(const Dowel&) const = default;
};

}  // namespace qchopper
