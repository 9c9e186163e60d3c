// Displacements of bricks under loads: one brick (brick.h) a voxel, all alike, solved by conjugate gradients.
//
// In units of the brick: lengths in voxels, a modulus of 1, a load of 1 is the force of 1 MPa on the face of a voxel.
// The displacement in mm is that times h/E, so that stress does not depend on the modulus. The same bits for any number
// of threads (tests/segment/structure/displacements_test.cpp).

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/context.h"
#include "segment/structure/brick.h"
#include "segment/structure/voxels.h"

namespace qchopper {

// The corners of voxels. A node is numbered as in a grid with one more place along each axis.
struct BrickNodes {
    VoxelPlace count{0, 0, 0};          // along each axis
    std::vector<std::uint32_t> number;  // of the nodes that a voxel has, ascending
    std::vector<std::uint8_t> voxels;   // per node, bit x + 2 y + 4 z: the voxel there, seen from the node
    std::vector<std::array<std::uint32_t, 8>> corners;  // per voxel: positions in `number`, numbered as in brick.h
    VoxelPlace place(std::uint32_t node) const {
        return {number[node] % count[0], number[node] / count[0] % count[1], number[node] / count[0] / count[1]};
    }
    // Whether a voxel is missing beside it.
    bool is_exterior(std::uint32_t node) const { return voxels[node] != 0xFF; }
};
BrickNodes brick_nodes(const VoxelGrid& grid, const std::vector<std::uint32_t>& voxels);

struct BrickLoads {
    std::vector<Vec3> load;             // per node, along the axes of the grid
    std::vector<std::uint8_t> is_held;  // per node, bit of each axis: it does not move along it
};

struct Displacements {
    std::vector<Vec3> of_node;
    std::size_t unknowns = 0;  // degrees of freedom that are not held
    std::size_t iterations = 0;
    double residual = 0;  // relative: of the loads
    bool has_converged = false;
};

struct SolveOptions {
    double residual = 1e-6;
    std::size_t max_iterations = 50'000;
};

// Preconditions: the loads are those of the nodes, and every part of the voxels that is joined by faces is held so that
// it cannot move as a whole: else the residual stalls, and has_converged is false. Reports progress in iterations;
// throws Cancelled.
Displacements solve(const BrickNodes& nodes, const Brick& brick, const BrickLoads& loads, const SolveOptions& options,
                    const Context& context);

}  // namespace qchopper
