// A cluster all of whose points are of one component is added by its box; of the others each point. Outlines are added
// up crossing by crossing, each with the one before it on its loop.

#include "segment/objectives/sweep/section_measures.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace qchopper {
namespace {

void add_cluster(const PreparedPiece& p, std::size_t c, Slabs& slabs) {
    const std::uint32_t first = p.clusters.cluster[c].first_point;
    const std::span<const std::uint32_t> points(p.clusters.point.data() + first,
                                                p.clusters.cluster[c + 1].first_point - first);
    const std::uint32_t component = slabs.component_of[points.front()];
    const bool is_one =
        std::all_of(points.begin(), points.end(), [&](std::uint32_t v) { return slabs.component_of[v] == component; });
    if (is_one) {
        const std::array<double, 6>& box = p.sizes.of_cluster[c];
        for (std::size_t k = 0; k < 3; ++k) slabs.inside.box(component).include(k, box[k], box[3 + k]);
        return;
    }
    for (const std::uint32_t v : points) {
        PartBox& box = slabs.inside.box(slabs.component_of[v]);
        for (std::size_t k = 0; k < 3; ++k) {
            const double at = dot(p.sizes.axis[k], p.piece->mesh->points[v]);
            box.include(k, at, at);
        }
    }
}

}  // namespace

void add_boxes(const PreparedPiece& prepared, Vec3 normal, std::span<const double> offsets, Slabs& slabs,
               Section& section) {
    slabs.inside.add_boxes();
    for (std::size_t c = 0; c < prepared.clusters.count(); ++c) add_cluster(prepared, c, slabs);
    const PlaneFrame frame = frame_across(normal);
    std::array<double, 3> u{};
    std::array<double, 3> v{};
    for (std::size_t k = 0; k < 3; ++k) {
        u[k] = dot(prepared.sizes.axis[k], frame.u);
        v[k] = dot(prepared.sizes.axis[k], frame.v);
    }
    section.above.add_boxes();
    section.below.add_boxes();
    for (std::size_t l = 0; l < section.loops.size(); ++l) {
        const SectionLoop& loop = section.loops[l];
        const Vec3 origin = prepared.origin + (offsets[loop.plane] - height(normal, prepared.origin)) * normal;
        std::array<double, 3> at{};
        for (std::size_t k = 0; k < 3; ++k) at[k] = dot(prepared.sizes.axis[k], origin);
        PartBox box;
        for (const Point2 p : section.points(loop)) {
            for (std::size_t k = 0; k < 3; ++k) {
                const double along = at[k] + u[k] * p.x + v[k] * p.y;
                box.include(k, along, along);
            }
        }
        section.above.box(l) = box;
        section.below.box(l) = box;
    }
}

void add_seams(const Piece& piece, const Slabs& slabs, const Section& section, std::span<const double> offsets,
               std::span<std::optional<CutEvaluation>> evaluations) {
    for (std::optional<CutEvaluation>& evaluation : evaluations) {
        if (evaluation) evaluation->seam_mm = 0;
    }
    const TriangleMesh& mesh = *piece.mesh;
    std::vector<double> cost(slabs.exit.size(), 1.0);  // per crossing, where it leaves its triangle
    std::uint32_t i = 0;
    for (const CrossedTriangle& s : slabs.crossed) {
        for (std::size_t plane = s.low; plane < s.high && piece.seam_cost; ++plane, ++i) {
            const std::uint32_t from = slabs.exit[i] % 3;
            const std::uint32_t to = (from + 1) % 3;
            const double share = (s.height[from] - offsets[plane]) / (s.height[from] - s.height[to]);
            const double upper = seam_cost(piece, mesh.triangles[s.triangle][from]);
            cost[i] = upper + share * (seam_cost(piece, mesh.triangles[s.triangle][to]) - upper);
        }
    }
    for (const SectionLoop& loop : section.loops) {
        if (!evaluations[loop.plane] || loop.points <= 2) continue;  // a cut makes no cap there
        const std::span<const std::uint32_t> crossing = section.crossings(loop);
        const std::span<const Point2> point = section.points(loop);
        double sum = 0;
        for (std::size_t n = 0; n < crossing.size(); ++n) {
            const std::size_t next = n + 1 < crossing.size() ? n + 1 : 0;
            const double length = std::hypot(point[next].x - point[n].x, point[next].y - point[n].y);
            sum += seam_part(piece, slabs.exit[crossing[next]] / 3, length, cost[crossing[n]], cost[crossing[next]]);
        }
        evaluations[loop.plane]->seam_mm += sum;
    }
}

}  // namespace qchopper
