// Independent passes over the triangles, in parallel: edges, shells, and sums with clusters. Memory per triangle 32
// bytes of sums, 12 of edges, and per cluster the sums of every half-space.

#include "segment/objectives/sweep/prepared.h"

#include <algorithm>
#include <cassert>
#include <limits>
#include <map>

#include "base/huge_pages.h"
#include "base/parallel.h"
#include "segment/mesh/normals.h"
#include "segment/mesh/oriented_box.h"

namespace qchopper {
namespace {

std::vector<std::uint16_t> bases(const Piece& piece) {
    std::vector<std::uint16_t> result;
    if (piece.mesh->cap_of.empty() || piece.half_spaces.empty()) return result;
    std::map<std::int32_t, std::uint16_t> index;
    for (std::size_t b = 0; b < piece.half_spaces.size(); ++b)
        index[piece.half_spaces[b].cut] = static_cast<std::uint16_t>(b);
    result.reserve(piece.mesh->cap_of.size());
    for (const std::int32_t cap : piece.mesh->cap_of) {
        const auto it = cap == no_cap ? index.end() : index.find(cap);
        result.push_back(it == index.end() ? no_base : it->second);
    }
    return result;
}

std::vector<TriangleSums> triangle_sums(const TriangleMesh& mesh, Vec3 origin) {
    auto sums = huge<TriangleSums>(mesh.triangles.size());
    for (std::size_t t = 0; t < sums.size(); ++t) {
        const Vec3 area = area_vector(mesh, t);
        sums[t] = {area, dot(mesh.points[mesh.triangles[t][0]] - origin, area) / 3};
    }
    return sums;
}

// A cap triangle has the normal of its plane: it may be too thin to have one of its own.
std::vector<Vec3> unit_normals(const PreparedPiece& p) {
    std::vector<Vec3> unit(p.sums.size());
    for (std::size_t t = 0; t < unit.size(); ++t) {
        const bool is_cap = !p.base.empty() && p.base[t] != no_base;
        unit[t] = is_cap ? -p.up[p.base[t]] : normalized(p.sums[t].area);
    }
    return unit;
}

// The sums of each cluster on the bases of earlier cuts: the same for every normal.
std::vector<BaseSums> base_sums(const PreparedPiece& p) {
    const std::size_t width = p.up.size();
    std::vector<BaseSums> sums(width * p.clusters.count());
    for (std::size_t i = 0; width > 0 && i < p.clusters.count(); ++i) {
        const std::span<BaseSums> row(sums.data() + i * width, width);
        for (std::uint32_t k = p.clusters.cluster[i].first_triangle; k < p.clusters.cluster[i + 1].first_triangle;
             ++k) {
            add_to_bases(row, p, k, 1, 1);
        }
    }
    return sums;
}

void add_boxes_of_clusters(PreparedPiece& p) {
    constexpr double none = std::numeric_limits<double>::infinity();
    p.sizes.of_cluster.assign(p.clusters.count(), {none, none, none, -none, -none, -none});
    for (std::size_t c = 0; c < p.clusters.count(); ++c) {
        const std::uint32_t end = p.clusters.cluster[c + 1].first_point;
        for (std::uint32_t i = p.clusters.cluster[c].first_point; i < end; ++i) {
            for (std::size_t k = 0; k < 3; ++k) {
                const double at = dot(p.sizes.axis[k], p.piece->mesh->points[p.clusters.point[i]]);
                p.sizes.of_cluster[c][k] = std::min(p.sizes.of_cluster[c][k], at);
                p.sizes.of_cluster[c][3 + k] = std::max(p.sizes.of_cluster[c][3 + k], at);
            }
        }
    }
}

// Each once per cap. O(triangles * half-spaces of the piece).
std::vector<CapPoint> cap_points(const Piece& piece) {
    std::vector<CapPoint> points;
    if (piece.mesh->cap_of.empty()) return points;
    for (const HalfSpace& half_space : piece.half_spaces) {
        std::vector<bool> is_listed(piece.mesh->points.size(), false);
        for (std::size_t t = 0; t < piece.mesh->triangles.size(); ++t) {
            if (cap_of(*piece.mesh, t) != half_space.cut) continue;
            for (const std::uint32_t v : piece.mesh->triangles[t]) {
                if (is_listed[v]) continue;
                is_listed[v] = true;
                points.push_back({v, -half_space.up()});
            }
        }
    }
    return points;
}

}  // namespace

void add_to_bases(std::span<BaseSums> sums, const PreparedPiece& prepared, std::uint32_t triangle, double share,
                  double faces) {
    assert(sums.size() == prepared.up.size());
    const Vec3 weighted_normal = prepared.weighted_normal(triangle);
    const double weight = prepared.unit.empty() ? share : faces;
    const std::uint16_t own = prepared.base.empty() ? no_base : prepared.base[triangle];
    for (std::size_t b = 0; b < sums.size(); ++b) {
        if (b == own) {
            sums[b].faces += faces;
            continue;
        }
        const double upwards = weight * dot(weighted_normal, prepared.up[b]);
        sums[b].up += upwards > 0 ? upwards : 0;
        sums[b].down += upwards < 0 ? -upwards : 0;
    }
}

PreparedPiece prepare(const Piece& piece, const Objectives& objectives, const std::array<Vec3, 3>* axes) {
    assert(piece.mesh && is_consistent(*piece.mesh) && piece.half_spaces.size() < no_base);
    const TriangleMesh& mesh = *piece.mesh;
    PreparedPiece p;
    p.piece = &piece;
    p.origin = mesh.points.empty() ? Vec3{} : mesh.points.front();
    p.base = bases(piece);
    for (const HalfSpace& half_space : piece.half_spaces) p.up.push_back(half_space.up());
    // Three independent passes.
    parallel_invoke({[&] { p.edges = edges(mesh); }, [&] { p.shells = shells(mesh); },
                     [&] {
                         p.sums = triangle_sums(mesh, p.origin);
                         if (!objectives.undercut_by_area) p.unit = unit_normals(p);
                         p.clusters = clusters(mesh, p.sums, p.unit);
                         p.base_sums = base_sums(p);
                     }});
    assert(p.base.empty() || p.base.size() == mesh.triangles.size());
    assert(p.sums.size() == mesh.triangles.size() && p.shells.shell_of.size() == mesh.triangles.size());
    if (objectives.fragility_form != FragilityForm::thinness) p.vertex_normals = vertex_normals(mesh);
    if (objectives.fragility_form == FragilityForm::binary) p.cap_points = cap_points(piece);
    if (objectives.needs_connector() && objectives.connector.form == ConnectorForm::spread)
        p.old_joints = old_joints(piece, objectives.connector);
    p.has_seam = objectives.needs_seam();
    if (objectives.needs_structure() && piece.stress) p.stressed = stressed_part(piece.stress, mesh);
    if (objectives.needs_sizes()) {
        p.sizes.axis = axes != nullptr ? *axes : oriented_box(mesh.points).axis;
        add_boxes_of_clusters(p);
    }
    return p;
}

}  // namespace qchopper
