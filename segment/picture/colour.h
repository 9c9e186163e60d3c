// Colours, 8 bits a channel, and those of pieces.

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

// Twelve colours that stay apart for colour-blind eyes too, then again from the first.
Rgb piece_colour(std::size_t index);

// The natural colour for a mesh that is not a segmentation.
constexpr Rgb bone_colour{226, 214, 190};

}  // namespace qchopper
