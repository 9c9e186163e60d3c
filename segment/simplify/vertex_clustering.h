// Reduces a mesh for display: the points in one cell of a grid become one point. The fastest way, and for any mesh.
//
// mm. Nothing is promised but the distance: holes and thin walls may close, the result may be open or not manifold, and
// parts smaller than a cell vanish. What is cut or measured is reduced by simplify.h. Same input, same bytes, whatever
// the number of threads (tests/segment/simplify/vertex_clustering_test.cpp).

#pragma once

#include <cstddef>

#include "base/context.h"
#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

// Whether two corners of a triangle are one point.
inline bool has_equal_corners(const Triangle& t) {
    return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
}

struct ClusteredMesh {
    TriangleMesh mesh;
    double cell = 0;           // mm: side of the cells; 0: the mesh had few enough faces and is as it was
    double largest_shift = 0;  // mm: from a point to the one that it became; no face that stays shifts farther
};

// The cells are cubes, counted from the least corner of the points' box. A point of the result is the mean of those in
// a cell; they come in the order of the first one in each, those without a face are left out. Faces that keep three
// different corners stay in their order, with their caps; of faces with the same corners in the same sense and of the
// same cap only the first stays. Preconditions: coordinates are finite; 0 < cell, and the box is at most 2^31 cells
// long. Throws Cancelled. O(points + faces).
ClusteredMesh cluster_vertices(const TriangleMesh& mesh, double cell, const Context& context = {});

// The same with a cell that leaves about so many faces, at least 1: of a mesh that is much finer than that within a
// fifth. A mesh with no more faces stays as it is.
ClusteredMesh cluster_to(std::size_t faces, const TriangleMesh& mesh, const Context& context = {});

}  // namespace qchopper
