// O(triangles) beside drawing.

#include "app/pictures/deviation_picture.h"

#include <algorithm>
#include <array>
#include <cassert>

#include "app/pictures/deviation_colours.h"
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

}  // namespace

Bytes deviation_picture(const TriangleMesh& mesh, std::span<const float> deviation,
                        const std::vector<bool>& is_given_up) {
    assert(deviation.size() == mesh.triangles.size() && !mesh.triangles.empty());
    assert(is_given_up.empty() || is_given_up.size() == mesh.triangles.size());
    std::array<Rgb, deviation_ranges.size() + 1> palette;
    for (std::size_t i = 0; i < deviation_ranges.size(); ++i) palette[i] = deviation_ranges[i].colour;
    palette[given_up_index] = given_up_colour;
    const std::vector<std::uint8_t> colours = deviation_classes(deviation, is_given_up);
    ColouredMesh coloured{&mesh, bone_colour, {}};
    coloured.palette = palette;
    coloured.colour_of = colours;
    std::vector<LegendEntry> legend;
    legend.reserve(deviation_ranges.size());
    for (const DeviationRange& range : deviation_ranges) legend.push_back({range.colour, range.name});
    if (std::ranges::find(colours, given_up_index) != colours.end()) legend.push_back({given_up_colour, "given up"});
    return draw_two_sides(std::span(&coloured, 1), legend, layout);
}

}  // namespace qchopper
