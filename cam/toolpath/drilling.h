// The holes for dowels that the robot drills after finishing, and why it does not drill the others.
//
// mm, setup coordinates. A hole is drilled along its axis, with a drill of its diameter, in pecks of two diameters,
// until its full diameter is as deep as the hole: the point of the drill goes deeper. Between pecks the drill leaves
// the foam. It comes down to just above the foam at the feed of links; all moves in foam have the feed of the drill,
// also upwards, because the wall of a hole is foam. tests/cam/toolpath/drilling_test.cpp.

#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "cam/cell/cell.h"
#include "cam/setup/drill_orientation.h"
#include "cam/setup/setup.h"
#include "cam/stock/in_process_stock.h"
#include "cam/toolpath/toolpath.h"
#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

struct DrillHole {
    std::size_t number = 1;   // as in the job
    Vec3 mouth;               // of its axis, on the cap
    Vec3 tool_axis{0, 0, 1};  // unit, along its axis out of the piece
    double diameter = 0;
    double depth = 0;     // of the full diameter
    double wall = 0;      // least foam that stays below it
    std::string by_hand;  // why the robot does not drill it, without a full stop; empty: it does, or may
    bool operator==(const DrillHole&) const = default;
};

struct Drilling {
    std::vector<DrillHole> holes;                // as they came, with the reasons
    std::vector<DrillOrientation> orientations;  // those that the setup lacks
    std::vector<Operation> operations;           // a run per hole; by tool in the order of the cell, then by direction
};

struct DrillOptions {
    double gap = 2;          // above foam, where a run begins to drill
    double clear = 1;        // of the piece around the drill above the cap, and of foam around the holder
    double diameter = 0.05;  // by which hole and drill may differ
};

// What can be drilled with the tools, wherever the arm may reach (cam/program/reachable_holes.h). A hole that has a
// reason already is left alone. `foam` is what stands after the toolpath, `mesh` the piece in setup coordinates.
// Precondition: the cell has a machine. O(holes * block / 4 mm^3 of the holder).
Drilling drill_holes(std::span<const DrillHole> holes, const Setup& setup, const TriangleMesh& mesh, const Cell& cell,
                     const InProcessStock& stock, const DrillOptions& options = {});

}  // namespace qchopper
