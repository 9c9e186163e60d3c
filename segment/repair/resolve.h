// Repairs places where a mesh intersects itself: removes a small neighbourhood and fills the hole again.
//
// Triangles that stay keep their order and their bits, new ones come last, points that lose their last triangle are
// dropped; no point is added or moved. A place that cannot be repaired so stays as it was, so there are never more
// pairs than before, and a mesh that was closed stays closed (tests/segment/repair/resolve_test.cpp).

#pragma once

#include <cstddef>
#include <vector>

#include "base/context.h"
#include "segment/mesh/triangle_mesh.h"
#include "segment/repair/source_faces.h"

namespace qchopper {

struct ResolveOptions {
    int rounds = 8;                     // sizes of neighbourhood that are tried at a place, each a ring larger
    double max_extent = 0.1;            // of the box's diagonal: no neighbourhood may be wider
    std::size_t passes = 3;             // over the whole mesh: places near a repaired one wait for the next pass
    std::size_t max_pairs = 1'000'000;  // a mesh with more is left as it is
};

struct Resolved {
    std::size_t pairs = 0;         // of triangles that meet, before; a triangle without area counts as one
    std::size_t left = 0;          // and after
    std::size_t places = 0;        // repaired
    std::size_t removed = 0;       // triangles
    std::size_t added = 0;         // triangles
    std::size_t dropped = 0;       // points that lost their last triangle
    std::vector<Vec3> where_left;  // places that were not repaired, at most 10
};

// Precondition: the mesh has no caps. A place at a non-manifold edge or at an open border is left as it is. Throws
// Cancelled; the mesh is valid then, with the places of whole passes repaired, but may hold unused points.
Resolved resolve_self_intersections(TriangleMesh& mesh, const ResolveOptions& options = {}, const Context& context = {},
                                    SourceFaces* sources = nullptr);

}  // namespace qchopper
