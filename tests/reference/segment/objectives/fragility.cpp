// One pass over the faces or vertices. For thinness one ray per face that counts, all of one direction
// (parallel_rays.h): O(triangles) and the rays; 48 bytes per face that counts.

#include "tests/reference/segment/objectives/fragility.h"

#include <cassert>
#include <cmath>

#include "segment/mesh/normals.h"
#include "segment/objectives/thin_part.h"
#include "segment/raster/parallel_rays.h"

namespace qchopper {

double thinness(const Piece& piece, const Plane& plane, double cap_area_mm2, double distance) {
    assert(cap_area_mm2 > 0 && distance >= 0);
    const TriangleMesh& mesh = *piece.mesh;
    std::vector<RayQuery> queries;
    std::vector<double> weight;  // per query, what it adds if its ray reaches the plane
    std::vector<double> off;     // per query, the distance from the plane
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const double along = dot(normalized(area_vector(mesh, t)), plane.normal);
        if (std::abs(along) < nearly_parallel) continue;
        const bool above = along > 0;  // only the part on this side faces away from the plane
        const ThinPart part = thin_part(mesh, t, plane, above);
        if (part.corners == 0) continue;
        const Centroid c = centroid(part);
        const double distance_to_plane = std::abs(height(plane.normal, c.at) - plane.offset);
        if (c.area == 0 || distance_to_plane >= distance) continue;
        queries.push_back({c.at, !above, distance_to_plane});
        weight.push_back(c.area * (1 - distance_to_plane / distance) * std::abs(along));
        off.push_back(distance_to_plane);
    }
    const std::vector<double> free_lengths = ray_distances(mesh, plane.normal, queries);
    double sum = 0;
    for (std::size_t q = 0; q < queries.size(); ++q) {
        if (free_lengths[q] >= off[q]) sum += weight[q];
    }
    return sum / cap_area_mm2;
}

double thesis_fragility(const Piece& piece, const Plane& plane, double distance) {
    const TriangleMesh& mesh = *piece.mesh;
    const std::vector<Vec3> normals = vertex_normals(mesh);
    double sum = 0;
    for (std::size_t v = 0; v < mesh.points.size(); ++v) {
        const double along = std::abs(dot(normals[v], plane.normal));
        const double off = std::abs(height(plane.normal, mesh.points[v]) - plane.offset);
        if (along >= nearly_parallel && off <= distance) sum += off * along;
    }
    return sum;
}

}  // namespace qchopper
