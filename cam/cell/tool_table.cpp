// The list of tools: one function per group of keys. O(tools^2), to find two of one number.

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "base/text.h"
#include "cam/cell/cell_tables.h"

namespace qchopper {
namespace {

constexpr double widest = 500;        // mm
constexpr double longest = 2'000;     // mm
constexpr double slowest_feed = 1;    // mm/s
constexpr double fastest_feed = 500;  // mm/s
constexpr std::size_t max_tools = 100;
constexpr std::size_t max_steps = 20;
constexpr double min_point_deg = 60;  // of a drill
constexpr double max_point_deg = 170;

constexpr std::array shapes{ToolShape::ball, ToolShape::flat, ToolShape::bull, ToolShape::cone, ToolShape::drill};

ToolShape read_shape(const TomlReader& reader) {
    const std::string word = reader.text("shape");
    const auto* found = std::find_if(shapes.begin(), shapes.end(), [&](ToolShape s) { return to_word(s) == word; });
    if (found == shapes.end()) reader.refuse("shape", "unknown shape " + word, "use ball, flat, bull, cone or drill");
    return *found;
}

void refuse_unless(const TomlReader& reader, std::string_view key, bool has_meaning, ToolShape shape) {
    if (!has_meaning && reader.has(key)) {
        reader.refuse(key, std::string("has no meaning for the shape ") + to_word(shape), "leave it out");
    }
}

void read_profile(const TomlReader& reader, CuttingTool& tool) {
    tool.shape = read_shape(reader);
    tool.diameter = reader.number("diameter", smallest, widest);
    const double radius = tool.diameter / 2;
    const bool is_bull = tool.shape == ToolShape::bull;
    const bool is_cone = tool.shape == ToolShape::cone;
    refuse_unless(reader, "corner_radius", is_bull || is_cone, tool.shape);
    refuse_unless(reader, "tip_angle_deg", is_cone || is_drill(tool), tool.shape);
    if (tool.shape == ToolShape::ball) tool.corner_radius = radius;
    if (is_cone) tool.tip_angle = reader.number("tip_angle_deg", 1, 179) * degree;
    if (is_drill(tool)) tool.tip_angle = reader.number("tip_angle_deg", min_point_deg, max_point_deg) * degree;
    if (!is_bull && !reader.has("corner_radius")) return;
    tool.corner_radius = reader.number("corner_radius", is_bull ? smallest : 0, widest);
    if (tool.corner_radius >= radius) reader.refuse("corner_radius", "must be less than half the diameter");
}

std::vector<HolderStep> read_holder(const TomlReader& reader, double tool_diameter) {
    std::vector<HolderStep> holder;
    for (const auto& [diameter, length] : reader.pairs("holder", smallest, longest)) {
        if (diameter < tool_diameter) reader.refuse("holder", "a step of the holder is narrower than the tool");
        if (holder.size() == max_steps) reader.refuse("holder", "more than twenty steps");
        holder.push_back({diameter, length});
    }
    if (holder.empty()) reader.refuse("holder", "must have at least one step, [diameter, length]");
    return holder;
}

void read_lengths(const TomlReader& reader, CuttingTool& tool) {
    tool.flute_length = reader.number("flute_length", smallest, longest);
    tool.stick_out = reader.number("stick_out", smallest, longest);
    if (tool.stick_out < tool.flute_length) {
        reader.refuse("stick_out", "must not be less than flute_length: the holder would hold the cutting edges");
    }
    tool.holder = read_holder(reader, tool.diameter);
}

void read_windows(const TomlReader& reader, CuttingTool& tool) {
    const std::vector<double> feed = reader.numbers("feed_mm_per_s", 2, slowest_feed, fastest_feed);
    const std::vector<double> rpm = reader.numbers("rpm", 2, 1, 65'535);
    constexpr const char* order = "the first number must be below the second";
    if (feed[0] >= feed[1]) reader.refuse("feed_mm_per_s", order);
    if (rpm[0] >= rpm[1]) reader.refuse("rpm", order);
    tool.feed_min_mm_per_s = feed[0];
    tool.feed_max_mm_per_s = feed[1];
    tool.rpm_min = static_cast<std::uint16_t>(rpm[0]);
    tool.rpm_max = static_cast<std::uint16_t>(rpm[1]);
    if (tool.rpm_min != rpm[0] || tool.rpm_max != rpm[1]) reader.refuse("rpm", "must be whole numbers");
}

// No cut takes more than the whole flute and the whole diameter.
void read_rate(const TomlReader& reader, CuttingTool& tool) {
    tool.removal_mm3_per_s = reader.number("removal_mm3_per_s", smallest, 1e9);
    const double needed = tool.removal_mm3_per_s / (tool.diameter * tool.flute_length);
    if (needed <= tool.feed_max_mm_per_s) return;
    reader.refuse("removal_mm3_per_s",
                  "needs a feed of " + significant(needed, 3) +
                      " mm/s with the whole flute in the foam, and the largest is " +
                      significant(tool.feed_max_mm_per_s, 3),
                  "give what the tool removes where it cuts deepest and widest, or a larger feed");
}

CuttingTool read_tool_2(const TomlReader& reader) {
    CuttingTool tool;
    tool.number = static_cast<std::uint16_t>(reader.whole("number", 0, 65'535));
    tool.name = reader.text("name");
    read_profile(reader, tool);
    read_lengths(reader, tool);
    read_windows(reader, tool);
    tool.mass_kg = reader.number("mass_kg", smallest, 1'000);
    read_rate(reader, tool);
    tool.is_length_measured = reader.boolean("length_measured");
    const bool may_lack_centre = tool.shape == ToolShape::flat || tool.shape == ToolShape::bull;
    refuse_unless(reader, "centre_cutting", may_lack_centre, tool.shape);
    if (reader.has("centre_cutting")) tool.is_centre_cutting = reader.boolean("centre_cutting");
    return tool;
}

}  // namespace

const char* to_word(ToolShape shape) {
    switch (shape) {
        case ToolShape::ball:
            return "ball";
        case ToolShape::flat:
            return "flat";
        case ToolShape::bull:
            return "bull";
        case ToolShape::cone:
            return "cone";
        case ToolShape::drill:
            break;
    }
    return "drill";
}

double point_height(const CuttingTool& tool) {
    return 0.5 * tool.diameter / std::tan(0.5 * tool.tip_angle);
}

double gauge_length(const CuttingTool& tool) {
    return std::accumulate(tool.holder.begin(), tool.holder.end(), tool.stick_out,
                           [](double sum, const HolderStep& step) { return sum + step.length; });
}

std::vector<CuttingTool> read_tools(const TomlReader& root, Origins& origins) {
    std::vector<CuttingTool> tools;
    for (const TomlReader& row : root.tables("tool", keys_2::tool)) {
        if (tools.size() == max_tools) root.refuse("tool", "more than a hundred tools");
        const CuttingTool read = read_tool_2(row);
        const bool is_second = std::any_of(tools.begin(), tools.end(),
                                           [&](const CuttingTool& other) { return other.number == read.number; });
        if (is_second) {
            row.refuse("number", "a second tool with the number " + std::to_string(read.number),
                       "give each tool a number of its own");
        }
        if (tools.empty() && is_drill(read)) {
            row.refuse("shape", "the first tool is the one that jobs name, and a drill carves nothing",
                       "list a tool that carves first");
        }
        add_origins(row, keys_2::tool, "tool " + std::to_string(read.number), origins);
        tools.push_back(read);
    }
    if (tools.empty()) root.refuse("tool", "no tool to carve with", "add at least one [[tool]]");
    return tools;
}

}  // namespace qchopper
