// Reduces the faces of a closed mesh by collapsing edges; locked points, and faces with locked points only, stay.
//
// mm. An edge collapses to one of its points, so no point moves. No face turns by more than 60 degrees in a collapse or
// becomes a needle (tests/segment/simplify/simplify_test.cpp). Same input, same bytes.

#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "base/context.h"
#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

struct CollapseLimits {
    // mm: points that are removed stay within this distance of the faces around, and the root of the quadric error,
    // which is summed over the planes of all faces that a point represents, below `planes` times this. Nothing: no
    // limit.
    std::optional<double> distance;
    double planes = 2;
    std::size_t max_faces = 0;  // the collapses stop at this number
};

// `is_locked` has one flag per point, or is empty: then no point is locked. Faces that stay keep their order, their
// caps and, where it stays, their first corner; points keep their order. False if the surface is not manifold, which
// half-edges cannot represent: the mesh is unchanged then. Throws Cancelled (base/context.h); the mesh is unchanged
// then as well.
bool collapse_edges(TriangleMesh& mesh, const std::vector<std::uint8_t>& is_locked, const CollapseLimits& limits,
                    const Context& context = {});

}  // namespace qchopper
