// What an operator chooses of a repair and a project remembers, so that going on with it gives the same solid again.

#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "segment/repair/options.h"

namespace qchopper {

struct RepairChoices {
    double weld_mm = 0;  // border points nearer than this become one; 0: off
    Fill fill = Fill::by_size;
    bool resolve_self_intersections = false;
    bool smooth_marks = false;
    double wrap_mm = 0;  // 0: off
    bool operator==(const RepairChoices&) const = default;
};

RepairOptions options_of(const RepairChoices& choices);

// "auto", "flat", "fair", "none"
std::string name_of(Fill fill);
std::optional<Fill> fill_named(std::string_view name);

}  // namespace qchopper
