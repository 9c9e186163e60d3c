// Divides a surface into small connected patches of consecutive triangles, and keeps of each what a sweep can use
// whatever the normal.
//
// A patch that lies between two planes is taken as a whole. The patches cover every triangle once, and what a patch
// says of its triangles holds for every normal (tests/segment/score/patches_test.cpp).

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

// The area vector of a triangle (mm2), and the volume of the cone from `origin` to it (mm3).
struct TriangleSums {
    Vec3 area;
    double volume = 0;
};

struct Patch {
    Vec3 axis;          // unit: the mean direction in which its triangles look
    double cone = 2;    // a normal n with |n.axis| over this has all its triangles on one side; 2: none has
    Vec3 look;          // sum over its triangles
    double volume = 0;  // mm3, of the cones
    std::uint32_t first_triangle = 0;
    std::uint32_t first_point = 0;  // in Patches::point
};

struct Patches {
    std::vector<Patch> patch;          // and one more, where the last one ends
    std::vector<std::uint32_t> point;  // patch by patch, each point of it once
    // Per point of the mesh, of the earlier ones on a common edge, the nearest in memory and the farthest; or itself.
    std::vector<std::array<std::uint32_t, 2>> neighbour;
    std::size_t count() const { return patch.empty() ? 0 : patch.size() - 1; }
};

// What a triangle looks like is its area vector, or its unit normal if `unit` is not empty. Meshes in memory order
// (order.h) make few patches; in any other order they are right, but small.
Patches patches(const TriangleMesh& mesh, std::span<const TriangleSums> sums, std::span<const Vec3> unit);

}  // namespace qchopper
