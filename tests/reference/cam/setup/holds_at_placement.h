// Whether all poses of a setup are held where its block stands: what place_block() (cam/setup/placement/place_block.h)
// is held against, place by place.
//
// mm.

#pragma once

#include <vector>

#include "cam/cell/cell.h"
#include "cam/setup/placement/milling_poses.h"
#include "cam/setup/setup.h"

namespace qchopper {

// At Setup::placement; angles of a rotary table are searched if it names none. Quicker than a report of place_block(),
// because it ends at the first pose that is not held. Preconditions: the cell has a machine, there is a direction.
bool holds_at_placement(const Setup& setup, const std::vector<OrientationPoses>& orientations, const Cell& cell);

}  // namespace qchopper
