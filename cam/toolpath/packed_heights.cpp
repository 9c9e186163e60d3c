#include "cam/toolpath/packed_heights.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <limits>

namespace qchopper {
namespace {

constexpr std::size_t worth_a_stretch = 8;  // equal values; fewer are stored as they are

// The end of the values from `at` on that have its bits.
std::size_t end_of_equal(std::span<const float> heights, std::size_t at) {
    const auto bits = std::bit_cast<std::uint32_t>(heights[at]);
    while (++at < heights.size() && std::bit_cast<std::uint32_t>(heights[at]) == bits) {
    }
    return at;
}

}  // namespace

PackedHeights::PackedHeights(std::span<const float> heights) {
    assert(heights.size() <= std::numeric_limits<std::uint32_t>::max());
    Stretch stretch;
    for (std::size_t at = 0; at < heights.size();) {
        const std::size_t end = end_of_equal(heights, at);
        if (end - at >= worth_a_stretch) {
            values_.push_back(heights[at]);
            stretch.equal = static_cast<std::uint32_t>(end - at);
            stretches_.push_back(stretch);
            stretch = {};
        } else {
            values_.insert(values_.end(), heights.begin() + static_cast<std::ptrdiff_t>(at),
                           heights.begin() + static_cast<std::ptrdiff_t>(end));
            stretch.different += static_cast<std::uint32_t>(end - at);
        }
        at = end;
    }
    if (stretch.different > 0) stretches_.push_back(stretch);
    stretches_.shrink_to_fit();
    values_.shrink_to_fit();
}

std::vector<float> PackedHeights::unpacked() const {
    std::size_t count = 0;
    for (const Stretch& stretch : stretches_) count += stretch.different + std::size_t{stretch.equal};
    std::vector<float> heights;
    heights.reserve(count);
    auto value = values_.begin();
    for (const Stretch& stretch : stretches_) {
        heights.insert(heights.end(), value, value + stretch.different);
        value += stretch.different;
        if (stretch.equal > 0) heights.insert(heights.end(), stretch.equal, *value++);
    }
    return heights;
}

std::size_t PackedHeights::bytes() const {
    return stretches_.size() * sizeof(Stretch) + values_.size() * sizeof(float);
}

}  // namespace qchopper
