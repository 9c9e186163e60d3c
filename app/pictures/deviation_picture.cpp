// A table of ranges gives the colours. O(triangles).

#include "app/pictures/deviation_picture.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <limits>

#include "cam/job/sheet/program_section.h"
#include "segment/picture/two_sides.h"

namespace qchopper {
namespace {

constexpr int legend_height = 70;
constexpr TwoSidesLayout layout{.view_width = deviation_picture_width / 2,
                                .view_height = deviation_picture_height - legend_height,
                                .legend_height = legend_height,
                                .square = 20,
                                .letter_height = 13,
                                .letter_width = 11.6,
                                .left_of_legend = 12,
                                .after_square = 6,
                                .after_name = 16};

struct DeviationRange {
    float below;  // values below it, and not below that of the range before
    Rgb colour;
    const char* name;
};

// mm. Colours that differ for colour-blind eyes too.
constexpr float open_end = std::numeric_limits<float>::infinity();
constexpr std::array<DeviationRange, 6> ranges{{{-0.25F, {165, 0, 38}, "gouge > 0.25"},
                                                {-0.05F, {244, 140, 80}, "gouge > 0.05"},
                                                {0.3F, {232, 228, 216}, "to 0.3"},
                                                {0.75F, {158, 202, 225}, "to 0.75"},
                                                {3.0F, {66, 126, 190}, "to 3 mm"},
                                                {open_end, {20, 40, 100}, "more foam"}}};

std::uint8_t index_of(float value) {
    std::uint8_t i = 0;
    while (!(value < ranges[i].below) && i + 1U < ranges.size()) ++i;
    return i;
}

constexpr std::uint8_t given_up_index = ranges.size();
constexpr Rgb given_up_colour{255, 205, 30};

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

Bytes deviation_picture(const TriangleMesh& mesh, std::span<const float> deviation,
                        const std::vector<bool>& is_given_up) {
    assert(deviation.size() == mesh.triangles.size() && !mesh.triangles.empty());
    assert(is_given_up.empty() || is_given_up.size() == mesh.triangles.size());
    std::array<Rgb, ranges.size() + 1> palette;
    for (std::size_t i = 0; i < ranges.size(); ++i) palette[i] = ranges[i].colour;
    palette[given_up_index] = given_up_colour;
    const std::vector<std::uint8_t> colours = deviation_classes(deviation, is_given_up);
    ColouredMesh coloured{&mesh, bone_colour, {}};
    coloured.palette = palette;
    coloured.colour_of = colours;
    std::vector<LegendEntry> legend;
    legend.reserve(ranges.size());
    for (const DeviationRange& range : ranges) legend.push_back({range.colour, range.name});
    if (std::ranges::find(colours, given_up_index) != colours.end()) legend.push_back({given_up_colour, "given up"});
    return draw_two_sides(std::span(&coloured, 1), legend, layout);
}

}  // namespace qchopper
