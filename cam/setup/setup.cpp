#include "cam/setup/setup.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "cam/setup/footprint.h"
#include "cam/setup/undercut.h"
#include "segment/mesh/oriented_box.h"
#include "segment/mesh/rays.h"
#include "segment/mesh/transform.h"

namespace qchopper {
namespace {

constexpr double same = 1e-9;               // undercuts and shares that differ by less are a tie
constexpr double rounding = 1e-6;           // mm
constexpr double least_stable_share = 0.1;  // of the projected area

std::string percent(double share) {
    return std::to_string(std::lround(100 * share)) + " %";
}

struct Candidate {
    std::optional<std::int32_t> base;
    Vec3 up;
    Facing facing;
    double projected_area_mm2 = 0;
    bool is_stable = false;
};

std::vector<Candidate> caps_owned(const Piece& piece) {
    std::vector<Candidate> candidates;
    for (const Bound& bound : piece.bounds) {
        const Facing sums = facing(*piece.mesh, bound.up(), bound.cut);
        if (sums.base_triangles == 0) continue;
        Candidate candidate{bound.cut, bound.up(), sums, projected_area_mm2(*piece.mesh, bound.up()), false};
        candidate.is_stable = sums.base >= least_stable_share * candidate.projected_area_mm2;
        candidates.push_back(candidate);
    }
    return candidates;
}

// Ties within a tolerance are no order, so the best is found first and the lowest cut among its equals second.
Candidate best_cap(const std::vector<Candidate>& candidates) {
    assert(!candidates.empty());
    Candidate best = candidates.front();
    for (const Candidate& other : candidates) {
        const bool less = other.facing.undercut() < best.facing.undercut();
        if (other.is_stable != best.is_stable ? other.is_stable : less) best = other;
    }
    Candidate first = best;
    for (const Candidate& other : candidates) {
        const bool tie = other.is_stable == best.is_stable && other.facing.undercut() - best.facing.undercut() <= same;
        if (tie && *other.base < *first.base) first = other;
    }
    return first;
}

// Shortest side first: where nothing else decides, a piece lies flat.
Candidate best_side(const Piece& piece, const RayTree& rays) {
    const OrientedBox box = oriented_box(piece.mesh->points);
    Vec3 up = box.axis[2];
    double least = std::numeric_limits<double>::infinity();
    for (int axis = 2; axis >= 0; --axis) {
        for (const double sign : {1.0, -1.0}) {
            const Vec3 direction = sign * box.axis[axis];
            const double occluded = occluded_area_ratio(*piece.mesh, rays, direction, std::nullopt);
            if (occluded >= least - same) continue;
            least = occluded;
            up = direction;
        }
    }
    return {std::nullopt, up, facing(*piece.mesh, up, std::nullopt), projected_area_mm2(*piece.mesh, up), false};
}

// Turned so that the smallest rectangle of the footprint lies along x, then set down.
void place(const TriangleMesh& mesh, Setup& setup) {
    const auto [e1, e2] = frame_under(setup.up);
    std::vector<FootPoint> footprint;
    footprint.reserve(mesh.points.size());
    for (const Vec3& p : mesh.points) footprint.push_back({dot(e1, p), dot(e2, p)});
    const FootPoint along = smallest_rectangle(std::move(footprint)).along;
    const Vec3 x = normalized(along[0] * e1 + along[1] * e2);
    setup.piece_in_setup = {{x, cross(setup.up, x), setup.up}, {}};
    const Box turned = bounds(apply(setup.piece_in_setup, mesh));
    const Vec3 middle = turned.centre();
    setup.piece_in_setup.shift = -Vec3{middle.x, middle.y, turned.min.z};
    setup.box = bounds(apply(setup.piece_in_setup, mesh));
    assert(std::abs(setup.box.min.z) < 1e-6);  // set down
}

double shortfall(Vec3 needed, Vec3 block) {
    const Vec3 lack = needed - block;
    return std::max({lack.x, lack.y, lack.z});
}

// The smallest block that holds the piece with its margin; without one, the block that lacks least.
void choose_stock(const Cell& cell, Setup& setup) {
    const double margin = cell.stock_margin;
    const Vec3 needed = setup.box.size() + Vec3{2 * margin, 2 * margin, margin};
    double least_lack = std::numeric_limits<double>::infinity();
    double least_volume = least_lack;
    for (std::size_t i = 0; i < cell.stock.size(); ++i) {
        const Vec3 size = cell.stock[i].size;
        for (const bool turned : {false, true}) {
            const Vec3 block = turned ? Vec3{size.y, size.x, size.z} : size;
            const double lack = shortfall(needed, block);
            const double counted = lack <= rounding ? 0 : lack;  // all that hold are equal; then volume decides
            const double volume = size.x * size.y * size.z;
            if (counted > least_lack || (counted == least_lack && volume >= least_volume)) continue;
            least_lack = counted;
            least_volume = volume;
            setup.stock = i;
            setup.stock_turned = turned;
            setup.block = block;
        }
    }
    setup.stock_holds = least_lack == 0;
    assert(setup.stock < cell.stock.size());
}

void describe(const Candidate& chosen, Setup& setup) {
    if (!chosen.base) {
        setup.base_words = "no cap: the piece is bedded on the foam that is left under it";
        setup.warnings.push_back("the piece has no flat cap to lie on: keep it held from below");
        return;
    }
    setup.base_words = "the cap of cut " + std::to_string(*chosen.base);
    if (setup.base_is_stable) return;
    setup.warnings.push_back("the base is only " + percent(chosen.facing.base / chosen.projected_area_mm2) +
                             " of the piece's projected area: it may tip or break off");
}

}  // namespace

Setup choose_setup(const Piece& piece, const Cell& cell) {
    assert(piece.mesh && !piece.mesh->triangles.empty() && !cell.stock.empty());
    const RayTree rays(*piece.mesh);
    const std::vector<Candidate> caps = caps_owned(piece);
    const Candidate chosen = caps.empty() ? best_side(piece, rays) : best_cap(caps);

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
    choose_stock(cell, setup);
    return setup;
}

}  // namespace qchopper
