// All half-edges of a mesh, grouped by the edge that they run along, whichever way.
//
// For meshes that are not manifold: edges.h pairs what is sound and only counts the rest
// (tests/segment/repair/sheets_test.cpp).

#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "segment/mesh/index_lists.h"
#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

// Per edge its half-edges. Edges are in the order of their smaller, then of their larger end point; half-edges of one
// are ascending.
IndexLists edge_groups(const TriangleMesh& mesh);

// A half-edge with the angle at which its triangle stands about the edge.
struct AtAngle {
    double angle;
    std::uint32_t half_edge;
};

// The half-edges of one group about their edge, seen along it from the smaller end to the larger: ascending angles turn
// left. The angle of the first of the group is 0.
std::vector<AtAngle> around_edge(const TriangleMesh& mesh, std::span<const std::uint32_t> group);

}  // namespace qchopper
