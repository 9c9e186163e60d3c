// One function per table of the file. O(file), and O(blocks^2) to find two of one name.

#include "cam/cell/cell.h"

#include <algorithm>
#include <array>
#include <charconv>

#include "base/error.h"
#include "base/file.h"
#include "base/toml_reader.h"

namespace qchopper {
namespace {

constexpr double farthest = 100'000;  // 100 m: a larger number is in a wrong unit
constexpr double smallest = 0.001;    // lengths on the wire and in files are rounded to 0.001 to 0.01 mm
constexpr std::size_t most_blocks = 1000;

constexpr std::array<std::string_view, 9> cell_keys{"name",         "id",        "reach", "table", "stock",
                                                    "stock_margin", "clearance", "tool",  "link"};
constexpr std::array<std::string_view, 2> reach_keys{"min", "max"};
constexpr std::array<std::string_view, 3> table_keys{"centre", "size", "height"};
constexpr std::array<std::string_view, 3> stock_keys{"name", "size", "material"};
constexpr std::array<std::string_view, 6> tool_keys{
    "number", "name", "diameter", "spindle_max_rpm", "feed_max_mm_per_min", "removal_mm3_per_s"};
constexpr std::array<std::string_view, 2> link_keys{"to", "drop"};

Box read_reach(const TomlReader& reader) {
    const Box reach{reader.vector("min", -farthest, farthest), reader.vector("max", -farthest, farthest)};
    constexpr std::array<const char*, 3> axes{"x", "y", "z"};
    for (int axis = 0; axis < 3; ++axis) {
        if (reach.min[axis] < reach.max[axis]) continue;
        reader.refuse("max", std::string("must be larger than reach.min, and is not along ") + axes[axis]);
    }
    return reach;
}

Table read_table(const TomlReader& reader, const Box& reach) {
    const std::vector<double> centre = reader.numbers("centre", 2, -farthest, farthest);
    const std::vector<double> size = reader.numbers("size", 2, smallest, farthest);
    const Table table{centre[0], centre[1], size[0], size[1], reader.number("height", -farthest, farthest)};
    if (table.height < reach.min.z) reader.refuse("height", "the table lies below the reach (reach.min z)");
    if (table.height >= reach.max.z) reader.refuse("height", "the table lies above the reach (reach.max z)");
    if (centre[0] <= reach.min.x || centre[0] >= reach.max.x || centre[1] <= reach.min.y || centre[1] >= reach.max.y) {
        reader.refuse("centre", "the middle of the table lies outside of the reach");
    }
    return table;
}

Stock read_block(const TomlReader& reader) {
    Stock stock{reader.text("name"), reader.vector("size", smallest, farthest), Material::unspecified};
    if (!reader.has("material")) return stock;
    const std::optional<Material> material = material_of(reader.text("material"));
    if (!material) reader.refuse("material", "unknown material", "use pu_foam, eps, xps, other or unspecified");
    stock.material = *material;
    return stock;
}

std::vector<Stock> read_stock(const TomlReader& reader) {
    std::vector<Stock> stock;
    for (const TomlReader& block : reader.tables("stock", stock_keys)) {
        const Stock read = read_block(block);
        const bool twice =
            std::any_of(stock.begin(), stock.end(), [&](const Stock& other) { return other.name == read.name; });
        if (twice) block.refuse("name", "a second block named " + read.name, "give each block a name of its own");
        if (stock.size() == most_blocks) reader.refuse("stock", "more than a thousand blocks");
        stock.push_back(read);
    }
    if (stock.empty()) reader.refuse("stock", "no block to carve from", "add at least one [[stock]]");
    return stock;
}

Tool read_tool(const TomlReader& reader) {
    Tool tool;
    tool.number = static_cast<std::uint16_t>(reader.whole("number", 0, 65535));
    tool.name = reader.text("name");
    tool.diameter = reader.number("diameter", smallest, 1000);
    tool.spindle_max_rpm = static_cast<std::uint16_t>(reader.whole("spindle_max_rpm", 1, 65535));
    tool.feed_max_mm_per_min = reader.whole("feed_max_mm_per_min", 1, 1'000'000);
    tool.removal_mm3_per_s = reader.number("removal_mm3_per_s", smallest, 1e9);
    return tool;
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

Cell read_root(const TomlReader& reader, const std::filesystem::path& path) {
    Cell cell;
    cell.name = reader.text("name");
    cell.id = static_cast<std::uint16_t>(reader.whole("id", 1, 65535));
    cell.reach = read_reach(reader.table("reach", reach_keys));
    cell.table = read_table(reader.table("table", table_keys), cell.reach);
    cell.stock = read_stock(reader);
    cell.stock_margin = reader.number("stock_margin", 0, 10'000);
    if (reader.has("clearance")) cell.clearance = reader.number("clearance", 0, 10'000);
    cell.tool = read_tool(reader.table("tool", tool_keys));
    if (reader.has("link")) cell.link = read_link(reader.table("link", link_keys), path);
    return cell;
}

}  // namespace

Cell parse_cell(std::string_view text, const std::filesystem::path& path) {
    return read_root(TomlReader::parse(text, path.string(), cell_keys), path);
}

Cell read_cell(const std::filesystem::path& path) {
    const Bytes bytes = read_file(path, settings_limit);
    return parse_cell({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, path);
}

}  // namespace qchopper
