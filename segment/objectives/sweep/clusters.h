// Divides a surface into clusters: small connected runs of consecutive triangles, with sums that hold for every normal.
//
// A cluster that lies between two planes is added as a whole. The clusters cover every triangle once and are connected,
// and the cone of each bounds the normals of all its triangles (tests/segment/objectives/sweep/clusters_test.cpp).

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

// The area vector of a triangle (mm2), and the volume of the cone from an origin to it (mm3, signed).
struct TriangleSums {
    Vec3 area;
    double volume = 0;
};

struct Cluster {
    Vec3 axis;             // unit: the mean of its weighted normals; zero if they cancel
    double cone = 2;       // for a normal n with |n.axis| above this, all its triangles face one side; 2: for none
    Vec3 weighted_normal;  // sum over its triangles
    double volume = 0;     // mm3, sum of the cones
    std::uint32_t first_triangle = 0;
    std::uint32_t first_point = 0;  // in Clusters::point
};

struct Clusters {
    std::vector<Cluster> cluster;      // and one more, at which the last one ends
    std::vector<std::uint32_t> point;  // cluster by cluster, each of its points once
    // Per point of the mesh: of the earlier points on a common edge the nearest and the farthest in memory; or itself.
    std::vector<std::array<std::uint32_t, 2>> neighbour;
    std::size_t count() const { return cluster.empty() ? 0 : cluster.size() - 1; }
};

// `sums`: one per triangle, all volumes from one origin. `unit`: empty, or unit normals, one per triangle. The weighted
// normal of a triangle is its unit normal if `unit` is given, else its area vector. At most triangles_per_cluster
// (order.h) triangles form a cluster; only meshes in memory order (order.h) have clusters near that size.
Clusters clusters(const TriangleMesh& mesh, std::span<const TriangleSums> sums, std::span<const Vec3> unit);

}  // namespace qchopper
