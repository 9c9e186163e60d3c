// The keys that each table of a cell file may have (docs/user/cell-file.md, docs/user/cell-file.schema.json).
//
// In a table with the key `source`, the keys before it have an origin; `sources` may name them.

#pragma once

#include <algorithm>
#include <array>
#include <initializer_list>
#include <string_view>

#include "base/toml_reader.h"

namespace qchopper {

class TableKeys {
 public:
    constexpr TableKeys(std::string_view table, std::initializer_list<std::string_view> keys)
        : path(table), count_(keys.size()) {
        std::copy(keys.begin(), keys.end(), keys_.begin());
    }
    std::string_view path;  // "robot.capsule"; empty: outside of all tables
    constexpr operator Keys() const { return {keys_.data(), count_}; }
    // The keys before `source`; none without it.
    constexpr Keys with_origin() const {
        const auto* const source = std::find(keys_.begin(), keys_.end(), "source");
        return {keys_.data(), source == keys_.end() ? 0 : static_cast<std::size_t>(source - keys_.begin())};
    }

 private:
    std::array<std::string_view, 25> keys_;
    std::size_t count_;
};

namespace keys_2 {

inline constexpr TableKeys root{"",
                                {"version",         "name",           "id",         "clearance", "max_tilt_deg",
                                 "max_unreachable", "margin",         "reach",      "table",     "rotary_table",
                                 "robot",           "spindle",        "extraction", "tool",      "stock",
                                 "obstacle",        "start",          "program",    "link",      "dowel",
                                 "dowel_play",      "load_tolerance", "holding",    "saw",       "require_signature"}};
inline constexpr TableKeys reach{"reach", {"min", "max", "source", "sources"}};
inline constexpr TableKeys table{"table", {"centre", "size", "height", "source", "sources"}};
inline constexpr TableKeys rotary_table{
    "rotary_table", {"position", "abc_deg", "radius", "speed_deg_per_s", "source", "sources", "external_axis"}};
inline constexpr TableKeys robot{"robot",
                                 {"a1",
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
                                  "capsule"}};
inline constexpr TableKeys base{"robot.base", {"position", "abc_deg", "source", "sources"}};
inline constexpr TableKeys cable{"robot.cable", {"axis_4_deg", "axis_6_deg", "source", "sources"}};
inline constexpr TableKeys capsule{"robot.capsule", {"from", "to", "radius", "source", "sources", "link"}};
inline constexpr TableKeys spindle{"spindle",
                                   {"position", "abc_deg", "body_radius", "body_length", "body_offset", "mass_kg",
                                    "source", "sources", "tool_axis", "on", "speed", "at_speed", "off"}};
inline constexpr TableKeys spindle_on{"spindle.on", {"output", "call"}};
inline constexpr TableKeys spindle_speed{"spindle.speed", {"output", "call", "scale"}};
inline constexpr TableKeys spindle_at_speed{"spindle.at_speed", {"input", "call"}};
inline constexpr TableKeys spindle_off{"spindle.off", {"output", "call"}};
inline constexpr TableKeys extraction{"extraction", {"on", "off", "running"}};
inline constexpr TableKeys extraction_on{"extraction.on", {"output", "call"}};
inline constexpr TableKeys extraction_off{"extraction.off", {"output", "call"}};
inline constexpr TableKeys extraction_running{"extraction.running", {"input", "call"}};
inline constexpr TableKeys tool{"tool",
                                {"diameter", "corner_radius", "tip_angle_deg", "flute_length", "stick_out", "holder",
                                 "feed_mm_per_s", "rpm", "mass_kg", "removal_mm3_per_s", "source", "sources", "number",
                                 "name", "shape", "length_measured", "centre_cutting"}};
inline constexpr TableKeys stock{"stock",
                                 {"size", "kerf", "bending_strength", "source", "sources", "name", "material", "sawn"}};
inline constexpr TableKeys obstacle{"obstacle", {"min", "max", "source", "sources", "name"}};
inline constexpr TableKeys margin{"margin", {"sides", "top", "spoil"}};
inline constexpr TableKeys saw{"saw", {"accuracy", "flush_tolerance", "source", "sources"}};
inline constexpr TableKeys holding{"holding", {"cutting_force", "strength", "max_slenderness", "source", "sources"}};
inline constexpr TableKeys start{"start", {"joints_deg", "tip"}};
inline constexpr TableKeys program{
    "program",
    {"memory_bytes", "lines_per_chunk", "interpolation_cycle", "tool_change_time", "source", "sources", "dialect",
     "link_feed", "tool_change", "acceleration", "turn_speed_deg_per_s", "joint_move_percent", "scallop"}};
inline constexpr TableKeys load_tolerance{"load_tolerance", {"mass_kg", "centre_mm", "inertia_kg_m2"}};
inline constexpr TableKeys link{"link", {"to", "drop"}};
inline constexpr TableKeys dowel{"dowel", {"diameter", "depth", "wall"}};

inline constexpr auto all = std::to_array<TableKeys>({root,
                                                      reach,
                                                      table,
                                                      rotary_table,
                                                      robot,
                                                      base,
                                                      cable,
                                                      capsule,
                                                      spindle,
                                                      spindle_on,
                                                      spindle_speed,
                                                      spindle_at_speed,
                                                      spindle_off,
                                                      extraction,
                                                      extraction_on,
                                                      extraction_off,
                                                      extraction_running,
                                                      tool,
                                                      stock,
                                                      obstacle,
                                                      margin,
                                                      start,
                                                      program,
                                                      load_tolerance,
                                                      link,
                                                      dowel,
                                                      holding,
                                                      saw});

// Of a file that describes neither robot nor spindle these have no meaning.
inline constexpr auto of_machines =
    std::to_array<std::string_view>({"max_tilt_deg", "max_unreachable", "rotary_table", "extraction", "obstacle",
                                     "start", "program", "load_tolerance", "holding"});

}  // namespace keys_2

}  // namespace qchopper
