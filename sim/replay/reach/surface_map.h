// Heights over the plane of one direction's frame.
//
// mm.

#pragma once

#include <cstdint>
#include <vector>

#include "base/pose.h"

namespace qchopper {

constexpr float no_surface = -1e30F;

struct SurfaceMap {
    Pose frame_in_setup;
    double x_min = 0;  // corner of the first cell
    double y_min = 0;
    double cell = 1;
    std::int32_t columns = 0;
    std::int32_t rows = 0;
    std::vector<float>
        height;  // at the centres of cells, row by row; no_surface: nothing is there, -no_surface: not known
    bool is_limited = false;  // holder or spindle keep the tool higher somewhere
    double at(double x, double y) const;
    // The greatest height of the cell of a point and of the eight beside it; outside of the map nothing is there.
    double highest_about(double x, double y) const;
    // Distance from a point of the frame to the nearest point above the surface, at most `most`; cells count at their
    // centres.
    double distance_above(Vec3 point, double most) const;
};

}  // namespace qchopper
