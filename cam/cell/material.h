// What a block is made of, with the numbers that the ticket carries and the words that the cell file uses.

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace qchopper {

enum class Material : std::uint16_t { unspecified = 0, pu_foam = 1, eps = 2, xps = 3, other = 4 };

// "unspecified", "pu_foam", "eps", "xps", "other"; forth and back is identity (tests/cam/cell/cell_test.cpp).
std::string to_word(Material material);
std::optional<Material> material_of(std::string_view word);

}  // namespace qchopper
