// Finds the shells of a mesh, its connected surfaces, with their volumes and boxes.
//
// mm. solids.h groups them to solids (tests/segment/mesh/connectivity/solids_test.cpp).

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
    std::vector<std::uint32_t> shell_of;  // one per triangle: its shell
    std::vector<double> volume;           // one per shell, signed mm3; negative: a cavity, or inside out
    std::vector<Box> box;                 // one per shell
    std::vector<Box> block;  // one per triangles_per_block consecutive triangles, to pass over many at once
    std::size_t count() const { return volume.size(); }
};
// The volumes are exact only for closed shells.
Shells shells(const TriangleMesh& mesh);

}  // namespace qchopper
