// The dual graph of a mesh: its triangles, and which are neighbours over an edge.
//
// mm, mm2, radians. Made once for a mesh and given to every method that labels it (methods.h). An edge that has no
// opposite half-edge joins nothing, so open meshes are allowed (tests/segment/regions/face_graph_test.cpp).

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

// Two triangles that share an edge.
struct DualEdge {
    std::array<std::uint32_t, 2> face;   // ascending
    std::array<std::uint32_t, 2> point;  // the ends of the edge
    double length = 0;                   // mm, of the edge
    double path = 0;                     // mm: from centroid to centroid by the middle of the edge
    double turn = 0;                     // radians, 0 to pi: the angle between the normals
    bool is_concave = false;             // seen from outside; false where the turn is 0
};

constexpr std::uint32_t no_dual_edge = std::numeric_limits<std::uint32_t>::max();

struct FaceGraph {
    const TriangleMesh* mesh = nullptr;                // which outlives the graph
    std::vector<DualEdge> edges;                       // by their first half-edge
    std::vector<std::array<std::uint32_t, 3>> around;  // one per triangle: the dual edges at its sides, or no_dual_edge
    std::vector<Vec3> centroid;                        // one per triangle
    std::vector<Vec3> normal;                          // one per triangle: a unit vector; zero if it has no area
    std::vector<double> area;                          // one per triangle
    double diagonal = 0;                               // of the box of the points

    std::size_t size() const { return area.size(); }
    // The triangle on the other side of a dual edge.
    std::uint32_t across(std::uint32_t edge, std::uint32_t face) const {
        return edges[edge].face[0] == face ? edges[edge].face[1] : edges[edge].face[0];
    }
};

// Precondition: the mesh is consistent and has fewer than 2^31/3 triangles. O(triangles).
FaceGraph face_graph(const TriangleMesh& mesh);

// The area's centroid of these triangles, of all if there are none in the list.
Vec3 surface_centroid(const FaceGraph& graph, std::span<const std::uint32_t> faces = {});

// The triangle whose centroid is farthest from a point, and that whose centroid is nearest; the first of equal ones.
// Precondition: there is a triangle.
std::uint32_t farthest_face(const FaceGraph& graph, Vec3 from);
std::uint32_t nearest_face(const FaceGraph& graph, Vec3 from);

}  // namespace qchopper
