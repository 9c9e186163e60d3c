// Two pictures pasted beside each other. O(triangles) a side.

#include "segment/picture/two_sides.h"

#include <algorithm>

#include "segment/picture/lettering.h"
#include "segment/picture/picture.h"
#include "segment/picture/png.h"

namespace qchopper {
namespace {

void paste(Pixels& onto, const Pixels& view, int left) {
    for (int y = 0; y < view.height; ++y) {
        const auto from = view.rows.begin() + static_cast<std::ptrdiff_t>(y) * view.width;
        std::copy(from, from + view.width, onto.rows.begin() + static_cast<std::ptrdiff_t>(y) * onto.width + left);
    }
}

void draw_square(Pixels& pixels, int left, int top, int side, Rgb colour) {
    for (int row = top; row < top + side; ++row) {
        const auto first = pixels.rows.begin() + static_cast<std::ptrdiff_t>(row) * pixels.width + left;
        std::fill(first, first + side, colour);
    }
}

void draw_legend(Pixels& pixels, std::span<const LegendEntry> legend, const TwoSidesLayout& layout) {
    double x = layout.left_of_legend;
    const int top = pixels.height - (layout.legend_height + layout.square) / 2;
    for (const LegendEntry& entry : legend) {
        draw_square(pixels, static_cast<int>(x), top, layout.square, entry.colour);
        const double width = layout.letter_width * static_cast<double>(entry.name.size());
        draw_text(pixels, x + layout.square + layout.after_square + width / 2, top + layout.square / 2.0, entry.name,
                  layout.letter_height);
        x += layout.square + layout.after_square + width + layout.after_name;
    }
}

}  // namespace

Bytes draw_two_sides(std::span<const ColouredMesh> meshes, std::span<const LegendEntry> legend,
                     const TwoSidesLayout& layout, const Context& context) {
    const Scene scene(meshes, false);
    PictureOptions options;
    options.width = layout.view_width;
    options.height = layout.view_height;
    options.background = {255, 255, 255};
    options.ambient_rays = 0;
    Pixels all{2 * layout.view_width, layout.view_height + layout.legend_height, {}};
    all.rows.assign(static_cast<std::size_t>(all.width) * static_cast<std::size_t>(all.height), options.background);
    paste(all, render(scene, options, context), 0);
    options.view = {-options.view.x, -options.view.y, -options.view.z};
    paste(all, render(scene, options, context), layout.view_width);
    draw_legend(all, legend, layout);
    return to_png(all);
}

}  // namespace qchopper
