// The shells of a mesh: its connected surfaces, with their volumes and boxes.
//
// mm. O(triangles + points). Solids are made of shells in solids.h (tests/segment/mesh/solids_test.cpp).

#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "segment/mesh/measure.h"
#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

constexpr std::size_t triangles_per_block = 128;

// Triangles that share a vertex belong to one shell. Shells are numbered by their first triangle.
struct Shells {
    std::vector<std::uint32_t> shell_of;  // per triangle
    std::vector<double> volume;           // per shell, signed mm3; negative: a cavity, or turned inside out
    std::vector<Box> box;                 // per shell
    std::vector<Box> block;               // per triangles_per_block consecutive triangles: to pass over many at once
    std::size_t count() const { return volume.size(); }
};
Shells shells(const TriangleMesh& mesh);

}  // namespace qchopper
