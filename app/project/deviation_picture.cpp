// A table of ranges gives the colours; drawn without ambient light, so that shade is not taken for a colour.
// O(triangles) a view.

#include "app/project/deviation_picture.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <vector>

#include "cam/job/program_section.h"
#include "segment/picture/lettering.h"
#include "segment/picture/picture.h"
#include "segment/picture/png.h"

namespace qchopper {
namespace {

constexpr int legend_height = 70;
constexpr int view_width = deviation_picture_width / 2;
constexpr int view_height = deviation_picture_height - legend_height;
constexpr double letter_height = 13;
constexpr double letter_width = 11.6;  // at that height, about
constexpr int square = 20;

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

std::vector<std::uint8_t> colours_of(std::span<const float> deviation) {
    std::vector<std::uint8_t> colours;
    colours.reserve(deviation.size());
    for (const float value : deviation) colours.push_back(index_of(value));
    return colours;
}

void fill(Pixels& pixels, int left, int top, int width, int height, Rgb colour) {
    for (int row = top; row < top + height; ++row) {
        const auto first = pixels.rows.begin() + static_cast<std::ptrdiff_t>(row) * pixels.width + left;
        std::fill(first, first + width, colour);
    }
}

void draw_legend(Pixels& pixels) {
    double x = 12;
    const int top = pixels.height - (legend_height + square) / 2;
    for (const DeviationRange& range : ranges) {
        fill(pixels, static_cast<int>(x), top, square, square, range.colour);
        const std::string name = range.name;
        const double width = letter_width * static_cast<double>(name.size());
        draw_text(pixels, x + square + 6 + width / 2, top + square / 2.0, name, letter_height);
        x += square + 6 + width + 16;
    }
}

void paste(Pixels& onto, const Pixels& view, int left) {
    for (int y = 0; y < view.height; ++y) {
        const auto from = view.rows.begin() + static_cast<std::ptrdiff_t>(y) * view.width;
        std::copy(from, from + view.width, onto.rows.begin() + static_cast<std::ptrdiff_t>(y) * onto.width + left);
    }
}

}  // namespace

Bytes deviation_picture(const TriangleMesh& mesh, std::span<const float> deviation) {
    assert(deviation.size() == mesh.triangles.size() && !mesh.triangles.empty());
    std::array<Rgb, ranges.size()> palette;
    for (std::size_t i = 0; i < ranges.size(); ++i) palette[i] = ranges[i].colour;
    const std::vector<std::uint8_t> colours = colours_of(deviation);
    ColouredMesh coloured{&mesh, bone_colour, {}};
    coloured.palette = palette;
    coloured.colour_of = colours;
    const Scene scene(std::span(&coloured, 1), false);
    PictureOptions options;
    options.width = view_width;
    options.height = view_height;
    options.background = {255, 255, 255};
    options.ambient_rays = 0;
    Pixels all{deviation_picture_width, deviation_picture_height, {}};
    all.rows.assign(static_cast<std::size_t>(all.width) * static_cast<std::size_t>(all.height), options.background);
    paste(all, render(scene, options), 0);
    options.view = {-options.view.x, -options.view.y, -options.view.z};
    paste(all, render(scene, options), view_width);
    draw_legend(all);
    return to_png(all.rows, all.width, all.height);
}

}  // namespace qchopper
