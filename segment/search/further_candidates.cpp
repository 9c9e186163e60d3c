// Each plane is nudged alone, O(points).

#include "segment/search/further_candidates.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "base/units.h"
#include "segment/cut/nudge.h"

namespace qchopper {
namespace {

constexpr int finer = 5;
constexpr double near_deg = 18;
constexpr double near_share = 0.05;  // of the diagonal

// Of a closed mesh: its tetrahedra with the first point, by their volumes.
Vec3 centroid_of_volume(const TriangleMesh& mesh) {
    const Vec3 origin = mesh.points.front();
    Vec3 sum;
    double volume = 0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const auto [a, b, c] = corners_of(mesh, t);
        const double six = dot(a - origin, cross(b - origin, c - origin));
        sum = sum + (six / 4) * ((a - origin) + (b - origin) + (c - origin));
        volume += six;
    }
    return origin + (1 / volume) * sum;
}

}  // namespace

std::vector<Candidate> further_candidates(const Segmentation& segmentation, std::size_t piece,
                                          const CandidateOptions& options) {
    assert(piece < segmentation.pieces.size());
    const Piece& target = segmentation.pieces[piece];
    std::vector<Candidate> found;
    if (!options.symmetry && options.given.empty()) return found;
    const std::vector<NoCutTriangle> no_cut = no_cut_triangles(*target.mesh, options.no_cut);
    const auto add = [&](const Plane& plane, int normal_index, int offset_index) {
        for (Candidate& c : candidates_at(target, plane.normal, normal_index, {plane.offset}, no_cut)) {
            c.offset_index = offset_index;
            found.push_back(c);
        }
    };
    if (options.symmetry) add(options.symmetry->plane, symmetry_index, 0);
    for (std::size_t i = 0; i < options.given.size(); ++i)
        add(options.given[i].plane, given_index, static_cast<int>(i));
    if (!options.symmetry) return found;
    for (const Cut& cut : segmentation.cuts) {
        add(reflected(cut.chosen.plane, options.symmetry->plane), mirror_index, cut.number);
    }
    return found;
}

std::vector<Candidate> offsets_around(const Piece& piece, const Ranked& plane, const CandidateOptions& options) {
    const Vec3 normal = plane.plane.normal;
    const double step = offset_step(extent(*piece.mesh, normal), options) / finer;
    std::vector<double> wanted;
    for (int k = 1 - finer; k < finer; ++k) {
        if (k != 0) wanted.push_back(plane.wanted_offset + k * step);
    }
    std::vector<Candidate> around =
        candidates_at(piece, normal, refined_index, wanted, no_cut_triangles(*piece.mesh, options.no_cut));
    return around;
}

std::vector<std::size_t> without_near_planes(const std::vector<Ranked>& ranked, const Piece& piece,
                                             const OrientedBox& box) {
    const Vec3 centre = centroid_of_volume(*piece.mesh);
    const double near_mm = near_share * norm(box.size());
    const double near_cos = std::cos(radians(near_deg));
    const auto over_centre = [&](const Plane& plane) { return plane.offset - height(plane.normal, centre); };
    std::vector<std::size_t> kept;
    for (std::size_t i = 0; i < ranked.size(); ++i) {
        const Plane& plane = ranked[i].plane;
        const bool is_near = std::any_of(kept.begin(), kept.end(), [&](std::size_t k) {
            const double cosine = dot(ranked[k].plane.normal, plane.normal);
            if (std::abs(cosine) < near_cos) return false;
            const double other = over_centre(ranked[k].plane);
            return std::abs(over_centre(plane) - (cosine > 0 ? other : -other)) < near_mm;
        });
        if (!is_near) kept.push_back(i);
    }
    return kept;
}

}  // namespace qchopper
