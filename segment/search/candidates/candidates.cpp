// The normals in parallel, each O(points) besides the oriented box.

#include "segment/search/candidates/candidates.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "base/parallel.h"
#include "base/units.h"
#include "segment/access/tool_directions.h"
#include "segment/cut/nudge.h"

namespace qchopper {
namespace {

bool is_same_direction(Vec3 a, Vec3 b) {
    return norm(cross(a, b)) < std::sin(radians(min_turn_deg));
}

}  // namespace

std::vector<Vec3> candidate_normals(const OrientedBox& box, CandidateNormals normals) {
    std::vector<Vec3> result;
    for (const Vec3& axis : box.axis) result.push_back(canonical({axis, 0}).normal);
    if (normals == CandidateNormals::box) return result;
    for (const Vec3& normal : octahedron_normals()) {
        const Vec3 n = canonical({normal, 0}).normal;
        // The octahedron's own are more than ten degrees apart.
        const bool is_axis =
            std::any_of(result.begin(), result.begin() + 3, [&](Vec3 axis) { return is_same_direction(axis, n); });
        if (!is_axis) result.push_back(n);
    }
    return result;
}

double offset_step(const Extent& range, const CandidateOptions& options) {
    if (options.offset_step_mm) return std::max(*options.offset_step_mm, range.size() / max_steps);
    return range.size() / (options.offsets_per_normal + 1);
}

std::vector<double> candidate_offsets(const Extent& range, const CandidateOptions& options) {
    std::vector<double> offsets;
    if (options.offset_step_mm) {
        const double step = offset_step(range, options);
        for (int k = 1; k < max_steps && range.low + k * step < range.high; ++k) {
            offsets.push_back(range.low + k * step);
        }
        return offsets;
    }
    const int count = options.offsets_per_normal;
    for (int k = 1; k <= count; ++k) offsets.push_back(range.low + range.size() * k / (count + 1));
    return offsets;
}

std::vector<double> offset_shares(double size, const CandidateOptions& options) {
    if (options.offset_step_mm) {
        std::vector<double> shares = candidate_offsets({0, size}, options);
        for (double& share : shares) share /= size;
        return shares;
    }
    return candidate_offsets({0, 1}, options);
}

std::vector<Candidate> candidates_at(const Piece& piece, Vec3 normal, int normal_index,
                                     const std::vector<double>& wanted, std::span<const NoCutTriangle> no_cut) {
    const Vec3 n = canonical({normal, 0}).normal;
    const std::vector<std::optional<Nudged>> nudged = nudge(piece, n, wanted);
    assert(nudged.size() == wanted.size());
    const std::vector<Extent> forbidden = forbidden_heights(no_cut, n);
    std::vector<Candidate> candidates;
    for (std::size_t k = 0; k < wanted.size(); ++k) {
        if (!nudged[k] || is_forbidden(forbidden, nudged[k]->offset)) continue;
        candidates.push_back({{n, nudged[k]->offset}, wanted[k], normal_index, static_cast<int>(k)});
    }
    return candidates;
}

std::vector<Candidate> candidates_along(const Piece& piece, Vec3 normal, int normal_index,
                                        const CandidateOptions& options) {
    const Vec3 n = canonical({normal, 0}).normal;
    return candidates_at(piece, n, normal_index, candidate_offsets(extent(*piece.mesh, n), options),
                         no_cut_triangles(*piece.mesh, options.no_cut));
}

std::vector<Candidate> candidates_along(const Piece& piece, Vec3 normal, int normal_index, int count) {
    CandidateOptions options;
    options.offsets_per_normal = count;
    return candidates_along(piece, normal, normal_index, options);
}

std::vector<Candidate> candidate_planes(const Piece& piece, const CandidateOptions& options) {
    return candidate_planes(piece, oriented_box(piece.mesh->points), options);
}

std::vector<Candidate> candidate_planes(const Piece& piece, const OrientedBox& box, const CandidateOptions& options) {
    const std::vector<Vec3> normals = candidate_normals(box, options.normals.value_or(CandidateNormals::box));
    const std::vector<NoCutTriangle> no_cut = no_cut_triangles(*piece.mesh, options.no_cut);
    std::vector<std::vector<Candidate>> along(normals.size());
    parallel_for(0, normals.size(), [&](std::size_t n) {
        const std::vector<double> wanted = candidate_offsets(extent(*piece.mesh, normals[n]), options);
        along[n] = candidates_at(piece, normals[n], static_cast<int>(n), wanted, no_cut);
    });
    std::vector<Candidate> all;
    for (const std::vector<Candidate>& some : along) all.insert(all.end(), some.begin(), some.end());
    return all;
}

}  // namespace qchopper
