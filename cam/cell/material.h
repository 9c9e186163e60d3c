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
// N/mm2 in bending, of the weak ones of each kind. PU: 0.3 * 127 * (80 / 1200)^1.5 for foam of 80 kg/m3 (L. J. Gibson
// and M. F. Ashby, "Cellular Solids", 2nd ed. 1997, chapter 5: tensile strength of rigid foams, and table 3.1). EPS:
// level BS150 of EN 13163. XPS: level TR200 of EN 13164. Of others and unspecified ones the least of these.
double assumed_bending_strength(Material material);
// The inverse of to_word; nothing for any other text.
std::optional<Material> material_of(std::string_view word);

}  // namespace qchopper
