// Where foam stands after the orientations so far, if a flat end has been everywhere that it can go: the foam that
// poses of a further orientation are for.
//
// mm. For choosing poses, which stand for squares of some 20 mm: a point counts as free where the tool came to one of
// the nine cells about it, so that a wall along a tool axis is not taken for foam; what is thinner than a cell is not
// seen (tests/cam/setup/placement/foam_left_test.cpp). The foam of a toolpath is cam/stock/in_process_stock.h.
// There each tool comes from all orientations before the next one, so the radius is that of the widest.

#pragma once

#include <vector>

#include "base/pose.h"
#include "segment/raster/height_field.h"

namespace qchopper {

class FoamLeft {
 public:
    FoamLeft(const Pose& piece_in_setup, double tool_radius)
        : setup_in_piece_(inverse(piece_in_setup)), tool_radius_(tool_radius) {}

    // All is gone above the closing of a surface by the tool, and with `clears_beside` all beside its map.
    // Precondition: it is a map of the piece. O(cells * radius / cell).
    void remove_above(HeightField surface, bool clears_beside);

    // Whether foam stands at a point in setup coordinates that is neither in the piece nor outside of the block.
    // O(orientations).
    bool stands_at(Vec3 point) const;

 private:
    struct Removed {
        Pose setup_in_field;
        HeightField cl;  // of each cell the lowest of the nine about it
        bool clears_beside;
    };
    Pose setup_in_piece_;
    double tool_radius_;
    std::vector<Removed> removed_;
};

}  // namespace qchopper
