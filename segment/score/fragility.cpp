#include "segment/score/fragility.h"

#include <array>
#include <cmath>
#include <limits>

#include "segment/mesh/normals.h"

namespace qchopper {
namespace {

constexpr double nearly_parallel = 0.9;

// A face, or its part on one side of the plane: a convex polygon of three or four corners.
struct Part {
    std::array<Vec3, 4> corner;
    int corners = 0;
    void add(Vec3 p) { corner[static_cast<std::size_t>(corners++)] = p; }
};

Part part_of(const TriangleMesh& mesh, std::size_t triangle, const Plane& plane, bool above) {
    Part part;
    const Triangle& v = mesh.triangles[triangle];
    for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 a = mesh.points[v[k]];
        const Vec3 b = mesh.points[v[(k + 1) % 3]];
        const double ha = height(plane.normal, a);
        const double hb = height(plane.normal, b);
        if ((ha >= plane.offset) == above) part.add(a);
        if ((ha >= plane.offset) != (hb >= plane.offset)) part.add(a + ((plane.offset - ha) / (hb - ha)) * (b - a));
    }
    return part;
}

struct Centroid {
    Vec3 at;
    double area = 0;
};

Centroid centroid(const Part& part) {
    Centroid c;
    const Vec3 a = part.corner[0];
    for (std::size_t k = 2; k < static_cast<std::size_t>(part.corners); ++k) {
        const Vec3 b = part.corner[k - 1];
        const Vec3 d = part.corner[k];
        const double area = 0.5 * norm(cross(b - a, d - a));
        c.area += area;
        c.at = c.at + (area / 3) * (a + b + d);
    }
    if (c.area > 0) c.at = (1 / c.area) * c.at;
    return c;
}

// How far a ray can go inside the piece before it leaves it: through the scan's surface or through a cut.
double free_way(const Piece& piece, const RayTree& scan_rays, Vec3 from, Vec3 direction) {
    const auto hit = scan_rays.first_exit(from, direction);
    double way = hit ? hit->distance : std::numeric_limits<double>::infinity();
    for (const Bound& bound : piece.bounds) {
        const double towards = dot(bound.up(), direction);
        if (towards >= 0) continue;
        const double above_bound = (height(bound.plane.normal, from) - bound.plane.offset) * (bound.above ? 1 : -1);
        way = std::min(way, above_bound / -towards);
    }
    return way;
}

}  // namespace

double thinness(const Piece& piece, const Plane& plane, double cap_area_mm2, double distance,
                const RayTree& scan_rays) {
    const TriangleMesh& mesh = *piece.mesh;
    double sum = 0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const double along = dot(normalized(area_vector(mesh, t)), plane.normal);
        if (std::abs(along) < nearly_parallel) continue;
        const bool above = along > 0;  // only this side's part looks away from the plane
        const Part part = part_of(mesh, t, plane, above);
        if (part.corners == 0) continue;
        const Centroid c = centroid(part);
        const double off = std::abs(height(plane.normal, c.at) - plane.offset);
        if (c.area == 0 || off >= distance) continue;
        const Vec3 towards = above ? -plane.normal : plane.normal;
        if (free_way(piece, scan_rays, c.at, towards) < off) continue;
        sum += c.area * (1 - off / distance) * std::abs(along);
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
