// Mends places where a mesh runs through itself: takes away a small neighbourhood and closes the hole again.
//
// Triangles that stay keep their order and their bits, new ones come last, points that nothing uses are dropped; no
// point is added or moved. A place that cannot be mended so stays as it was, so there are never more pairs than before,
// and a mesh that was closed stays closed (tests/segment/repair/resolve_test.cpp).

#pragma once

#include <cstddef>
#include <vector>

#include "base/context.h"
#include "segment/mesh/triangle_mesh.h"
#include "segment/repair/source_faces.h"

namespace qchopper {

struct ResolveOptions {
    int rounds = 8;                      // how often a neighbourhood grows by a ring before its place is left as it is
    double most_extent = 0.1;            // of the box's diagonal: no neighbourhood may be wider
    std::size_t passes = 3;              // over the whole mesh: what one place hinders in one pass may go in the next
    std::size_t most_pairs = 1'000'000;  // a mesh with more is left as it is
};

struct Resolved {
    std::size_t pairs = 0;         // of triangles that meet, before; a triangle without area counts as one
    std::size_t left = 0;          // and after
    std::size_t places = 0;        // mended
    std::size_t removed = 0;       // triangles taken away
    std::size_t added = 0;         // triangles put in
    std::size_t dropped = 0;       // points that nothing uses any more
    std::vector<Vec3> where_left;  // places that were not mended, at most 10
};

// The mesh should be manifold (manifold.h) and has no caps; a place at a non-manifold edge or at an open border is
// left.
Resolved resolve_self_intersections(TriangleMesh& mesh, const ResolveOptions& options = {}, const Context& context = {},
                                    SourceFaces* sources = nullptr);

}  // namespace qchopper
