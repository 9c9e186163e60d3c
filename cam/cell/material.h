// The material of a block, with its numbers in the ticket and its names in files (tests/cam/cell/cell_test.cpp).

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace qchopper {

enum class Material : std::uint16_t { unspecified = 0, pu_foam = 1, eps = 2, xps = 3, other = 4 };

// "unspecified", "pu_foam", "eps", "xps" or "other".
std::string to_word(Material material);
// The inverse of to_word; nothing for any other text.
std::optional<Material> material_of(std::string_view word);

}  // namespace qchopper
