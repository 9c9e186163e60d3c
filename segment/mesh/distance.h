// One-sided Hausdorff distances between two meshes, and the deviation of a repaired mesh from its scan.
//
// Lengths are mm. A distance is measured from given triangles, edges and interiors included, to the whole other
// surface: `mm` is found at a point, and `at_most` bounds the true value from above. The result does not depend on the
// number of threads (tests/segment/mesh/distance_test.cpp). All functions throw Cancelled (base/context.h) when
// cancelled.

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "base/context.h"
#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

struct DistanceOptions {
    // The search ends when at_most - mm is at most the larger of these two.
    double tolerance = 0.01;  // share of mm
    double tolerance_mm = 1e-4;
    std::size_t max_points = 6'000'000;  // or when so many points are evaluated; at_most is a bound then as well
};

struct OneSidedDistance {
    double mm = 0;
    double at_most = 0;
    Vec3 at;                    // the point that far from the other surface
    std::size_t triangles = 0;  // from which the distance is measured
};

// From these triangles of `from` to the surface of `to`: 0 without triangles in the list, infinite without triangles in
// `to`.
OneSidedDistance one_sided_distance(const TriangleMesh& from, std::span<const std::uint32_t> triangles,
                                    const TriangleMesh& to, const DistanceOptions& options = {},
                                    const Context& context = {});

// Triangles that both meshes have, by the coordinates of their corners in any order, have not changed and are left out.
struct Deviation {
    OneSidedDistance from_scan;    // from triangles of the scan that the result does not have
    OneSidedDistance from_result;  // from triangles of the result that the scan does not have
    const OneSidedDistance& largest() const { return from_scan.mm >= from_result.mm ? from_scan : from_result; }
};

// Both meshes are in the same frame.
Deviation deviation(const TriangleMesh& scan, const TriangleMesh& result, const DistanceOptions& options = {},
                    const Context& context = {});

}  // namespace qchopper
