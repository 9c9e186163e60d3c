// Where the block of a setup stands on the table, and to which angle a rotary table is turned for each direction.
//
// Values; mm and radians. The default is the middle of the block over the middle of the table, its sides along those
// of the table (tests/cam/setup/placement/machine_reachability_test.cpp).

#pragma once

#include <cstddef>
#include <vector>

#include "base/pose.h"
#include "cam/cell/cell.h"

namespace qchopper {

struct BlockPlacement {
    double x = 0;  // of the block's middle from the table's middle, along the table's axes (at angle 0)
    double y = 0;
    double turn = 0;                   // of the block about the vertical through its middle, from x towards y
    std::vector<double> table_angles;  // of a rotary table, one per direction of the setup; empty: 0 for all
    // Precondition: direction < table_angles.size(), or it is empty.
    double table_angle(std::size_t orientation) const { return table_angles.empty() ? 0 : table_angles[orientation]; }
    bool operator==(const BlockPlacement&) const = default;
};

// The setup frame on the table: shift and turn of the placement, z = 0 at `spoil` above the table's top.
Pose setup_in_table(const BlockPlacement& placement, double spoil);

// The table's frame in the cell: of a rotary table turned by an angle; of a fixed one its middle, whatever the angle.
Pose table_in_cell(const Cell& cell, double angle);

// The setup frame in the cell while a direction is milled; equal to setup_in_cell(cell, spoil) for the default.
Pose setup_in_cell(const Cell& cell, double spoil, const BlockPlacement& placement, std::size_t orientation);

// By how much a block of a size stays inside the table's edge (mm, negative: it hangs over): the least over its
// corners; of a rotary table inside its rim.
double inside_table(const Cell& cell, Vec3 block_size, const BlockPlacement& placement);

}  // namespace qchopper
