// Where on the table of a cell a block of a given size can stand, so that the tool reaches it from above and at a tilt
// from all around.
//
// mm and radians. The poses are those of a block without a piece: its corners and edges on the sides that the tool
// comes to, and above them (milling_poses.h); no tip inside of it. The same for any number of threads
// (tests/cam/setup/placement/block_places_test.cpp).

#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "base/context.h"
#include "cam/cell/cell.h"
#include "cam/setup/placement/machine_reachability.h"

namespace qchopper {

struct BlockPlace {
    double x = 0;  // of the block's middle from the table's middle
    double y = 0;
    bool is_on_table = false;
    // The smallest relative margin of all poses, with the sides of the block along those of the table; nothing: some
    // pose is not held.
    std::optional<double> margin;
};

struct BlockPlaces {
    Vec3 block;
    double tilt = 0;
    double step = 0;                 // between places
    std::size_t columns = 0;         // along x
    std::size_t rows = 0;            // along y
    std::vector<BlockPlace> places;  // row by row, x and y ascending
    MachineReachability best;        // of a search that also turns the block
};

constexpr int block_azimuths = 8;  // of a tilt, 45 degrees apart, the first towards x of the block

// Preconditions: the cell has a machine, lengths of the block and the step are above 0, tilt is 0..pi/2. With tilt 0
// the tool comes straight from above alone. Throws Cancelled.
BlockPlaces block_places(const Cell& cell, Vec3 block, double tilt, double step = 100, const Context& context = {});

}  // namespace qchopper
