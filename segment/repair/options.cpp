// Names of fills, and options from choices.

#include "segment/repair/options.h"

#include <array>

namespace qchopper {
namespace {

constexpr std::array<std::string_view, 4> fills{"auto", "flat", "fair", "none"};  // in the order of Fill

}  // namespace

RepairOptions options_of(const RepairChoices& choices) {
    RepairOptions options;
    options.snap_borders_mm = choices.snap_borders_mm;
    options.fill.fill = choices.fill;
    options.resolve_self_intersections = choices.resolve_self_intersections;
    options.smooth_pen_grooves = choices.smooth_pen_grooves;
    options.alpha_wrap_mm = choices.alpha_wrap_mm;
    return options;
}

std::string name_of(Fill fill) {
    return std::string(fills[static_cast<std::size_t>(fill)]);
}

std::optional<Fill> fill_named(std::string_view name) {
    for (std::size_t i = 0; i < fills.size(); ++i) {
        if (fills[i] == name) return static_cast<Fill>(i);
    }
    return std::nullopt;
}

}  // namespace qchopper
