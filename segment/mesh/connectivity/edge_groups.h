// Groups all half-edges of a mesh by their undirected edge.
//
// For meshes that are not manifold: edges.h pairs the half-edges of manifold edges and only counts the others. A group
// is a list of half-edges (tests/segment/repair/split_non_manifold_test.cpp).

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "segment/mesh/connectivity/index_lists.h"
#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

// One list per edge: its half-edges, ascending. Edges are in the order of their smaller, then of their larger end
// point.
IndexLists edge_groups(const TriangleMesh& mesh);

// A half-edge with the angle of its triangle about the edge.
struct AtAngle {
    double angle;  // radians, -pi to pi
    std::uint32_t half_edge;
};

// The half-edges of one group, which is not empty, by ascending angle, then by number. Angles are right-handed about
// the direction from the smaller end point to the larger one. The first of the group has angle 0, and so have triangles
// too large for their angle to be computed.
std::vector<AtAngle> around_edge(const TriangleMesh& mesh, std::span<const std::uint32_t> group);

}  // namespace qchopper
