// The repair options that an operator chooses and a project file stores: with them the same scan gives the same solid.

#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "segment/repair/options.h"

namespace qchopper {

struct RepairChoices {
    double weld_mm = 0;  // border points nearer than this are merged; 0: off
    Fill fill = Fill::by_size;
    bool resolve_self_intersections = false;
    bool smooth_pen_grooves = false;
    double alpha_wrap_mm = 0;  // 0: off
    bool operator==(const RepairChoices&) const = default;
};

// The default options with these choices.
RepairOptions options_of(const RepairChoices& choices);

// "auto", "flat", "fair" or "none".
std::string name_of(Fill fill);
// Nothing for any other name.
std::optional<Fill> fill_named(std::string_view name);

}  // namespace qchopper
