// Where the tool tip can be held, by the tilt of the tool: a map over a vertical section of the cell.
//
// mm and radians, in the cell's frame. Joints are asked for every pose, none is taken from the reach box. No collision
// is checked, and no way from one pose to the next. The tilt is the angle between the tool axis, which points out of
// the spindle, and straight down; the azimuth is the direction from x towards y in which the axis then leans. Pure
// functions; the same cell gives the same map on any number of threads. tests/cam/cell/reach_map_test.cpp compares
// volumes with those of an independent program.

#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "cam/cell/cell.h"

namespace qchopper {

constexpr int reach_azimuths = 8;  // of a tilted axis, 45 degrees apart, the first along x; at tilt 0 there is one
constexpr int reach_redundancy_angles = 12;  // about the tool axis, 30 degrees apart

// An arm with a tool in its spindle.
struct ToolArm {
    ArmGeometry geometry;
    JointRanges ranges;
    double margin = 0;  // kept from both ends of each range, radians
    Pose base_in_cell;
    Pose tip_in_flange;  // its z points out of the spindle, its origin is the tool tip
};

// With the ranges of axes 4 and 6 narrowed to the cable limits, and a margin of 3 degrees. The tip lies gauge_length()
// before the spindle nose on the tool axis: the stick-out and the steps of the holder.
ToolArm tool_arm(const Robot& robot, const Spindle& spindle, const CuttingTool& tool);

// Whether joints exist for the tip at a point, for at least one of the redundancy angles.
bool holds(const ToolArm& arm, Vec3 tip, double tilt, double azimuth);

// Number of directions of the tool axis with a tilt in which the tip is held: of 1 at tilt 0, else of reach_azimuths.
int held_azimuths(const ToolArm& arm, Vec3 tip, double tilt);

// Squares in the plane at right angles to y.
struct ReachSection {
    double y = 0;      // of the plane: that of the middle of the table
    double x_min = 0;  // corner of the first square
    double z_min = 0;
    double step = 0;  // side of a square
    std::size_t columns = 0;
    std::size_t rows = 0;
    // The middle of a square, where it is judged.
    Vec3 middle(std::size_t column, std::size_t row) const {
        return {x_min + step * (static_cast<double>(column) + 0.5), y, z_min + step * (static_cast<double>(row) + 0.5)};
    }
};

struct TiltReach {
    double tilt = 0;
    int azimuths = 1;                // directions tried
    std::vector<std::uint8_t> held;  // directions held per square, row by row from below: columns * rows
};

struct ReachMap {
    ReachSection section;
    std::vector<TiltReach> tilts;  // none if the cell describes no machine
};

// The section holds the table, the reach box and the base of the robot, and of the rest what is reached on the table's
// side of the robot, not below the lowest of these three. A robot holds its first tool; a gantry points it straight
// down within its reach box, and holds no other tilt. `step` is enlarged where the section would have more than 500
// squares in a row or column. Precondition: step > 0; each tilt is 0..pi.
ReachMap reach_map(const Cell& cell, const std::vector<double>& tilts, double step = 50);

}  // namespace qchopper
