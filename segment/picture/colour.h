// Colours with 8 bits per channel (sRGB), and the palette of the pieces.

#pragma once

#include <cstddef>
#include <cstdint>

namespace qchopper {

struct Rgb {
    std::uint8_t r = 0;
    std::uint8_t g = 0;
    std::uint8_t b = 0;
    bool operator==(const Rgb&) const = default;
};

// Twelve colours that differ for colour-blind eyes too, then again from the first
// (tests/segment/picture/colour_test.cpp).
Rgb piece_colour(std::size_t index);

// For a mesh that is not a segmentation.
constexpr Rgb bone_colour{226, 214, 190};

}  // namespace qchopper
