// The heights of a map that is not in use: of equal values that follow each other one, and how many.
//
// Exact to the bit. Maps of finishing are worked out near surface that is left and hold one value elsewhere
// (tests/cam/toolpath/packed_heights_test.cpp).

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace qchopper {

class PackedHeights {
 public:
    PackedHeights() = default;
    // Fewer than 2^32 heights. O(heights).
    explicit PackedHeights(std::span<const float> heights);

    std::vector<float> unpacked() const;  // O(heights)
    std::size_t bytes() const;

 private:
    // Values as they are, and one that follows them several times.
    struct Stretch {
        std::uint32_t different = 0;
        std::uint32_t equal = 0;
    };
    std::vector<Stretch> stretches_;
    std::vector<float> values_;  // of each stretch the different ones, then the equal one if there is any
};

}  // namespace qchopper
