// The poses that milling a setup needs: positions of the tool tip for every direction, in regions of connected ones.
//
// mm, in setup coordinates. Of each direction the CL surface is the height field of the piece, raised to where the
// holder of the tool with the largest stick-out allows the tip (holder_clearance.h); poses that no height of the tip
// allows are left out, because no program goes there. The direction straight up also mills down to z = 0 beside the
// piece. Directions are milled in their order: of a further one there are poses where the ones before leave foam
// (foam_left.h), and in three squares beside. Further points are, of the first direction, the corners and edges of the
// block above z = 0 on the sides that the tool comes to, where roughing begins, and above all of these the height in
// which the tool comes and goes (tests/cam/setup/placement/milling_poses_test.cpp).

#pragma once

#include <cstddef>
#include <vector>

#include "cam/cell/cell.h"
#include "cam/setup/placement/machine_reachability.h"
#include "cam/setup/setup.h"
#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

struct MillingPose {
    PoseKind kind = PoseKind::tip;
    Vec3 tip;
    // Index in the region of a pose before it, mostly beside it, whose joints are those that its own are compared with:
    // of the turns of an axis the nearest is meant. The first pose of the region has its own index.
    std::size_t beside = 0;
    bool operator==(const MillingPose&) const = default;
};

// Poses between which the tool moves without leaving the block far enough to fold the arm: one configuration holds them
// all.
struct PoseRegion {
    std::vector<MillingPose> poses;  // at least one; the first `extremes` of them bound the others
    std::size_t extremes = 0;
    bool operator==(const PoseRegion&) const = default;
};

struct OrientationPoses {
    Vec3 tool_axis;  // unit, in setup coordinates, from the tip into the spindle
    // The block's corners and edges first, of the first direction; then the parts of the CL surface. Of a further
    // direction that has nothing to mill there is none.
    std::vector<PoseRegion> regions;
    bool operator==(const OrientationPoses&) const = default;
};

struct PoseOptions {
    double step = 20;           // between tips on the piece and along the block's edges
    double retract_step = 100;  // between poses above them
    double map_cell = 0;        // of the height field; 0: an eighth of the step
    bool extremes_only = false;
    bool block_only = false;  // nothing of the piece, whose mesh is not looked at; corners and edges of all directions
};

// Of all directions of a setup, in their order. Preconditions: the cell has a machine, the mesh is that of the piece
// and has area, setup.access.orientations is not empty. Throws as height_field() does. O(directions x (triangles +
// cells)).
std::vector<OrientationPoses> milling_poses(const Setup& setup, const TriangleMesh& mesh, const Cell& cell,
                                            const PoseOptions& options = {});

}  // namespace qchopper
