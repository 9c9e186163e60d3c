// Finds all pairs of triangles that meet anywhere else than in the corners and edges that they share.
//
// Corners are shared when their coordinates are equal, whatever their numbers, so surfaces that only touch in a point
// or an edge do not count. Two triangles that share an edge count when they lie in one plane on the same side of it,
// and those that share all corners always count. Decided exactly on the coordinates as they are. On a mesh without
// repeated points the pairs are those of CGAL's self_intersections
// (tests/segment/repair/intersections/self_intersections_test.cpp).

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/context.h"
#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

struct SelfIntersectionOptions {
    // The search ends soon after so many pairs are found or so many boxes compared: in a soup all may meet all.
    std::size_t max_pairs = 4'000'000;
    std::size_t max_comparisons = 5'000'000'000;
};

struct SelfIntersections {
    std::vector<std::array<std::uint32_t, 2>> pairs;  // smaller number first; ascending
    std::vector<std::uint32_t> without_area;          // triangles on one line: only here, never in a pair; ascending
    bool is_complete = true;                          // false: the search ended at a limit, there may be more
    bool is_free() const { return pairs.empty() && without_area.empty(); }
};

// Runs on all cores; the result does not depend on their number, also where the search ends at a limit. Throws
// Cancelled.
SelfIntersections self_intersections(const TriangleMesh& mesh, const SelfIntersectionOptions& options = {},
                                     const Context& context = {});

// A point near the intersection of two triangles: the centre of what their boxes have in common.
Vec3 meeting_place(const TriangleMesh& mesh, const std::array<std::uint32_t, 2>& pair);

}  // namespace qchopper
