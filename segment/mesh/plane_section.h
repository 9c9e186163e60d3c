// The section of a mesh by a plane, for the cut, the sweep and the outline.
//
// mm. The side of a point is decided by height() in plane.h alone; a point at the plane's height is above. The point of
// a crossed edge is computed from its upper end, so that both triangles, and every caller, get the same bits
// (tests/segment/objectives/sweep/touching_test.cpp, tests/app/engine/outline_test.cpp).

#pragma once

#include <cassert>
#include <cstdint>
#include <span>
#include <vector>

#include "segment/mesh/plane.h"
#include "segment/mesh/plane_frame.h"
#include "segment/mesh/polygon.h"
#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

// A crossed triangle: one corner, the apex, lies alone on its side of the plane.
struct TriangleCrossing {
    std::uint32_t apex = 0;  // 0..2
    bool apex_is_above = false;
    // The edges, by the corner that they start at, that run downwards and upwards through the plane.
    std::uint32_t exit() const { return apex_is_above ? apex : (apex + 2) % 3; }
    std::uint32_t entry() const { return apex_is_above ? (apex + 2) % 3 : apex; }
};

// Precondition: the corners are not all on one side.
inline TriangleCrossing triangle_crossing(bool above_0, bool above_1, bool above_2) {
    const bool apex_is_above = above_0 + above_1 + above_2 == 1;
    const std::uint32_t apex = above_0 == apex_is_above ? 0 : above_1 == apex_is_above ? 1 : 2;
    assert(above_0 + above_1 + above_2 == (apex_is_above ? 1 : 2));
    return {apex, apex_is_above};
}

struct EdgeEnd {
    Vec3 point;
    double height = 0;
};

// The point of an edge at the height `offset`. Precondition: the upper end is at or above it, the lower one below.
inline Vec3 edge_crossing(const EdgeEnd& upper, const EdgeEnd& lower, double offset) {
    assert(upper.height >= offset && lower.height < offset);
    return upper.point + ((upper.height - offset) / (upper.height - lower.height)) * (lower.point - upper.point);
}

// The coordinates of a point in a plane frame at an origin.
inline Point2 flattened(const PlaneFrame& frame, Vec3 origin, Vec3 point) {
    const Vec3 d = point - origin;
    return {dot(frame.u, d), dot(frame.v, d)};
}

// The cycles of a permutation, in the order of their least members.
struct Cycles {
    struct Cycle {
        std::uint32_t first = 0;  // the least member
        std::uint32_t size = 0;
    };
    std::vector<std::uint32_t> cycle_of;  // one per member: the number of its cycle
    std::vector<Cycle> cycles;
    std::vector<std::uint32_t> order;  // the members cycle by cycle, each from its first one on
};
// `next` has one entry per member: the one that follows. O(members).
Cycles cycles(std::span<const std::uint32_t> next);

struct SectionTriangle {
    std::uint32_t triangle = 0;
    TriangleCrossing crossing;
    std::uint32_t exit_point = 0;   // index in PlaneSection::points, on the exit edge
    std::uint32_t entry_point = 0;  // on the entry edge
};

struct PlaneSection {
    std::vector<SectionTriangle> triangles;  // ascending
    std::vector<Vec3> points;                // one per crossed edge
    std::vector<Loop> loops;  // indices of points, counter-clockwise around material seen against the normal
};

// One flag per point of the mesh: 1 if it is above the plane, else 0.
std::vector<std::uint8_t> points_above(const TriangleMesh& mesh, const Plane& plane);

// Empty if the plane misses the mesh. `is_above` is points_above of the same mesh and plane. Throws InputError (mesh)
// if the mesh is open where the plane passes. O(triangles + c log c) for c crossed triangles.
PlaneSection plane_section(const TriangleMesh& mesh, const Plane& plane, std::span<const std::uint8_t> is_above);

}  // namespace qchopper
