// Cuts, groups the triangles of each half by solid, and adds up each solid from the definitions. O(triangles * caps of
// a solid) besides the cut.

#include "segment/score/reference.h"

#include <algorithm>
#include <cassert>
#include <map>

#include "segment/cut/cut.h"
#include "segment/cut/half_solids.h"
#include "segment/mesh/measure.h"
#include "segment/score/fragility.h"

namespace qchopper {
namespace {

// Unit normals of all triangles. A cap triangle has its plane's, a part of a triangle that of the whole one (`parent`,
// in the mesh `parents`): a sliver has none of its own. Zero for a triangle without area.
std::vector<Vec3> triangle_normals(const TriangleMesh& mesh, const std::vector<HalfSpace>& half_spaces,
                                   const std::vector<std::uint32_t>* parent, const TriangleMesh* parents) {
    std::vector<Vec3> normals(mesh.triangles.size());
    for (std::size_t t = 0; t < normals.size(); ++t) {
        const std::int32_t cap = cap_of(mesh, t);
        const auto half_space =
            std::find_if(half_spaces.begin(), half_spaces.end(), [&](const HalfSpace& h) { return h.cut == cap; });
        if (half_space != half_spaces.end())
            normals[t] = -half_space->up();
        else
            normals[t] = normalized(parent != nullptr ? area_vector(*parents, (*parent)[t]) : area_vector(mesh, t));
    }
    return normals;
}

// Adds up the solids of one mesh, given as a solid number per triangle.
std::vector<SolidEvaluation> measure_solids(const TriangleMesh& mesh, const std::vector<Vec3>& normals,
                                            const std::vector<std::uint32_t>& solid_of, std::size_t count,
                                            const std::vector<HalfSpace>& half_spaces) {
    assert(normals.size() == mesh.triangles.size() && solid_of.size() == mesh.triangles.size());
    std::vector<SolidEvaluation> solids(count);
    std::vector<std::map<std::int32_t, BaseShare>> bases(count);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {  // the caps that each solid owns
        const std::int32_t cap = cap_of(mesh, t);
        if (cap != no_cap) bases[solid_of[t]][cap].cut = cap;
    }
    const Vec3 origin = mesh.points.empty() ? Vec3{} : mesh.points.front();
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        SolidEvaluation& solid = solids[solid_of[t]];
        const Triangle& v = mesh.triangles[t];
        ++solid.faces;
        solid.volume_mm3 +=
            dot(mesh.points[v[0]] - origin, cross(mesh.points[v[1]] - origin, mesh.points[v[2]] - origin)) / 6;
        const Vec3 area = area_vector(mesh, t);
        for (auto& [cut_number, share] : bases[solid_of[t]]) {
            if (cap_of(mesh, t) == cut_number) continue;
            const auto half_space = std::find_if(half_spaces.begin(), half_spaces.end(),
                                                 [&, n = cut_number](const HalfSpace& h) { return h.cut == n; });
            assert(half_space != half_spaces.end());
            const Vec3 up = half_space->up();
            const double by_area = dot(area, up);
            const double by_count = dot(normals[t], up);
            share.all_mm2 += std::abs(by_area);
            share.all_count += std::abs(by_count);
            if (by_area < 0) share.down_mm2 -= by_area;
            if (by_count < 0) share.down_count -= by_count;
        }
    }
    for (std::size_t s = 0; s < count; ++s) {
        for (const auto& [cut_number, share] : bases[s]) solids[s].bases.push_back(share);
    }
    return solids;
}

std::vector<SolidEvaluation> measure_half(const Half& half, const HalfSolids& solids, const Piece& piece,
                                          const HalfSpace& half_space) {
    std::vector<HalfSpace> half_spaces = piece.half_spaces;
    half_spaces.push_back(half_space);
    const std::vector<std::uint32_t> solid_of = solid_of_triangle(solids.shells, solids.solids);
    const std::vector<Vec3> normals = triangle_normals(half.mesh, half_spaces, &half.parent, piece.mesh.get());
    std::vector<SolidEvaluation> evaluations =
        measure_solids(half.mesh, normals, solid_of, solids.solids.count, half_spaces);
    for (SolidEvaluation& evaluation : evaluations) evaluation.above = half_space.above;
    return evaluations;
}

}  // namespace

std::optional<CutEvaluation> evaluate_by_cutting(const Piece& piece, const Plane& plane, const Objectives& objectives) {
    const std::optional<CutHalves> halves = cut(*piece.mesh, plane, new_cut);
    if (!halves) return std::nullopt;
    CutEvaluation evaluation;
    evaluation.cap_area_mm2 = halves->cap_area_mm2;
    const SolidsOfHalves solids = solids_of_halves(*piece.mesh, plane, *halves);
    evaluation.solids = measure_half(halves->above, solids.above, piece, {new_cut, plane, true});
    const std::vector<SolidEvaluation> below =
        measure_half(halves->below, solids.below, piece, {new_cut, plane, false});
    evaluation.solids.insert(evaluation.solids.end(), below.begin(), below.end());
    if (evaluation.cap_area_mm2 > 0) {
        evaluation.fragility = objectives.fragility_form == FragilityForm::thinness
                                   ? thinness(piece, plane, evaluation.cap_area_mm2, objectives.fragility_distance)
                                   : thesis_fragility(piece, plane, objectives.fragility_distance);
    }
    return evaluation;
}

SolidEvaluation measure(const Piece& piece) {
    const std::vector<Vec3> normals = triangle_normals(*piece.mesh, piece.half_spaces, nullptr, nullptr);
    const std::vector<std::uint32_t> solid_of(piece.mesh->triangles.size(), 0);
    return measure_solids(*piece.mesh, normals, solid_of, 1, piece.half_spaces).front();
}

}  // namespace qchopper
