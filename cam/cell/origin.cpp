// A table of names in the order of Origin.

#include "cam/cell/origin.h"

#include <array>
#include <cstddef>

namespace qchopper {
namespace {

constexpr std::array<std::string_view, 5> names{"data sheet", "measured", "assumed", "unstated", "by default"};
constexpr std::size_t names_in_files = 3;

}  // namespace

std::string_view to_word(Origin origin) {
    return names[static_cast<std::size_t>(origin)];
}

std::optional<Origin> origin_of(std::string_view word) {
    for (std::size_t i = 0; i < names_in_files; ++i) {
        if (names[i] == word) return static_cast<Origin>(i);
    }
    return std::nullopt;
}

}  // namespace qchopper
