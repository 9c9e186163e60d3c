// Settings by name: cutting for what a tilting tool reaches; the thesis' objectives without a stop rule; and its four
// cases (Nicholson 2016, chapter 5; stop rules of the last two are ours). Tests: tests/app/engine/presets_test.cpp.

#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "segment/search/settings.h"

namespace qchopper {

// What `prepare` and `segment` take where the operator names none.
constexpr const char* default_preset = "carve";

// "carve", "thesis", "bunny", "femur", "vertebrae", "skull" or "chopper"; nothing for any other name. "thesis" is
// SearchSettings{}.
std::optional<SearchSettings> preset(std::string_view name);

struct PresetRow {
    const char* name;
    const char* sentence;  // what it is for
};
// In the order in which an operator would try them.
std::span<const PresetRow> preset_rows();

// Whether the stop rules of a project are still those that the preset carve brings. How rules are combined, the safety
// stop and whether too narrow surface counts are no rules.
bool are_rules_of_carve(std::string_view preset_name, const StopRules& rules);

// The settings of a project that knows its cell: a preset sees none. To the rules of carve is added that every piece
// fits the cell, and with the weight `unreachable` the tool tilts as far as the cell's does, rounded to 1e-9
// degrees: 60 degrees that went through radians are 60 again.
// The print volume, where none is given, is `largest_block`, what the largest block holds of a piece.
SearchSettings with_cell(SearchSettings settings, std::string_view preset_name, double max_tilt_deg,
                         std::optional<Vec3> largest_block = {});

// The settings of the preset chopper with the rule that every piece fits the print volume, if there is one and no rule
// is set; others as they are.
SearchSettings stopping_at_print_volume(SearchSettings settings, std::string_view preset_name);

}  // namespace qchopper
