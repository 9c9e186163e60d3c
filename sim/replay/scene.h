// What a replay is told beside the program: the cell, the block, the piece, what the job says of each chunk, and which
// tools the setup may use.
//
// mm, radians, setup coordinates unless stated (z up, the piece's base plane at z = 0, the underside of the block at
// z = -spoil). Everything else comes from the program's text.

#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/box.h"
#include "base/pose.h"
#include "cam/cell/cell.h"
#include "segment/mesh/triangle_mesh.h"
#include "sim/replay/stock/stock_record.h"

namespace qchopper {

struct SceneOrientation {
    Vec3 tool_axis{0, 0, 1};  // unit vector along which the tool comes out
    double table_angle = 0;   // of the rotary table while it is milled
    Pose setup_in_cell;       // at that angle
};

struct SceneChunk {
    std::string name;             // of its .src, without ending
    std::uint16_t tool = 1;       // CuttingTool::number
    std::size_t orientation = 0;  // index in ReplayScene::orientations
};

// A hole for a dowel, as the job states it.
struct SceneHole {
    std::size_t number = 0;
    Vec3 mouth;           // of its axis, on the cap
    Vec3 axis{0, 0, -1};  // unit, into the piece
    double diameter = 0;
    double depth = 0;        // of the full diameter
    bool is_robots = false;  // a program of the job drills it; otherwise it is drilled by hand
    bool is_due = false;     // this program does
};

// A cap of the piece, as the job states it.
struct SceneCap {
    static constexpr std::size_t faces = 5;  // of a block: -x, +x, -y, +y and the top
    std::int32_t cut = 0;
    Vec3 point;                       // of its plane
    Vec3 outward{0, 0, 1};            // unit
    std::optional<std::size_t> face;  // of the block that it is said to be; nothing: it is milled
};

struct ReplayScene {
    const Cell* cell = nullptr;  // with a machine and a robot
    std::vector<SceneOrientation> orientations;
    std::size_t drilling = std::numeric_limits<std::size_t>::max();  // directions from this index on are only drilled
    std::vector<SceneChunk> chunks;                                  // in the order in which they are called
    Box block;                                                       // as it stands before the program
    double spoil = 10;
    const TriangleMesh* target = nullptr;  // closed
    std::vector<bool> is_unmilled;         // per triangle of the target: base or sawn face; empty: none
    std::vector<SceneCap> caps = {};       // of the piece but the base; empty: not known
    double flush_tolerance = 0.1;          // mm, of caps that are faces of the block
    double scallop = 0.25;                 // the scallop height that was set
    double start_table_angle = 0;          // the joints at the start are CellMachine::start
    // Of a program in parts, each replayed for itself: what the part before left, nullptr for the first; and whether
    // the piece must be there after this one.
    const StockRecord* before = nullptr;
    bool is_last = true;
    std::vector<SceneHole> holes = {};  // all of the piece
    // Numbers of the tools that the setup may use; empty: all of the cell.
    std::vector<std::uint16_t> tools = {};
    // Where a person has entered other values at the controller than the planned ones, cell and frames are as entered,
    // and this is what stays as planned. Joint moves stay: their ends are turned by the angle between the entered and
    // the planned frame of the setup, radians.
    double entered_turn = 0;
    // The lengths (gauge_length()) that the program asks for, by the number of the tool; of other tools that of the
    // cell.
    std::map<std::uint16_t, double> planned_lengths = {};

    double planned_length(const CuttingTool& tool) const;
    // Below it no tool point may be: 2 mm of the spoil layer stay whole.
    double floor_z() const { return -spoil + 2; }
};

// Throws InputError (use) if the scene is not one: no cell with a robot, no direction, a chunk with a tool or a
// direction that is not there, a block or a target without size.
void check_scene(const ReplayScene& scene);

}  // namespace qchopper
