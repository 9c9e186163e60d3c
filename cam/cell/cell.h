// Reads the cell file: reach, table, stock, tools, robot, and where the controller listens.
//
// Lengths in mm in the cell's base frame, z up; angles in radians. In a cell that read_cell returns sizes are positive,
// the reach box is not empty and the middle of the table lies in it, there are 1 to 1000 blocks, and no two have the
// same name (tests/cam/cell/cell_test.cpp). docs/user/cell-file.md explains each key.

#pragma once

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cam/cell/cutting_tool.h"
#include "cam/cell/material.h"
#include "cam/cell/robot.h"
#include "segment/joint/dowel.h"
#include "segment/mesh/measure.h"

namespace qchopper {

// Where a block stands: its underside on the table, its middle above the table's middle. Of a rotary table the square
// inside of its rim, so that a block on it stands on the table at every angle.
struct Table {
    double centre_x = 0;
    double centre_y = 0;
    double size_x = 0;
    double size_y = 0;
    double height = 0;  // z of its top
    bool operator==(const Table&) const = default;
};

// A block of the workshop's stock.
struct Stock {
    std::string name;
    Vec3 size;  // before a quarter turn (StockBlock::is_turned)
    Material material = Material::unspecified;
    bool is_sawn = false;                         // may be sawn down to any smaller size
    double kerf = 0;                              // width of foam that a saw cut takes
    std::optional<double> bending_strength = {};  // N/mm2; nothing: assumed_bending_strength() of its material
    bool operator==(const Stock&) const = default;
};

// The tool that jobs name.
struct Tool {
    std::uint16_t number = 1;
    std::string name;
    double diameter = 0;
    std::uint16_t spindle_max_rpm = 0;
    std::uint32_t feed_max_mm_per_min = 0;
    double removal_mm3_per_s = 0;  // for crude_time_s only
    bool operator==(const Tool&) const = default;
};

// How jobs reach the controller; both may be given on the command line instead.
struct Link {
    std::optional<std::string> to;              // HOST:PORT, IPv6 as [HOST]:PORT
    std::optional<std::filesystem::path> drop;  // a relative path counts from the folder of the cell file
    bool operator==(const Link&) const = default;
};

// Foam around the piece.
struct Margins {
    double sides = 5;
    double top = 3;
    double spoil = 10;  // layer under the piece that stays on the table
    bool operator==(const Margins&) const = default;
};

// Faces of blocks that a saw makes in the planes of caps (cam/setup/layout/flush_caps.h). The accuracy is that of a
// band saw or a hot wire of the usual class; it is assumed.
struct Saw {
    double accuracy = 0.5;         // mm, by which a sawn face may be off its plane; reported only
    double flush_tolerance = 0.1;  // mm, largest distance of a point of a cap from the face of the block that it is
    bool operator==(const Saw&) const = default;
};

// What holds a block on the table, and against what (cam/setup/workholding.h).
//
// The defaults are assumed. Force: a chip 20 mm deep at 0.2 mm a tooth, 4 mm2, times 5 N/mm2, which is the specific
// cutting force of particleboard, 32 N/mm2 (B. Palubicki, "Cutting forces in peripheral up-milling of particleboard",
// Materials 14, 2021, 2208), scaled by the density to foam of 100 kg/m3. Strength: double-sided tape; glue that is as
// strong as the foam has several times as much.
struct Holding {
    double cutting_force = 20;   // N, sideways, the largest
    double strength = 0.1;       // N/mm2, of tape or glue in tension
    double max_slenderness = 4;  // height of a piece over the smallest width of its base
    bool operator==(const Holding&) const = default;
};

// A box in which nothing of robot, spindle and tool may be.
struct Obstacle {
    std::string name;
    Box box;
    bool operator==(const Obstacle&) const = default;
};

// Where every program begins and ends.
struct StartPose {
    Joints joints{};  // of a robot
    Vec3 tip;         // of a gantry
    bool operator==(const StartPose&) const = default;
};

enum class Dialect { krl, rapid, ngc };

struct ProgramSettings {
    Dialect dialect = Dialect::krl;
    std::uint32_t memory_bytes = 3'000'000;  // of the controller, for programs
    std::uint32_t lines_per_chunk = 1'400;
    double link_feed_mm_per_s = 0;                // largest, of moves that remove no foam
    double acceleration = 2'000;                  // of the tip on straight moves, mm/s2
    double turn_speed = std::numbers::pi / 1.8;   // of the tool's orientation on straight moves, radians/s
    double joint_share = 0.5;                     // of the largest speed and acceleration of each axis, in joint moves
    double scallop = 0.25;                        // mm, height of the ridges that finishing may leave
    std::optional<std::string> tool_change_call;  // program that changes the tool; nothing: stop for a person
    double interpolation_cycle_s = 0.012;         // of the controller: no straight move takes less
    double tool_change_s = 60;                    // assumed; of each change, the first tool of a program included
    bool operator==(const ProgramSettings&) const = default;
};

// By how much the load data of a program may differ from those of spindle and tool.
struct LoadTolerance {
    double mass_kg = 0.5;
    double centre_mm = 20;
    double inertia_kg_m2 = 0.05;
    bool operator==(const LoadTolerance&) const = default;
};

// Where a value of a cell file comes from.
enum class Origin {
    data_sheet,  // the maker's data sheet, or a published model of this type
    measured,    // on this cell
    assumed,     // plausible for its class; nobody has checked it on this cell
    unstated,    // the file gives the value without its origin
    by_default   // the file gives no value
};

struct ValueOrigin {
    std::string table;  // "robot", "tool 3", "stock large"; empty for a key outside of all tables
    std::string key;
    Origin origin = Origin::unstated;
    bool operator==(const ValueOrigin&) const = default;
};

// "data sheet", "measured", "assumed", "unstated", "by default"
std::string_view to_word(Origin origin);

// Of the first three only.
std::optional<Origin> origin_of(std::string_view word);

// What mills in the cell.
struct CellMachine {
    std::optional<Robot> robot;  // nothing: a gantry of three axes, whose travel is Cell::workspace
    Spindle spindle;
    std::optional<Extraction> extraction;
    std::vector<CuttingTool> tools;           // at least one
    std::optional<RotaryTable> rotary_table;  // nothing: the table is fixed
    double max_tilt = 0;                      // of the tool axis from the vertical, radians
    double max_unreachable = 0.02;            // share of a piece's area without its base, 0..1
    Holding holding;
    std::vector<Obstacle> obstacles;
    StartPose start;
    ProgramSettings program;
    LoadTolerance load_tolerance;
    bool operator==(const CellMachine&) const = default;
};

struct Cell {
    std::string name;
    std::uint16_t id = 0;            // CELL_ID on the wire, 1..65535
    bool require_signature = false;  // every job and every ticket must be signed by a trusted key
    Box workspace;                   // what the tool tip reaches
    Table table;
    std::vector<Stock> stock;
    Margins margins;
    Saw saw;
    double clearance = 20;  // height above the block in which the tool travels
    Tool tool;              // the first one
    Link link;
    std::vector<DowelSize> dowels = default_dowels();  // largest first; empty: pieces are joined without dowels
    double dowel_play = default_dowel_play;
    std::optional<CellMachine> machine;  // nothing: boxes only
    std::vector<ValueOrigin> origins;    // in the order of the tables; of keys that are given or have a default
    bool operator==(const Cell&) const = default;

    // Foam kept around the piece: four sides and above.
    double stock_margin() const { return std::max(margins.sides, margins.top); }
};

double bending_strength(const Stock& stock);  // N/mm2

// Whether some block of the stock may be sawn, so that caps can be faces of blocks.
inline bool is_any_sawn(const Cell& cell) {
    return std::any_of(cell.stock.begin(), cell.stock.end(), [](const Stock& stock) { return stock.is_sawn; });
}

const char* to_word(Dialect dialect);  // "krl", "rapid", "ngc"

// Throws InputError: missing if the file cannot be read, config if it describes no valid cell (file, line, key, why).
Cell read_cell(const std::filesystem::path& path);

// The same from text; `path` appears in messages, and a relative drop folder counts from its folder.
Cell parse_cell(std::string_view text, const std::filesystem::path& path);

}  // namespace qchopper
