// The voxels of a closed mesh: the cubes of a grid whose centres lie inside it.
//
// mm. The third axis of the grid is the upright direction. A voxel is known by its number in the grid; lists of voxels
// ascend. Voxels of a piece on the grid of the scan are a subset of the scan's
// (tests/segment/structure/voxels_test.cpp).

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

using VoxelPlace = std::array<std::uint32_t, 3>;  // column, row, layer

struct VoxelGrid {
    std::array<Vec3, 3> axis{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};  // orthonormal, right-handed
    Vec3 corner;                                                            // the lowest, along these axes
    double size = 1;                                                        // of a voxel, above 0
    VoxelPlace count{0, 0, 0};                                              // along each axis
    bool operator==(const VoxelGrid&) const = default;

    // Coordinates along the axes, in voxels from the corner.
    Vec3 local(Vec3 point) const {
        const Vec3 along{dot(axis[0], point), dot(axis[1], point), dot(axis[2], point)};
        return (1 / size) * (along - corner);
    }
    std::uint32_t number(const VoxelPlace& at) const { return (at[2] * count[1] + at[1]) * count[0] + at[0]; }
    VoxelPlace place(std::uint32_t number) const {
        return {number % count[0], number / count[0] % count[1], number / count[0] / count[1]};
    }
    // The centre of a voxel in the coordinates of the mesh.
    Vec3 centre(std::uint32_t number) const;
};

// More cells a grid may not have: a number of 32 bits each, and a table of them in memory.
constexpr double max_voxel_cells = 2.5e8;

// A grid around all points. Voxels of `size` that go a whole number of times into the extent, to 1e-6, leave no rest;
// else the rest is beyond the upper ends. `up` need not be of length 1. Throws InputError (use) if the grid would have
// more than max_voxel_cells cells. Preconditions: the mesh has points, up is not zero, size is above 0.
VoxelGrid voxel_grid(const TriangleMesh& mesh, Vec3 up, double size);

// The numbers of the voxels whose centres lie inside, ascending. Precondition: the mesh is closed (edges.h), outwards.
// A point is inside where the surface winds around it more than 0 times: solids that overlap are one. Parts of the mesh
// outside the grid are left out. O(triangles + crossings of the lines through the centres, sorted per line).
std::vector<std::uint32_t> voxels_inside(const TriangleMesh& mesh, const VoxelGrid& grid);

constexpr std::uint32_t no_voxel = 0xFFFFFFFF;

// Per voxel of a list the positions in the list of those beside it: -x, +x, -y, +y, -z, +z, or no_voxel.
using VoxelNeighbours = std::array<std::uint32_t, 6>;
std::vector<VoxelNeighbours> voxel_neighbours(const VoxelGrid& grid, const std::vector<std::uint32_t>& voxels);

// Per voxel of a list 1 if it is in a block of 3 x 3 x 3 voxels of the list: what is not is under 3 voxels thick. A
// wall of the thickness t that is oblique to the grid holds such a block for sure if t is over 5.2 voxels.
std::vector<std::uint8_t> thick_voxels(const VoxelGrid& grid, const std::vector<std::uint32_t>& voxels);

}  // namespace qchopper
