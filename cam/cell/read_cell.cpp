// One function per table of the file; those of robot, spindle and tools are in sources of their own. O(file), and
// O(blocks^2) to find two of one name.

#include "cam/cell/cell.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <numbers>
#include <utility>

#include "base/error.h"
#include "base/files/file.h"
#include "cam/cell/cell_keys.h"
#include "cam/cell/cell_tables.h"
#include "cam/cell/job_tools.h"

namespace qchopper {
namespace {

constexpr std::size_t max_blocks = 1000;
constexpr std::size_t max_obstacles = 1000;
constexpr std::size_t max_dowels = 12;

// `name` is the table's, for messages.
Box read_box(const TomlReader& reader, const std::string& name) {
    const Box box{reader.vector("min", -farthest_2, farthest_2), reader.vector("max", -farthest_2, farthest_2)};
    constexpr std::array<const char*, 3> axes{"x", "y", "z"};
    for (int axis = 0; axis < 3; ++axis) {
        if (box.min[axis] < box.max[axis]) continue;
        reader.refuse("max", "must be larger than " + name + ".min, and is not along " + axes[axis]);
    }
    return box;
}

// The middle of the table's top must lie in the reach; the keys are those that give its height and its middle.
void check_table(const TomlReader& reader, const Table& table, const Box& workspace, const char* height,
                 const char* centre) {
    if (table.height < workspace.min.z) reader.refuse(height, "the table lies below the reach (reach.min z)");
    if (table.height >= workspace.max.z) reader.refuse(height, "the table lies above the reach (reach.max z)");
    if (table.centre_x <= workspace.min.x || table.centre_x >= workspace.max.x || table.centre_y <= workspace.min.y ||
        table.centre_y >= workspace.max.y) {
        reader.refuse(centre, "the middle of the table lies outside of the reach");
    }
}

Table read_table(const TomlReader& reader, const Box& workspace) {
    const std::vector<double> centre = reader.numbers("centre", 2, -farthest_2, farthest_2);
    const std::vector<double> size = reader.numbers("size", 2, smallest, farthest_2);
    const Table table{centre[0], centre[1], size[0], size[1], reader.number("height", -farthest_2, farthest_2)};
    check_table(reader, table, workspace, "height", "centre");
    return table;
}

Stock read_block(const TomlReader& reader, Origins& origins) {
    Stock stock;
    stock.name = reader.text("name");
    stock.size = reader.vector("size", smallest, farthest_2);
    if (reader.has("material")) {
        const std::optional<Material> material = material_of(reader.text("material"));
        if (!material) reader.refuse("material", "unknown material", "use pu_foam, eps, xps, other or unspecified");
        stock.material = *material;
    }
    stock.is_sawn = reader.has("sawn") && reader.boolean("sawn");
    if (stock.is_sawn) {
        stock.kerf = reader.number("kerf", 0, 50);
        if (stock.kerf >= std::min({stock.size.x, stock.size.y, stock.size.z})) {
            reader.refuse("kerf", "leaves nothing of the block's smallest side",
                          "give the width of the saw cut, or leave out sawn");
        }
    } else if (reader.has("kerf")) {
        reader.refuse("kerf", "has no meaning for a block that is not sawn", "add sawn = true, or leave it out");
    }
    if (reader.has("bending_strength")) stock.bending_strength = reader.number("bending_strength", 0.001, 1'000);
    const std::string name = "stock " + stock.name;
    add_origins(reader, keys_2::stock, name, origins);
    add_defaults(reader, std::to_array<std::string_view>({"bending_strength"}), name, origins);
    return stock;
}

std::vector<Stock> read_stock(const TomlReader& reader, Origins& origins) {
    std::vector<Stock> stock;
    for (const TomlReader& row : reader.tables("stock", keys_2::stock)) {
        const Stock block = read_block(row, origins);
        const bool twice =
            std::any_of(stock.begin(), stock.end(), [&](const Stock& other) { return other.name == block.name; });
        if (twice) row.refuse("name", "a second block named " + block.name, "give each block a name of its own");
        if (stock.size() == max_blocks) reader.refuse("stock", "more than a thousand blocks");
        stock.push_back(block);
    }
    if (stock.empty()) reader.refuse("stock", "no block to carve from", "add at least one [[stock]]");
    return stock;
}

// HOST:PORT, with an IPv6 address in brackets because it contains colons.
bool is_address(const std::string& to) {
    const std::size_t colon = to.rfind(':');
    if (colon == std::string::npos || colon == 0 || to.size() - colon > 6) return false;
    unsigned port = 0;
    const char* end = to.data() + to.size();
    const auto parsed = std::from_chars(to.data() + colon + 1, end, port);
    if (parsed.ec != std::errc{} || parsed.ptr != end || port == 0 || port > 65535) return false;
    const std::string host = to.substr(0, colon);
    if (host.find_first_of(" \t/@") != std::string::npos) return false;
    if (host.front() == '[') return host.size() > 2 && host.back() == ']';
    return host.find_first_of(":[]") == std::string::npos;
}

Link read_link(const TomlReader& reader, const std::filesystem::path& path) {
    Link link;
    if (reader.has("to")) {
        link.to = reader.text("to");
        if (!is_address(*link.to)) {
            reader.refuse("to", *link.to + " is not HOST:PORT", "for example \"192.168.1.10:502\", port 1 to 65535");
        }
    }
    if (reader.has("drop")) {
        const std::filesystem::path drop = reader.text("drop");
        link.drop = drop.is_absolute() ? drop : path.parent_path() / drop;
    }
    return link;
}

RotaryTable read_rotary_table(const TomlReader& reader) {
    RotaryTable table;
    table.table_in_cell = read_pose(reader);
    constexpr double max_lean = 1;  // degrees
    if (table.table_in_cell.row[2].z < std::cos(max_lean * degree)) {
        reader.refuse("abc_deg", "the table's z must be upright within 1 degree: a block stands on it");
    }
    table.radius = reader.number("radius", smallest, farthest_2);
    table.speed = reader.number("speed_deg_per_s", smallest, 1'000) * degree;
    table.external_axis = static_cast<int>(reader.whole("external_axis", 1, 6));
    return table;
}

void read_reach(const TomlReader& root, Cell& cell) {
    const TomlReader reach = root.table("reach", keys_2::reach);
    cell.workspace = read_box(reach, "reach");
    add_origins(reach, keys_2::reach, "reach", cell.origins);
}

void read_fixed_table(const TomlReader& root, Cell& cell) {
    const TomlReader reader = root.table("table", keys_2::table);
    cell.table = read_table(reader, cell.workspace);
    add_origins(reader, keys_2::table, "table", cell.origins);
}

// The table as blocks see it: of a rotary one the square inside of its rim.
void read_tables(const TomlReader& root, Cell& cell, CellMachine& machine) {
    if (root.has("table") && root.has("rotary_table")) {
        root.refuse("rotary_table", "a cell has one table", "leave out [table] or [rotary_table]");
    }
    if (!root.has("rotary_table")) return read_fixed_table(root, cell);
    if (!machine.robot) root.refuse("rotary_table", "a gantry has three axes", "describe a fixed [table]");
    const TomlReader reader = root.table("rotary_table", keys_2::rotary_table);
    machine.rotary_table = read_rotary_table(reader);
    const Vec3 centre = machine.rotary_table->table_in_cell.shift;
    const double side = std::numbers::sqrt2 * machine.rotary_table->radius;
    cell.table = {centre.x, centre.y, side, side, centre.z};
    check_table(reader, cell.table, cell.workspace, "position", "position");
    add_origins(reader, keys_2::rotary_table, "rotary_table", cell.origins);
}

std::vector<Obstacle> read_obstacles(const TomlReader& root, Origins& origins) {
    std::vector<Obstacle> obstacles;
    if (!root.has("obstacle")) return obstacles;
    for (const TomlReader& row : root.tables("obstacle", keys_2::obstacle)) {
        if (obstacles.size() == max_obstacles) root.refuse("obstacle", "more than a thousand obstacles");
        obstacles.push_back({row.text("name"), read_box(row, "obstacle")});
        add_origins(row, keys_2::obstacle, "obstacle " + obstacles.back().name, origins);
    }
    return obstacles;
}

Margins read_margins(const TomlReader& root, Origins& origins) {
    Margins margins;
    const TomlReader reader = root.table_if_given("margin", keys_2::margin);
    reader.number_if_given("sides", 0, 1'000, margins.sides);
    reader.number_if_given("top", 0, 1'000, margins.top);
    reader.number_if_given("spoil", 0, 1'000, margins.spoil);
    add_defaults(reader, keys_2::margin, "margin", origins);
    return margins;
}

// Its values have an origin only where some block may be sawn; elsewhere nothing depends on them.
Saw read_saw(const TomlReader& root, const std::vector<Stock>& stock, Origins& origins) {
    Saw saw;
    const bool is_any_sawn = std::any_of(stock.begin(), stock.end(), [](const Stock& s) { return s.is_sawn; });
    if (root.has("saw") && !is_any_sawn) {
        root.refuse("saw", "has no meaning where no block may be sawn",
                    "add sawn = true to a [[stock]], or leave it out");
    }
    const TomlReader reader = root.table_if_given("saw", keys_2::saw);
    reader.number_if_given("accuracy", 0, 5, saw.accuracy);
    reader.number_if_given("flush_tolerance", 0, 5, saw.flush_tolerance);
    if (!is_any_sawn) return saw;
    add_origins(reader, keys_2::saw, "saw", origins);
    add_defaults(reader, keys_2::saw.with_origin(), "saw", origins);
    return saw;
}

Holding read_holding(const TomlReader& root, Origins& origins) {
    Holding holding;
    const TomlReader reader = root.table_if_given("holding", keys_2::holding);
    reader.number_if_given("cutting_force", 0.1, 10'000, holding.cutting_force);
    reader.number_if_given("strength", 0.001, 1'000, holding.strength);
    reader.number_if_given("max_slenderness", 0.1, 1'000, holding.max_slenderness);
    add_origins(reader, keys_2::holding, "holding", origins);
    add_defaults(reader, keys_2::holding.with_origin(), "holding", origins);
    return holding;
}

// What holds of every piece: foam around it, and the height in which the tool travels.
void read_room(const TomlReader& root, Cell& cell) {
    cell.margins = read_margins(root, cell.origins);
    cell.saw = read_saw(root, cell.stock, cell.origins);
    root.number_if_given("clearance", 0, 1'000, cell.clearance);
    add_defaults(root, std::to_array<std::string_view>({"clearance"}), "", cell.origins);
}

void read_limits(const TomlReader& root, CellMachine& machine, Origins& origins) {
    machine.holding = read_holding(root, origins);
    root.number_if_given("max_unreachable", 0, 1, machine.max_unreachable);
    add_defaults(root, std::to_array<std::string_view>({"max_unreachable"}), "", origins);
    if (!machine.robot) {
        if (root.has("max_tilt_deg")) root.refuse("max_tilt_deg", "a gantry does not tilt its tool", "leave it out");
        return;
    }
    machine.max_tilt = (root.has("max_tilt_deg") ? root.number("max_tilt_deg", 0, 90) : 60) * degree;
    add_defaults(root, std::to_array<std::string_view>({"max_tilt_deg"}), "", origins);
}

std::vector<DowelSize> read_dowels(const TomlReader& root) {
    if (!root.has("dowel")) return default_dowels();
    std::vector<DowelSize> dowels;
    for (const TomlReader& row : root.tables("dowel", keys_2::dowel)) {
        const DowelSize size{row.number("diameter", 1, 200), row.number("depth", 1, 1'000),
                             row.number("wall", 0, 1'000)};
        if (dowels.size() == max_dowels) root.refuse("dowel", "more than " + std::to_string(max_dowels) + " sizes");
        if (!dowels.empty() && dowels.back().diameter <= size.diameter) {
            row.refuse("diameter", "is not smaller than the one before", "list the sizes of dowels largest first");
        }
        dowels.push_back(size);
    }
    return dowels;
}

// Robot or gantry. In this order values have their origins listed.
void read_machine(const TomlReader& root, Cell& cell) {
    CellMachine machine;
    Origins& origins = cell.origins;
    if (root.has("robot")) machine.robot = read_robot(root, origins);
    read_reach(root, cell);
    read_tables(root, cell, machine);
    machine.program = read_program(root, machine.robot.has_value(), origins);
    machine.load_tolerance = read_load_tolerance(root);
    machine.tools = read_tools(root, origins);
    cell.tool = job_tool(machine.tools.front());
    machine.spindle = read_spindle(root, machine.robot, machine.tools, machine.program.dialect, origins);
    machine.extraction = read_extraction(root, machine.program.dialect);
    cell.stock = read_stock(root, origins);
    machine.obstacles = read_obstacles(root, origins);
    machine.start = read_start(root, machine.robot, cell.workspace);
    read_room(root, cell);
    read_limits(root, machine, origins);
    cell.machine = std::move(machine);
}

// Of a cell of which no machine is described.
void read_boxes(const TomlReader& root, Cell& cell) {
    for (const std::string_view key : keys_2::of_machines) {
        if (root.has(key)) {
            root.refuse(key, "has no meaning in a file that describes no machine",
                        "describe it by [spindle], and a robot by [robot], or leave this out");
        }
    }
    read_reach(root, cell);
    read_fixed_table(root, cell);
    const std::vector<CuttingTool> tools = read_tools(root, cell.origins);
    if (tools.size() > 1) {
        root.refuse("tool", "a cell of which no machine is described has one tool, the one that its jobs name",
                    "keep the first [[tool]], or describe the machine by [spindle]");
    }
    cell.tool = job_tool(tools.front());
    cell.stock = read_stock(root, cell.origins);
    read_room(root, cell);
}

Cell read_file_2(const TomlReader& root, const std::filesystem::path& path) {
    Cell cell;
    cell.name = root.text("name");
    cell.id = static_cast<std::uint16_t>(root.whole("id", 1, 65535));
    if (root.has("robot") || root.has("spindle")) {
        read_machine(root, cell);
    } else {
        read_boxes(root, cell);
    }
    cell.dowels = read_dowels(root);
    root.number_if_given("dowel_play", 0, 5, cell.dowel_play);
    if (root.has("require_signature")) cell.require_signature = root.boolean("require_signature");
    if (root.has("link")) cell.link = read_link(root.table("link", keys_2::link), path);
    return cell;
}

void refuse_version_1(const TomlReader& root) {
    if (root.has("version") && root.whole("version", 1, 2) == 2) return;
    root.refuse("version", "cell files of version 1 are not read any more",
                "write version = 2, its margins as [margin], its tool as [[tool]] with shape, lengths and holder: "
                "cells/foam-1.toml is such a file without a robot, docs/user/cell-file.md explains every key");
}

}  // namespace

double bending_strength(const Stock& stock) {
    return stock.bending_strength.value_or(assumed_bending_strength(stock.material));
}

Cell parse_cell(std::string_view text, const std::filesystem::path& path) {
    const TomlReader root = TomlReader::parse(text, path.string());
    refuse_version_1(root);
    return read_file_2(root.with_keys(keys_2::root), path);
}

Cell read_cell(const std::filesystem::path& path) {
    const Bytes bytes = read_file(path, settings_limit);
    return parse_cell({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, path);
}

}  // namespace qchopper
