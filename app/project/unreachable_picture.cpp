// Two views side by side, without ambient light, so that shade is not taken for a colour; the legend is drawn below.
// O(triangles + samples) a view.

#include "app/project/unreachable_picture.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstdint>

#include "cam/job/setup_picture.h"
#include "segment/mesh/triangle_mesh.h"
#include "segment/picture/exploded.h"
#include "segment/picture/lettering.h"
#include "segment/picture/picture.h"
#include "segment/picture/png.h"

namespace qchopper {
namespace {

constexpr int view_width = 1000;
constexpr int view_height = 900;
constexpr int legend_height = 60;
constexpr double letter_height = 15;
constexpr double letter_width = 11.8;  // at that height, about
constexpr int square = 24;

struct Named {
    Rgb colour;
    const char* name;
};

constexpr std::uint8_t base_index = 6;

// In the order of SurfaceState; then the base.
std::array<Named, base_index + 1> colours(bool narrow_counts) {
    const auto of = [&](SurfaceState state, const char* name) {
        return Named{surface_colour(state, narrow_counts), name};
    };
    return {{of(SurfaceState::reached, "reached"),
             of(SurfaceState::too_narrow, narrow_counts ? "too narrow" : "too narrow: does not count"),
             of(SurfaceState::steep, "steep"),
             of(SurfaceState::holder, "holder in the way"),
             of(SurfaceState::hidden, "hidden"),
             of(SurfaceState::ignored, "ignored: it may stay"),
             {base_colour, "base"}}};
}

std::vector<std::uint8_t> colours_of(const Piece& piece, const CarvedPiece& carved) {
    assert(carved.states.empty() || carved.states.size() == piece.mesh->triangles.size());
    std::vector<std::uint8_t> result(piece.mesh->triangles.size(), 0);
    for (std::size_t t = 0; t < result.size(); ++t) {
        if (!carved.states.empty()) result[t] = static_cast<std::uint8_t>(carved.states[t]);
        if (carved.base_cut && cap_of(*piece.mesh, t) == *carved.base_cut) result[t] = base_index;
    }
    return result;
}

void paste(Pixels& onto, const Pixels& view, int left) {
    for (int y = 0; y < view.height; ++y) {
        const auto from = view.rows.begin() + static_cast<std::ptrdiff_t>(y) * view.width;
        std::copy(from, from + view.width, onto.rows.begin() + static_cast<std::ptrdiff_t>(y) * onto.width + left);
    }
}

// Of the colours that occur, and always of the three kinds of surface that cuts and tools can open.
void draw_legend(Pixels& pixels, std::span<const Named> entries, const std::array<bool, base_index + 1>& occurs) {
    double x = 30;
    const int top = pixels.height - (legend_height + square) / 2;
    for (std::size_t i = 0; i < entries.size(); ++i) {
        const auto state = static_cast<SurfaceState>(i);
        const bool is_kind =
            state == SurfaceState::hidden || state == SurfaceState::too_narrow || state == SurfaceState::steep;
        if (!occurs[i] && !is_kind) continue;
        for (int row = top; row < top + square; ++row) {
            const auto first =
                pixels.rows.begin() + static_cast<std::ptrdiff_t>(row) * pixels.width + static_cast<std::ptrdiff_t>(x);
            std::fill(first, first + square, entries[i].colour);
        }
        const std::string name = entries[i].name;
        const double width = letter_width * static_cast<double>(name.size());
        draw_text(pixels, x + square + 10 + width / 2, top + square / 2.0, name, letter_height);
        x += square + 10 + width + 30;
    }
}

}  // namespace

Bytes draw_unreachable(std::span<const Piece> pieces, std::span<const Vec3> shifts, std::span<const CarvedPiece> carved,
                       bool narrow_counts, const Context& context) {
    assert(!pieces.empty() && shifts.size() == pieces.size() && carved.size() == pieces.size());
    const auto entries = colours(narrow_counts);
    std::array<Rgb, entries.size()> palette;
    for (std::size_t i = 0; i < entries.size(); ++i) palette[i] = entries[i].colour;
    std::vector<std::vector<std::uint8_t>> indices;
    std::array<bool, entries.size()> occurs{};
    for (std::size_t p = 0; p < pieces.size(); ++p) {
        indices.push_back(colours_of(pieces[p], carved[p]));
        for (const std::uint8_t i : indices.back()) occurs[i] = true;
    }
    std::vector<ColouredMesh> meshes = coloured(pieces, shifts);
    for (std::size_t p = 0; p < meshes.size(); ++p) {
        meshes[p].palette = palette;
        meshes[p].colour_of = indices[p];
    }
    const Scene scene(meshes, false);
    PictureOptions options;
    options.width = view_width;
    options.height = view_height;
    options.background = {255, 255, 255};
    options.ambient_rays = 0;
    Pixels all{2 * view_width, view_height + legend_height, {}};
    all.rows.assign(static_cast<std::size_t>(all.width) * static_cast<std::size_t>(all.height), options.background);
    paste(all, render(scene, options, context), 0);
    options.view = {-options.view.x, -options.view.y, -options.view.z};
    paste(all, render(scene, options, context), view_width);
    draw_legend(all, entries, occurs);
    return to_png(all.rows, all.width, all.height);
}

}  // namespace qchopper
