// Reads the cell file: reach, table, stock, tool, and where the controller listens.
//
// Lengths in mm in the cell's base frame, z up. In a cell that read_cell returns sizes are positive, the reach box is
// not empty and the middle of the table lies in it, there are 1 to 1000 blocks, and no two have the same name
// (tests/cam/cell/cell_test.cpp). docs/cell-file.md explains each key.

#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cam/cell/material.h"
#include "segment/mesh/measure.h"

namespace qchopper {

// Where a block stands: its underside on the table, its middle above the table's middle.
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
    Vec3 size;  // before a quarter turn (Setup::stock_turned)
    Material material = Material::unspecified;
    bool operator==(const Stock&) const = default;
};

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

struct Cell {
    std::string name;
    std::uint16_t id = 0;  // CELL_ID on the wire, 1..65535
    Box reach;             // what the tool tip reaches
    Table table;
    std::vector<Stock> stock;
    double stock_margin = 0;  // foam kept around the piece: four sides and above
    double clearance = 20;    // height above the block in which the tool travels
    Tool tool;
    Link link;
    bool operator==(const Cell&) const = default;
};

// Throws InputError: missing if the file cannot be read, config if it describes no valid cell (file, line, key, why).
Cell read_cell(const std::filesystem::path& path);

// The same from text; `path` appears in messages, and a relative drop folder counts from its folder.
Cell parse_cell(std::string_view text, const std::filesystem::path& path);

}  // namespace qchopper
