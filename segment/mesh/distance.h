// How far one mesh is from another: the largest distance from what changed to the other surface, both ways.
//
// Lengths are mm. Triangles that both meshes have, by the coordinates of their corners and whichever way they are
// turned, have not changed. A way is the one-sided Hausdorff distance from the changed triangles, edges and insides
// included, to the whole other surface: `mm` is found at a point, and `at_most` bounds it from above
// (tests/segment/mesh/distance_test.cpp).

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "base/context.h"
#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

struct DistanceOptions {
    double tolerance = 0.01;              // at_most - mm may be this share of mm,
    double tolerance_mm = 1e-4;           // or this
    std::size_t most_points = 6'000'000;  // points looked at; at_most is what is known then
};

struct Farthest {
    double mm = 0;
    double at_most = 0;
    Vec3 at;                    // the point that far from the other surface
    std::size_t triangles = 0;  // looked at: how many have changed
};

// From these triangles of `from` to the surface of `to`. Infinite when `to` has no triangle and there is one to look
// at.
Farthest farthest(const TriangleMesh& from, std::span<const std::uint32_t> triangles, const TriangleMesh& to,
                  const DistanceOptions& options = {}, const Context& context = {});

struct Deviation {
    Farthest from_scan;    // from triangles of the scan that the result has no more
    Farthest from_result;  // from triangles of the result that the scan does not have
    const Farthest& largest() const { return from_scan.mm >= from_result.mm ? from_scan : from_result; }
};

// Both meshes about the same origin.
Deviation deviation(const TriangleMesh& scan, const TriangleMesh& result, const DistanceOptions& options = {},
                    const Context& context = {});

// The largest distance of samples of `from` (corners, middles of edges, insides of faces) to the surface `to`; both
// have triangles. A face is divided until its samples lie as dense as the corners of the other mesh do on the average,
// so that a large face over many small ones is looked at everywhere (tests/segment/simplify/simplify_test.cpp).
double farthest_sample(const TriangleMesh& from, const TriangleMesh& to, const Context& context = {});

}  // namespace qchopper
