// Evaluates every cap (undercut.h), or every side of the oriented box by a sample of the triangles, and keeps the best.
// O(caps * triangles), a ray per triangle for the base that is chosen, and for a piece without caps six rays per
// triangle of the sample.

#include "cam/setup/setup.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "cam/setup/envelope.h"
#include "cam/setup/footprint.h"
#include "cam/setup/undercut.h"
#include "segment/mesh/oriented_box.h"
#include "segment/mesh/projected_area.h"
#include "segment/mesh/rays.h"

namespace qchopper {
namespace {

constexpr double tie = 1e-9;                // undercuts and ratios that differ by no more are equal
constexpr double least_stable_share = 0.1;  // of the projected area

std::string percent(double share) {
    return std::to_string(std::lround(100 * share)) + " %";
}

// A way to lay the piece: on a cap, or without one on a side of its oriented box.
struct BaseCandidate {
    std::optional<std::int32_t> base;
    Vec3 up;
    Facing facing;
    double projected_area_mm2 = 0;
    bool is_stable = false;
};

// One candidate per half-space whose cap the piece still has.
std::vector<BaseCandidate> caps_owned(const Piece& piece) {
    std::vector<BaseCandidate> candidates;
    for (const HalfSpace& half_space : piece.half_spaces) {
        const Facing sums = facing(*piece.mesh, half_space.up(), half_space.cut);
        if (sums.base_triangles == 0) continue;
        BaseCandidate candidate{half_space.cut, half_space.up(), sums, projected_area_mm2(*piece.mesh, half_space.up()),
                                false};
        candidate.is_stable = sums.base >= least_stable_share * candidate.projected_area_mm2;
        candidates.push_back(candidate);
    }
    return candidates;
}

// A comparison with a tolerance is no order, so the best is found first and the lowest cut among its equals second.
BaseCandidate best_cap(const std::vector<BaseCandidate>& candidates) {
    assert(!candidates.empty());
    BaseCandidate best = candidates.front();
    for (const BaseCandidate& other : candidates) {
        const bool less = other.facing.undercut() < best.facing.undercut();
        if (other.is_stable != best.is_stable ? other.is_stable : less) best = other;
    }
    BaseCandidate first = best;
    for (const BaseCandidate& other : candidates) {
        const bool equal = other.is_stable == best.is_stable && other.facing.undercut() - best.facing.undercut() <= tie;
        if (equal && *other.base < *first.base) first = other;
    }
    return first;
}

// The side from which the least area of a sample is occluded. Shortest side first: of equal sides the piece lies on the
// one that makes it lowest. Sides that differ by no more than the error of the sample are equal.
BaseCandidate best_side(const Piece& piece, const RayTree& rays) {
    constexpr std::size_t sample_size = 20'000;
    constexpr double sampling_error = 0.005;
    const OrientedBox box = oriented_box(piece.mesh->points);
    const std::vector<std::uint32_t> sample = area_sample(*piece.mesh, sample_size);
    Vec3 up = box.axis[2];
    double least = std::numeric_limits<double>::infinity();
    for (int axis = 2; axis >= 0 && !sample.empty(); --axis) {
        for (const double sign : {1.0, -1.0}) {
            const Vec3 direction = sign * box.axis[axis];
            const double occluded = occluded_area_ratio(*piece.mesh, rays, direction, sample);
            if (occluded >= least - sampling_error) continue;
            least = occluded;
            up = direction;
        }
    }
    return {std::nullopt, up, facing(*piece.mesh, up, std::nullopt), projected_area_mm2(*piece.mesh, up), false};
}

// Precondition: the mesh has points.
Box bounds_in(const Pose& piece_in_setup, const TriangleMesh& mesh) {
    Box box{apply(piece_in_setup, mesh.points.front()), apply(piece_in_setup, mesh.points.front())};
    for (const Vec3& p : mesh.points) extend(box, apply(piece_in_setup, p));
    return box;
}

// Turns the piece so that the smallest rectangle of its footprint lies along x, then puts it on z = 0.
void place(const TriangleMesh& mesh, Setup& setup) {
    const auto [e1, e2] = frame_under(setup.up);
    std::vector<Point2> footprint;
    footprint.reserve(mesh.points.size());
    for (const Vec3& p : mesh.points) footprint.push_back({dot(e1, p), dot(e2, p)});
    const Point2 along = smallest_rectangle(std::move(footprint)).along;
    const Vec3 x = normalized(along.x * e1 + along.y * e2);
    setup.piece_in_setup = {{x, cross(setup.up, x), setup.up}, {}};
    const Box turned = bounds_in(setup.piece_in_setup, mesh);
    const Vec3 middle = turned.centre();
    setup.piece_in_setup.shift = -Vec3{middle.x, middle.y, turned.min.z};
    setup.box = bounds_in(setup.piece_in_setup, mesh);
    assert(std::abs(setup.box.min.z) < 1e-6);
}

void describe(const BaseCandidate& chosen, Setup& setup) {
    if (!chosen.base) {
        setup.base_description = "no cap: the piece is bedded on the foam that is left under it";
        setup.warnings.push_back("the piece has no flat cap to lie on: keep it held from below");
        return;
    }
    setup.base_description = "the cap of cut " + std::to_string(*chosen.base);
    if (setup.base_is_stable) return;
    setup.warnings.push_back("the base is only " + percent(chosen.facing.base / chosen.projected_area_mm2) +
                             " of the piece's projected area: it may tip or break off");
}

}  // namespace

SetupChoice choose_setup(const Piece& piece, const Cell& cell, const SetupOptions&) {
    assert(piece.mesh && !piece.mesh->triangles.empty() && !cell.stock.empty());
    const RayTree rays(*piece.mesh);
    const std::vector<BaseCandidate> caps = caps_owned(piece);
    const BaseCandidate chosen = caps.empty() ? best_side(piece, rays) : best_cap(caps);

    Setup setup;
    setup.base = chosen.base;
    setup.up = chosen.up;
    setup.undercut = chosen.facing.undercut();
    setup.occluded_area_ratio = occluded_area_ratio(*piece.mesh, rays, chosen.up, chosen.base);
    setup.base_mm2 = chosen.facing.base;
    setup.projected_area_mm2 = chosen.projected_area_mm2;
    setup.base_is_stable = chosen.is_stable;
    describe(chosen, setup);
    place(*piece.mesh, setup);
    setup.spoil = margins_of(cell).spoil;
    setup.block = choose_block(cell, setup.box.size());
    return {{setup}, {}};
}

bool fits_cell(const Piece& piece, const Cell& cell) {
    return check_envelope(choose_setup(piece, cell).setups.front(), cell).fits();
}

}  // namespace qchopper
