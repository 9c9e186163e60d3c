// Finds where the block of a setup stands best, and checks every pose of its milling there: the work envelope.
//
// Pure functions; the result does not depend on the number of threads. What is maximised is the smallest relative
// margin of all poses (machine_reachability.h). A place that holds is found wherever a scan of 20 cm and 30 degrees
// finds one (tests/cam/setup/placement/place_block_test.cpp; docs/user/envelope.md states how often for a finer scan).

#pragma once

#include <optional>
#include <vector>

#include "base/context.h"
#include "cam/cell/cell.h"
#include "cam/setup/placement/machine_reachability.h"
#include "cam/setup/placement/milling_poses.h"
#include "cam/setup/setup.h"
#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

struct PlacementOptions {
    PoseOptions poses;
    // False: the block stands as Setup::placement says; angles of a rotary table are searched if it names none.
    bool is_searched = true;
    bool has_other_base = true;  // whether a refused piece may be laid otherwise, for MachineReachability::remedy
};

// Preconditions: the mesh is that of the piece, with area; setup.access.orientations is not empty. A cell without a
// machine is not checked. Throws InputError (use) as height_field() does, and Cancelled.
MachineReachability place_block(const Setup& setup, const TriangleMesh& mesh, const Cell& cell,
                                const PlacementOptions& options = {}, const Context& context = {});

// The same for given poses, at least one direction of them, in the order of the setup's directions.
MachineReachability place_block(const Setup& setup, const std::vector<OrientationPoses>& orientations, const Cell& cell,
                                const PlacementOptions& options = {}, const Context& context = {});

// The first place of a coarse grid (100 mm, 30 degrees) at which all poses are held, `first` being tried before them:
// far quicker than place_block() where none is. Nothing: there is none in that grid. Precondition: the cell has a
// machine.
std::optional<BlockPlacement> first_place(const Setup& setup, const std::vector<OrientationPoses>& orientations,
                                          const Cell& cell, const BlockPlacement& first = {},
                                          const Context& context = {});

// Whether the machine holds the extreme poses of a setup at some place: the stop rule --fits-cell beyond boxes. Asks
// for the corners of the block and the outermost tips of each direction alone, and ends at the first place that holds
// them. True for a cell without a machine.
bool fits_machine(const Setup& setup, const TriangleMesh& mesh, const Cell& cell);

}  // namespace qchopper
