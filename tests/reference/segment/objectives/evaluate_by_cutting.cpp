// Cuts, groups the triangles of each half by solid, and adds up each solid from the definitions. O(triangles * caps of
// a solid) besides the cut.

#include "tests/reference/segment/objectives/evaluate_by_cutting.h"

#include <algorithm>
#include <cassert>
#include <limits>
#include <map>

#include "segment/cut/cut.h"
#include "segment/cut/half_solids.h"
#include "segment/mesh/connectivity/edges.h"
#include "segment/mesh/measure.h"
#include "segment/mesh/oriented_box.h"
#include "segment/objectives/sweep/section_measures.h"
#include "tests/reference/segment/objectives/binary_fragility.h"
#include "tests/reference/segment/objectives/fragility.h"

namespace qchopper {
namespace {

// Unit normals of all triangles. A cap triangle has its plane's, a part of a triangle that of the whole one (`parent`,
// in the mesh `parents`): a sliver has none of its own. Zero for a triangle without area.
std::vector<Vec3> triangle_normals(const TriangleMesh& mesh, const std::vector<HalfSpace>& half_spaces,
                                   const std::vector<std::uint32_t>& parent, const TriangleMesh& parents) {
    std::vector<Vec3> normals(mesh.triangles.size());
    for (std::size_t t = 0; t < normals.size(); ++t) {
        const std::int32_t cap = cap_of(mesh, t);
        const auto half_space =
            std::find_if(half_spaces.begin(), half_spaces.end(), [&](const HalfSpace& h) { return h.cut == cap; });
        if (half_space != half_spaces.end())
            normals[t] = -half_space->up();
        else
            normals[t] = normalized(area_vector(parents, parent[t]));
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

double plain_fragility(const Piece& piece, const Plane& plane, double cap_area_mm2, const Objectives& objectives) {
    const double d = objectives.fragility_distance;
    switch (objectives.fragility_form) {
        case FragilityForm::thinness:
            return thinness(piece, plane, cap_area_mm2, d);
        case FragilityForm::thesis:
            return thesis_fragility(piece, plane, d);
        case FragilityForm::binary:
            break;
    }
    return binary_fragility(piece, plane, d);
}

// What a mm of seam costs at a point of the half that lies in the plane, on an edge of the cut triangle `parent`.
double cost_on_edge(const Piece& piece, const Plane& plane, Vec3 point, std::uint32_t parent) {
    const Triangle& corners = piece.mesh->triangles[parent];
    double nearest = std::numeric_limits<double>::infinity();
    double cost = 1;
    for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 a = piece.mesh->points[corners[k]];
        const Vec3 b = piece.mesh->points[corners[(k + 1) % 3]];
        const double from = height(plane.normal, a) - plane.offset;
        const double to = height(plane.normal, b) - plane.offset;
        if ((from > 0) == (to > 0)) continue;
        const double share = from / (from - to);
        const double off = norm(a + share * (b - a) - point);
        if (off >= nearest) continue;
        nearest = off;
        cost = (1 - share) * seam_cost(piece, corners[k]) + share * seam_cost(piece, corners[(k + 1) % 3]);
    }
    return cost;
}

// The outline of the new cap, along the triangles of the half that meet it.
double seam_of_cap(const Piece& piece, const Plane& plane, const Half& half) {
    const Edges pairs = edges(half.mesh);
    double sum = 0;
    for (std::uint32_t t = 0; t < half.mesh.triangles.size(); ++t) {
        if (cap_of(half.mesh, t) != new_cut) continue;
        for (std::uint32_t k = 0; k < 3; ++k) {
            const std::uint32_t beside = pairs.twin[3 * t + k] / 3;
            if (cap_of(half.mesh, beside) == new_cut) continue;
            const Vec3 a = half.mesh.points[half.mesh.triangles[t][k]];
            const Vec3 b = half.mesh.points[half.mesh.triangles[t][(k + 1) % 3]];
            const std::uint32_t parent = half.parent[beside];
            sum += seam_part(piece, parent, norm(b - a), cost_on_edge(piece, plane, a, parent),
                             cost_on_edge(piece, plane, b, parent));
        }
    }
    return sum;
}

// The extents of each solid along the axes.
void measure_sizes(std::vector<SolidEvaluation>& solids, const TriangleMesh& mesh, const HalfSolids& grouped,
                   const std::array<Vec3, 3>& axes) {
    const std::vector<std::uint32_t> solid_of = solid_of_triangle(grouped.shells, grouped.solids);
    std::vector<PartBox> boxes(solids.size());
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        for (const std::uint32_t v : mesh.triangles[t]) {
            for (std::size_t k = 0; k < 3; ++k) {
                const double at = dot(axes[k], mesh.points[v]);
                boxes[solid_of[t]].include(k, at, at);
            }
        }
    }
    for (std::size_t s = 0; s < solids.size(); ++s) solids[s].size = boxes[s].size();
}

std::vector<SolidEvaluation> measure_half(const Half& half, const HalfSolids& solids, const Piece& piece,
                                          const HalfSpace& half_space) {
    std::vector<HalfSpace> half_spaces = piece.half_spaces;
    half_spaces.push_back(half_space);
    const std::vector<std::uint32_t> solid_of = solid_of_triangle(solids.shells, solids.solids);
    const std::vector<Vec3> normals = triangle_normals(half.mesh, half_spaces, half.parent, *piece.mesh);
    std::vector<SolidEvaluation> evaluations =
        measure_solids(half.mesh, normals, solid_of, solids.solids.count, half_spaces);
    for (SolidEvaluation& evaluation : evaluations) evaluation.above = half_space.above;
    return evaluations;
}

}  // namespace

std::optional<CutEvaluation> evaluate_by_cutting(const Piece& piece, const Plane& plane, const Objectives& objectives,
                                                 const std::array<Vec3, 3>* box_axes) {
    const std::optional<CutHalves> halves = cut(*piece.mesh, plane, new_cut);
    if (!halves) return std::nullopt;
    CutEvaluation evaluation;
    evaluation.cap_area_mm2 = halves->cap_area_mm2;
    const SolidsOfHalves solids = solids_of_halves(*piece.mesh, plane, *halves);
    evaluation.solids = measure_half(halves->above, solids.above, piece, {new_cut, plane, true});
    std::vector<SolidEvaluation> below = measure_half(halves->below, solids.below, piece, {new_cut, plane, false});
    if (objectives.needs_sizes()) {
        const std::array<Vec3, 3> axes = box_axes != nullptr ? *box_axes : oriented_box(piece.mesh->points).axis;
        measure_sizes(evaluation.solids, halves->above.mesh, solids.above, axes);
        measure_sizes(below, halves->below.mesh, solids.below, axes);
    }
    evaluation.solids.insert(evaluation.solids.end(), below.begin(), below.end());
    if (evaluation.cap_area_mm2 > 0) {
        evaluation.fragility = plain_fragility(piece, plane, evaluation.cap_area_mm2, objectives);
    }
    if (objectives.needs_seam()) evaluation.seam_mm = seam_of_cap(piece, plane, halves->below);
    return evaluation;
}

}  // namespace qchopper
