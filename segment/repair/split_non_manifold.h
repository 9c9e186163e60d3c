// Makes a manifold of a mesh in which edges have more than two faces, or neighbours are oriented differently.
//
// Every edge gets at most two faces, which run along it in opposite directions, and every point one fan of faces: of a
// point with several fans each but the first gets a copy, at the end of the points. Faces keep their order; only their
// orientation may change. A weld and a second call change nothing (tests/segment/repair/split_non_manifold_test.cpp).

#pragma once

#include <cstddef>

#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

struct SplitOptions {
    bool turn = true;    // turn faces so that neighbours agree; else the surface is cut open between them
    bool stitch = true;  // join borders that coincide and belong to components not joined otherwise
};

struct SplitCounts {
    std::size_t edges_split = 0;       // edges of three faces or more
    std::size_t edges_cut = 0;         // cut open because the surface there is one-sided, or may not be turned
    std::size_t stitched = 0;          // edges at which two components were joined
    std::size_t faces_reoriented = 0;  // to agree with their neighbours: the fewest of each component
    std::size_t copies = 0;            // of points
};

// Precondition: equal points are welded.
SplitCounts split_non_manifold(TriangleMesh& mesh, const SplitOptions& options = {});

}  // namespace qchopper
