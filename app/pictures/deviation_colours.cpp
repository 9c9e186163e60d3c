// A table of ranges gives the colours. O(triangles).

#include "app/pictures/deviation_colours.h"

namespace qchopper {
namespace {

std::uint8_t index_of(float value) {
    std::uint8_t i = 0;
    while (!(value < deviation_ranges[i].below) && i + 1U < deviation_ranges.size()) ++i;
    return i;
}

}  // namespace

std::vector<std::uint8_t> deviation_classes(std::span<const float> deviation, const std::vector<bool>& is_given_up) {
    std::vector<std::uint8_t> colours;
    colours.reserve(deviation.size());
    for (const float value : deviation) colours.push_back(index_of(value));
    for (std::size_t t = 0; t < is_given_up.size(); ++t) {
        if (is_given_up[t]) colours[t] = given_up_index;
    }
    return colours;
}

}  // namespace qchopper
