// The states of the surface are indices of a palette. O(triangles + samples).

#include "app/pictures/unreachable_picture.h"

#include <array>
#include <cassert>
#include <cstdint>

#include "cam/job/sheet/setup_picture.h"
#include "segment/mesh/triangle_mesh.h"
#include "segment/picture/exploded.h"
#include "segment/picture/two_sides.h"

namespace qchopper {
namespace {

// In the order of SurfaceState; then the base.
std::array<LegendEntry, base_state + 1> colours(bool narrow_counts) {
    const auto of = [&](SurfaceState state, const char* name) {
        return LegendEntry{surface_colour(state, narrow_counts), name};
    };
    return {{of(SurfaceState::reached, "reached"),
             of(SurfaceState::too_narrow, narrow_counts ? "too narrow" : "too narrow: does not count"),
             of(SurfaceState::steep, "steep"),
             of(SurfaceState::holder, "holder in the way"),
             of(SurfaceState::hidden, "hidden"),
             of(SurfaceState::ignored, "ignored: it may stay"),
             {base_colour, "base"}}};
}

// Of the colours that occur, and always of the three kinds of surface that cuts and tools can open.
std::vector<LegendEntry> legend_of(std::span<const LegendEntry> entries,
                                   const std::array<bool, base_state + 1>& occurs) {
    std::vector<LegendEntry> legend;
    for (std::size_t i = 0; i < entries.size(); ++i) {
        const auto state = static_cast<SurfaceState>(i);
        const bool is_kind =
            state == SurfaceState::hidden || state == SurfaceState::too_narrow || state == SurfaceState::steep;
        if (occurs[i] || is_kind) legend.push_back(entries[i]);
    }
    return legend;
}

}  // namespace

std::vector<std::uint8_t> surface_states(const TriangleMesh& mesh, const MilledPiece& milled) {
    assert(milled.states.empty() || milled.states.size() == mesh.triangles.size());
    std::vector<std::uint8_t> result(mesh.triangles.size(), 0);
    for (std::size_t t = 0; t < result.size(); ++t) {
        if (!milled.states.empty()) result[t] = static_cast<std::uint8_t>(milled.states[t]);
        if (milled.base_cut && cap_of(mesh, t) == *milled.base_cut) result[t] = base_state;
    }
    return result;
}

Bytes draw_unreachable(std::span<const Piece> pieces, std::span<const Vec3> shifts, std::span<const MilledPiece> milled,
                       bool narrow_counts, const Context& context) {
    assert(!pieces.empty() && shifts.size() == pieces.size() && milled.size() == pieces.size());
    const auto entries = colours(narrow_counts);
    std::array<Rgb, entries.size()> palette;
    for (std::size_t i = 0; i < entries.size(); ++i) palette[i] = entries[i].colour;
    std::vector<std::vector<std::uint8_t>> indices;
    std::array<bool, entries.size()> occurs{};
    for (std::size_t p = 0; p < pieces.size(); ++p) {
        indices.push_back(surface_states(*pieces[p].mesh, milled[p]));
        for (const std::uint8_t i : indices.back()) occurs[i] = true;
    }
    std::vector<ColouredMesh> meshes = coloured(pieces, shifts);
    for (std::size_t p = 0; p < meshes.size(); ++p) {
        meshes[p].palette = palette;
        meshes[p].colour_of = indices[p];
    }
    return draw_two_sides(meshes, legend_of(entries, occurs), whole_scan_layout, context);
}

}  // namespace qchopper
