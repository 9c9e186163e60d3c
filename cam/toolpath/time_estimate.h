// How long a toolpath takes on a machine whose tip accelerates no faster than it can.
//
// Seconds; lengths in mm, speeds in mm/s. Each straight move has a trapezoid of speed; a corner that is not rounded is
// a stop, and a rounded one is passed at the speed that the acceleration allows on a parabola between the points where
// the rounding begins and ends. Joints are not known here.

#pragma once

#include <functional>
#include <span>

#include "cam/toolpath/toolpath.h"

namespace qchopper {

struct TimeSettings {
    double acceleration = 2000;  // mm/s2, along the path
    double tool_change_s = 60;   // for each change to another tool
    double direction_s = 5;      // for the joint move from one operation to the next
    // Seconds of what leads from the end of a run to the start of the next one of the same operation; empty: a straight
    // move at the feed of links.
    std::function<double(const Operation& operation, Vec3 from, Vec3 to)> between_runs;
};

struct TimeEstimate {
    double cut_s = 0;
    double approach_s = 0;
    double link_s = 0;    // links, retracts, and between runs
    double change_s = 0;  // of tools and directions
    double cut_mm = 0;
    double link_mm = 0;
    double total_s() const { return cut_s + approach_s + link_s + change_s; }
};

// O(moves).
TimeEstimate time_estimate(const Toolpath& toolpath, const TimeSettings& settings = {});

// The seconds of one straight move that begins and ends with given speeds, of which neither is more than the feed or
// than the acceleration allows over its length.
double move_seconds(double length, double feed, double from_speed, double to_speed, double acceleration);

}  // namespace qchopper
