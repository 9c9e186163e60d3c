// From the definition; the rays are one batch.

#include "tests/reference/segment/objectives/binary_fragility.h"

#include <cmath>
#include <cstdint>
#include <vector>

#include "segment/mesh/normals.h"
#include "segment/objectives/thin_part.h"
#include "segment/raster/parallel_rays.h"

namespace qchopper {
namespace {

// Per point how often the edges around it change between upwards and downwards.
std::vector<std::uint32_t> turns(const TriangleMesh& mesh, Vec3 normal) {
    std::vector<std::uint32_t> count(mesh.points.size());
    const auto is_above = [&](std::uint32_t a, std::uint32_t b) {
        return height(normal, mesh.points[a]) >= height(normal, mesh.points[b]);
    };
    for (const Triangle& t : mesh.triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
            if (is_above(t[(k + 1) % 3], t[k]) != is_above(t[(k + 2) % 3], t[k])) ++count[t[k]];
        }
    }
    return count;
}

}  // namespace

double binary_fragility(const Piece& piece, const Plane& plane, double distance) {
    const TriangleMesh& mesh = *piece.mesh;
    const std::vector<std::uint32_t> around = turns(mesh, plane.normal);
    std::vector<RayQuery> rays;
    std::vector<double> off;
    // `outward`: the normal of the vertex, or that of a cap that it belongs to.
    const auto ask = [&](std::uint32_t point, Vec3 outward) {
        const double along = dot(outward, plane.normal);
        const double h = height(plane.normal, mesh.points[point]);
        const bool above = along > 0;
        const bool is_slope = around[point] == 2;
        if (std::abs(along) < nearly_parallel && (along == 0 || is_slope)) return;
        if (above != (h >= plane.offset) || std::abs(h - plane.offset) > distance) return;
        off.push_back(std::abs(h - plane.offset));
        rays.push_back({mesh.points[point], !above, distance});
    };
    for (const HalfSpace& half_space : piece.half_spaces) {
        for (std::size_t t = 0; t < mesh.triangles.size() && !mesh.cap_of.empty(); ++t) {
            if (cap_of(mesh, t) != half_space.cut) continue;
            for (const std::uint32_t v : mesh.triangles[t]) ask(v, -half_space.up());
        }
    }
    const std::vector<Vec3> normals = vertex_normals(mesh);
    for (std::uint32_t v = 0; v < normals.size(); ++v) ask(v, normals[v]);
    const std::vector<double> free_lengths = ray_distances(mesh, plane.normal, rays);
    for (std::size_t i = 0; i < off.size(); ++i) {
        if (free_lengths[i] >= off[i]) return 1;
    }
    return 0;
}

}  // namespace qchopper
