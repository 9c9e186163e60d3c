// The colours of deviations from the piece as ordered, in pictures and viewer files.

#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "segment/picture/colour.h"

namespace qchopper {

struct DeviationRange {
    float below;  // values below it, and not below that of the range before
    Rgb colour;
    const char* name;
};

// mm. Colours that differ for colour-blind eyes too.
inline constexpr std::array<DeviationRange, 6> deviation_ranges{
    {{-0.25F, {165, 0, 38}, "gouge > 0.25"},
     {-0.05F, {244, 140, 80}, "gouge > 0.05"},
     {0.3F, {232, 228, 216}, "to 0.3"},
     {0.75F, {158, 202, 225}, "to 0.75"},
     {3.0F, {66, 126, 190}, "to 3 mm"},
     {std::numeric_limits<float>::infinity(), {20, 40, 100}, "more foam"}}};

// What the program gives up, behind the ranges.
inline constexpr std::uint8_t given_up_index = deviation_ranges.size();
inline constexpr Rgb given_up_colour{255, 205, 30};

// Per triangle the index of its range, or given_up_index. `is_given_up` has a value per triangle or none.
std::vector<std::uint8_t> deviation_classes(std::span<const float> deviation, const std::vector<bool>& is_given_up);

}  // namespace qchopper
