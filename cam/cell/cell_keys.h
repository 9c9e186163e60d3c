// The keys that each table of a cell file may have (docs/user/cell-file.md, docs/user/cell-file.schema.json).
//
// In a table with the key `source`, the keys before it have an origin; `sources` may name them.

#pragma once

#include <array>
#include <string_view>

#include "base/toml_reader.h"

namespace qchopper {

struct TableKeys {
    std::string_view path;  // "robot.capsule"; empty: outside of all tables
    Keys keys;
    // The keys before `source`; none without it.
    constexpr Keys with_origin() const {
        for (std::size_t i = 0; i < keys.size(); ++i) {
            if (keys[i] == "source") return keys.first(i);
        }
        return keys.first(0);
    }
};

namespace keys_2 {

inline constexpr auto root_keys = std::to_array<std::string_view>(
    {"version",    "name",  "id",         "clearance",      "max_tilt_deg", "max_unreachable",
     "margin",     "reach", "table",      "rotary_table",   "robot",        "spindle",
     "extraction", "tool",  "stock",      "obstacle",       "start",        "program",
     "link",       "dowel", "dowel_play", "load_tolerance", "holding"});
inline constexpr auto box_keys = std::to_array<std::string_view>({"min", "max", "source", "sources"});
inline constexpr auto table_keys = std::to_array<std::string_view>({"centre", "size", "height", "source", "sources"});
inline constexpr auto rotary_table_keys = std::to_array<std::string_view>(
    {"position", "abc_deg", "radius", "speed_deg_per_s", "source", "sources", "external_axis"});
inline constexpr auto robot_keys = std::to_array<std::string_view>({"a1",
                                                                    "a2",
                                                                    "b",
                                                                    "c1",
                                                                    "c2",
                                                                    "c3",
                                                                    "c4",
                                                                    "offset_deg",
                                                                    "sign",
                                                                    "min_deg",
                                                                    "max_deg",
                                                                    "speed_deg_per_s",
                                                                    "acceleration_deg_per_s2",
                                                                    "payload_kg",
                                                                    "source",
                                                                    "sources",
                                                                    "name",
                                                                    "base",
                                                                    "cable",
                                                                    "capsule"});
inline constexpr auto pose_keys = std::to_array<std::string_view>({"position", "abc_deg", "source", "sources"});
inline constexpr auto cable_keys = std::to_array<std::string_view>({"axis_4_deg", "axis_6_deg", "source", "sources"});
inline constexpr auto capsule_keys =
    std::to_array<std::string_view>({"from", "to", "radius", "source", "sources", "link"});
inline constexpr auto spindle_keys =
    std::to_array<std::string_view>({"position", "abc_deg", "body_radius", "body_length", "body_offset", "mass_kg",
                                     "source", "sources", "tool_axis", "on", "speed", "at_speed", "off"});
inline constexpr auto switch_keys = std::to_array<std::string_view>({"output", "call"});
inline constexpr auto speed_keys = std::to_array<std::string_view>({"output", "call", "scale"});
inline constexpr auto at_speed_keys = std::to_array<std::string_view>({"input", "call"});
inline constexpr auto extraction_keys = std::to_array<std::string_view>({"on", "off"});
inline constexpr auto tool_keys = std::to_array<std::string_view>(
    {"diameter", "corner_radius", "tip_angle_deg", "flute_length", "stick_out", "holder", "feed_mm_per_s", "rpm",
     "mass_kg", "removal_mm3_per_s", "source", "sources", "number", "name", "shape", "length_measured"});
inline constexpr auto stock_keys = std::to_array<std::string_view>(
    {"size", "kerf", "bending_strength", "source", "sources", "name", "material", "sawn"});
inline constexpr auto obstacle_keys = std::to_array<std::string_view>({"min", "max", "source", "sources", "name"});
inline constexpr auto holding_keys =
    std::to_array<std::string_view>({"cutting_force", "strength", "max_slenderness", "source", "sources"});
inline constexpr auto margin_keys = std::to_array<std::string_view>({"sides", "top", "spoil"});
inline constexpr auto start_keys = std::to_array<std::string_view>({"joints_deg", "tip"});
inline constexpr auto program_keys = std::to_array<std::string_view>(
    {"memory_bytes", "lines_per_chunk", "source", "sources", "dialect", "link_feed", "tool_change", "acceleration",
     "turn_speed_deg_per_s", "joint_move_percent", "scallop"});
inline constexpr auto load_tolerance_keys = std::to_array<std::string_view>({"mass_kg", "centre_mm", "inertia_kg_m2"});
inline constexpr auto link_keys = std::to_array<std::string_view>({"to", "drop"});
inline constexpr auto dowel_keys = std::to_array<std::string_view>({"diameter", "depth", "wall"});

inline constexpr TableKeys root{"", root_keys};
inline constexpr TableKeys reach{"reach", box_keys};
inline constexpr TableKeys table{"table", table_keys};
inline constexpr TableKeys rotary_table{"rotary_table", rotary_table_keys};
inline constexpr TableKeys robot{"robot", robot_keys};
inline constexpr TableKeys base{"robot.base", pose_keys};
inline constexpr TableKeys cable{"robot.cable", cable_keys};
inline constexpr TableKeys capsule{"robot.capsule", capsule_keys};
inline constexpr TableKeys spindle{"spindle", spindle_keys};
inline constexpr TableKeys spindle_on{"spindle.on", switch_keys};
inline constexpr TableKeys spindle_speed{"spindle.speed", speed_keys};
inline constexpr TableKeys spindle_at_speed{"spindle.at_speed", at_speed_keys};
inline constexpr TableKeys spindle_off{"spindle.off", switch_keys};
inline constexpr TableKeys extraction{"extraction", extraction_keys};
inline constexpr TableKeys extraction_on{"extraction.on", switch_keys};
inline constexpr TableKeys extraction_off{"extraction.off", switch_keys};
inline constexpr TableKeys tool{"tool", tool_keys};
inline constexpr TableKeys stock{"stock", stock_keys};
inline constexpr TableKeys obstacle{"obstacle", obstacle_keys};
inline constexpr TableKeys margin{"margin", margin_keys};
inline constexpr TableKeys holding{"holding", holding_keys};
inline constexpr TableKeys start{"start", start_keys};
inline constexpr TableKeys program{"program", program_keys};
inline constexpr TableKeys load_tolerance{"load_tolerance", load_tolerance_keys};
inline constexpr TableKeys link{"link", link_keys};
inline constexpr TableKeys dowel{"dowel", dowel_keys};

inline constexpr auto all = std::to_array<TableKeys>(
    {root,    reach,      table,         rotary_table,     robot,       base,       cable,          capsule,
     spindle, spindle_on, spindle_speed, spindle_at_speed, spindle_off, extraction, extraction_on,  extraction_off,
     tool,    stock,      obstacle,      margin,           start,       program,    load_tolerance, link,
     dowel,   holding});

// Of a file that describes neither robot nor spindle these have no meaning.
inline constexpr auto of_machines =
    std::to_array<std::string_view>({"max_tilt_deg", "max_unreachable", "rotary_table", "extraction", "obstacle",
                                     "start", "program", "load_tolerance", "holding"});

}  // namespace keys_2
}  // namespace qchopper
