// Candidates are grouped by normal; each group is one sweep, and the groups run in parallel. The cost is that of the
// sweeps (sweep.h) and of preparing the piece once (prepared.h).

#include "segment/search/candidates/evaluate.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <mutex>
#include <set>

#include "base/parallel.h"
#include "segment/mesh/measure.h"
#include "segment/objectives/sweep/sweep.h"

namespace qchopper {
namespace {

// The caps that the piece owns, ascending.
std::vector<BaseShare> bases_of(const TriangleMesh& mesh) {
    std::set<std::int32_t> cuts;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        if (cap_of(mesh, t) != no_cap) cuts.insert(cap_of(mesh, t));
    }
    std::vector<BaseShare> bases(cuts.size());
    std::transform(cuts.begin(), cuts.end(), bases.begin(), [](std::int32_t cut) { return BaseShare{.cut = cut}; });
    return bases;
}

// The half-space that a cut has left; nullptr: none.
const HalfSpace* half_space_of(const Piece& piece, std::int32_t cut) {
    const auto found = std::find_if(piece.half_spaces.begin(), piece.half_spaces.end(),
                                    [&](const HalfSpace& h) { return h.cut == cut; });
    return found == piece.half_spaces.end() ? nullptr : &*found;
}

}  // namespace

std::vector<CandidateGroup> groups_of(std::span<const Candidate> candidates) {
    std::vector<CandidateGroup> groups;
    for (std::size_t i = 0; i < candidates.size(); ++i) {
        const bool continues = i > 0 && candidates[i].plane.normal == candidates[i - 1].plane.normal &&
                               candidates[i].plane.offset > candidates[i - 1].plane.offset;
        if (!continues) groups.push_back({i, i});
        groups.back().last = i + 1;
    }
    return groups;
}

std::vector<std::optional<CutEvaluation>> evaluate_all(const Piece& piece, std::span<const Candidate> candidates,
                                                       const Objectives& objectives, const Context& context,
                                                       const std::array<Vec3, 3>* box_axes) {
    std::vector<std::optional<CutEvaluation>> evaluations(candidates.size());
    context.check_cancelled();
    const PreparedPiece prepared = prepare(piece, objectives, box_axes);
    std::mutex reporting;
    std::size_t done = 0;
    const std::vector<CandidateGroup> groups = groups_of(candidates);
    parallel_for(0, groups.size(), [&](std::size_t g) {
        context.check_cancelled();
        const auto [first, last] = groups[g];
        std::vector<double> offsets;
        for (std::size_t i = first; i < last; ++i) offsets.push_back(candidates[i].plane.offset);
        auto swept = sweep(prepared, candidates[first].plane.normal, offsets, objectives);
        assert(swept.size() == last - first);
        std::move(swept.begin(), swept.end(), evaluations.begin() + static_cast<std::ptrdiff_t>(first));
        const std::lock_guard lock(reporting);
        context.progress("planes evaluated", done += last - first, candidates.size());
    });
    return evaluations;
}

SolidEvaluation measure(const Piece& piece) {
    const TriangleMesh& mesh = *piece.mesh;
    SolidEvaluation solid;
    solid.faces = mesh.triangles.size();
    solid.bases = bases_of(mesh);
    const Vec3 origin = mesh.points.empty() ? Vec3{} : mesh.points.front();
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const Triangle& v = mesh.triangles[t];
        solid.volume_mm3 +=
            dot(mesh.points[v[0]] - origin, cross(mesh.points[v[1]] - origin, mesh.points[v[2]] - origin)) / 6;
        const std::int32_t cap = cap_of(mesh, t);
        const HalfSpace* own = half_space_of(piece, cap);
        const Vec3 area = area_vector(mesh, t);
        const Vec3 normal = own != nullptr ? -own->up() : normalized(area);
        for (BaseShare& share : solid.bases) {
            if (cap == share.cut) continue;
            const HalfSpace* base = half_space_of(piece, share.cut);
            assert(base != nullptr);
            const double by_area = dot(area, base->up());
            const double by_count = dot(normal, base->up());
            share.all_mm2 += std::abs(by_area);
            share.all_count += std::abs(by_count);
            if (by_area < 0) share.down_mm2 -= by_area;
            if (by_count < 0) share.down_count -= by_count;
        }
    }
    return solid;
}

}  // namespace qchopper
