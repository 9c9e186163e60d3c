// Whether one solid is in front of another along a direction: some line along it meets the other first and then the
// one.
//
// mm. Decided by triangles that lie over each other, not by samples: their outlines are clipped against each other, and
// the heights are compared in the middle of what both cover. Triangles that cover less than 1e-6 mm2 of each other, or
// lie within 1e-6 mm, do not count (tests/segment/joint/assembly_test.cpp).

#pragma once

#include <span>
#include <vector>

#include "segment/mesh/triangle_mesh.h"
#include "segment/mesh/triangle_tree.h"

namespace qchopper {

// Solids turned so that the direction is z.
class TurnedSolid {
 public:
    // The meshes together are the solid.
    TurnedSolid(std::span<const TriangleMesh* const> meshes, Vec3 direction);
    const TriangleMesh& mesh() const { return mesh_; }
    const TriangleTree& tree() const { return tree_; }
    double low() const { return low_; }  // least height along the direction
    double high() const { return high_; }

 private:
    TriangleMesh mesh_;
    TriangleTree tree_;
    double low_ = 0;
    double high_ = 0;
};

struct InFront {
    bool first = false;   // the first solid is in front of the second: farther along the direction
    bool second = false;  // the second is in front of the first
};

// Precondition: both were turned for the same direction, and they do not overlap. O(pairs of triangles that lie over
// each other).
InFront in_front(const TurnedSolid& first, const TurnedSolid& second);

}  // namespace qchopper
