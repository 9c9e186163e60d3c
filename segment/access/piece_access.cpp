// Along chosen directions: one set of rays per piece, along the directions that some base allows; then every base
// chooses its own among them. O(samples x directions x bases) and the rays.

#include "segment/access/piece_access.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <utility>

#include "base/parallel.h"
#include "segment/cut/cut_evaluation.h"
#include "segment/cut/cut_piece.h"
#include "segment/mesh/measure.h"
#include "segment/mesh/oriented_box.h"
#include "segment/raster/projected_area.h"

namespace qchopper {
namespace {

std::vector<PieceBase> sides_of(const Piece& piece) {
    const OrientedBox box = oriented_box(piece.mesh->points);
    std::vector<PieceBase> sides;
    for (const int axis : {2, 1, 0}) {
        for (const double sign : {1.0, -1.0}) {
            PieceBase side;
            side.number = static_cast<int>(sides.size()) + 1;
            side.base.up = sign * box.axis[static_cast<std::size_t>(axis)];
            sides.push_back(side);
        }
    }
    return sides;
}

// The directions of the scan that some base allows, and the ups of all bases, so that no ray is cast twice for them.
std::vector<Vec3> directions_for(std::span<const PieceBase> bases, const std::array<Vec3, 3>& axes, double tilt_deg) {
    std::vector<Vec3> directions;
    for (const Vec3& d : tool_directions(axes)) {
        const auto allows = [&](const PieceBase& b) { return is_allowed(d, b.base.up, tilt_deg); };
        if (std::any_of(bases.begin(), bases.end(), allows)) directions.push_back(d);
    }
    for (const PieceBase& b : bases) {
        if (index_of(directions, b.base.up) == directions.size()) directions.push_back(b.base.up);
    }
    return directions;
}

std::shared_ptr<const SampledPiece> samples_of(const Piece& piece, std::span<const PieceBase> bases,
                                               const PieceAccessOptions& options) {
    if (options.takes_kept && piece.samples && piece.samples->accessibility.sample.size() >= options.samples) {
        return piece.samples;
    }
    const OrientedBox box = oriented_box(piece.mesh->points);
    return std::make_shared<const SampledPiece>(
        sampled_alone(piece, directions_for(bases, box.axis, options.tilt_deg), options.samples));
}

std::vector<Vec3> those_held(const PieceBase& base, std::vector<Vec3> directions, const ReachableDirections& held) {
    if (!held) return directions;
    const std::vector<std::uint8_t> is_held = held(base, directions);
    std::vector<Vec3> kept;
    for (std::size_t i = 0; i < directions.size(); ++i) {
        if (is_held[i] != 0) kept.push_back(directions[i]);
    }
    return kept;
}

}  // namespace

const BaseAccess& PieceAccess::best() const {
    assert(!bases.empty());
    return *std::min_element(bases.begin(), bases.end(),
                             [](const BaseAccess& a, const BaseAccess& b) { return a.share() < b.share(); });
}

BaseAccess base_access(const SampledPiece& samples, const PieceBase& base, const PieceAccessOptions& options,
                       const ReachableDirections& held) {
    const JudgedPiece judged = samples.judged();
    const std::vector<Vec3>& all = judged.scan.directions;
    std::vector<Vec3> allowed;
    for (const std::uint32_t k : allowed_directions(all, base.base.up, options.tilt_deg)) allowed.push_back(all[k]);
    std::vector<std::uint32_t> possible;
    for (const Vec3& d : those_held(base, std::move(allowed), held)) {
        possible.push_back(static_cast<std::uint32_t>(index_of(all, d)));
    }
    std::vector<Vec3> further;
    if (options.asks_dense) {
        further = dense_directions();
        std::erase_if(further, [&](Vec3 d) { return !is_allowed(d, base.base.up, options.tilt_deg); });
    }
    BaseAccess access;
    access.base = base;
    access.directions =
        choose_directions(judged, base.base, possible, those_held(base, std::move(further), held), options.directions);
    access.area_mm2 = judged.surface_mm2(base.base);
    access.unreachable_mm2 = access.directions.by_chosen.total_mm2(options.tilt_deg);
    return access;
}

PieceAccess piece_access(const Piece& piece, std::span<const PieceBase> bases, const PieceAccessOptions& options,
                         const ReachableDirections& held) {
    assert(!bases.empty());
    PieceAccess result{samples_of(piece, bases, options), {}};
    for (const PieceBase& base : bases) result.bases.push_back(base_access(*result.samples, base, options, held));
    return result;
}

std::vector<PieceBase> bases_of(const Piece& piece) {
    const auto project = [&](std::vector<PieceBase> bases) {
        parallel_for(0, bases.size(), [&](std::size_t i) {
            bases[i].projected_mm2 = projected_area_mm2(*piece.mesh, bases[i].base.up);
        });
        return bases;
    };
    std::vector<PieceBase> caps;
    for (const OwnedCap& cap : owned_caps(piece)) caps.push_back({cap.cut, lying_on(cap), cap.area_mm2, 0});
    caps = project(std::move(caps));
    std::erase_if(caps, [](const PieceBase& base) { return !carries(base.base_mm2, base.projected_mm2); });
    return caps.empty() ? project(sides_of(piece)) : caps;
}

AreaOnBase area_on_best_base(const Piece& piece, double tilt_deg) {
    assert(piece.samples);
    const JudgedPiece judged = piece.samples->judged();
    std::vector<PieceBase> bases;
    for (const OwnedCap& cap : judged.caps) {
        const TiltBase base = lying_on(cap);
        const double projected = projected_area_mm2(judged, base.up);
        if (carries(cap.area_mm2, projected)) bases.push_back({cap.cut, base, cap.area_mm2, projected});
    }
    if (bases.empty()) bases = sides_of(piece);
    std::optional<AreaOnBase> best;
    for (const PieceBase& base : bases) {
        const double unreachable = unreachable_area(judged, base.base, tilt_deg).total_mm2(tilt_deg);
        if (!best || unreachable < best->unreachable_mm2) best = {base, judged.surface_mm2(base.base), unreachable};
    }
    return *best;
}

std::optional<double> unreachable_when_cut_mm2(const Piece& piece, const Plane& plane, double fragment_volume_mm3,
                                               double tilt_deg) {
    std::optional<CutPieces> made = cut_piece(piece, plane, new_cut);
    if (!made) return std::nullopt;
    sample_parts(piece, *made);
    double unreachable = 0;
    for (const Piece& part : made->pieces) {
        if (volume_mm3(*part.mesh) < fragment_volume_mm3) continue;
        unreachable += area_on_best_base(part, tilt_deg).unreachable_mm2;
    }
    return unreachable;
}

}  // namespace qchopper
