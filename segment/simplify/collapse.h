// Takes faces out of a closed mesh by collapsing edges; locked points and what lies between them stay.
//
// Edges go in the order of the quadric error (Garland and Heckbert 1997) and end in one of their points, so no point
// moves. No face turns by more than 60 degrees in a collapse or becomes a needle
// (tests/segment/simplify/simplify_test.cpp).

#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "base/context.h"
#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

struct CollapseLimits {
    // mm: points taken out stay that close to the faces around, and the root of the quadric error, which sums over the
    // planes of all faces that a point stands for, stays below so many times that. Nothing: no limit.
    std::optional<double> distance;
    double planes = 2;
    std::size_t most_faces = 0;  // stop there
};

// `is_locked` has a flag for every point, or is empty: then none is. Faces that are left keep their order, corners and
// caps; points their order. False, and nothing changes, where the surface folds onto itself in a way that half-edges
// cannot tell.
bool collapse_edges(TriangleMesh& mesh, const std::vector<std::uint8_t>& is_locked, const CollapseLimits& limits,
                    const Context& context = {});

}  // namespace qchopper
