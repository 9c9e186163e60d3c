// One nearest-point query per triangle in a bounding-volume tree of the other mesh.

#include "segment/import/map_painted.h"

#include <algorithm>
#include <cassert>
#include <cstddef>

#include "base/parallel.h"
#include "segment/mesh/measure.h"
#include "segment/mesh/triangle_tree.h"

namespace qchopper {
namespace {

constexpr std::size_t triangles_at_once = 1024;
constexpr std::size_t points_at_once = 1024;
constexpr double on_the_surface = 1e-9;  // of the diagonal: a nearer triangle is not looked for

Vec3 centroid(const TriangleMesh& mesh, std::size_t triangle) {
    const auto p = corners_of(mesh, triangle);
    return (1.0 / 3) * (p[0] + p[1] + p[2]);
}

// Calls use(triangle) for the triangles of a mesh, in parallel.
template <class Use>
void for_each_triangle(const TriangleMesh& mesh, const Use& use) {
    parallel_ranges(0, mesh.triangles.size(), triangles_at_once, [&](std::size_t first, std::size_t end) {
        for (std::size_t t = first; t < end; ++t) use(t);
    });
}

}  // namespace

std::vector<std::uint8_t> mapped_marks(const TriangleMesh& painted, const TriangleMesh& scan) {
    assert(!painted.triangles.empty() && painted.ignored.size() == painted.triangles.size());
    std::vector<std::uint8_t> marks(scan.triangles.size());
    if (marks.empty()) return marks;
    const TriangleTree tree(painted);
    const double enough = on_the_surface * norm(bounds(scan).size());
    for_each_triangle(scan, [&](std::size_t t) {
        marks[t] = painted.ignored[tree.nearest(painted, centroid(scan, t), enough).triangle];
    });
    return marks;
}

std::vector<Vec3> mapped_points(const TriangleMesh& painted, const std::vector<std::uint8_t>& is_marked,
                                const TriangleMesh& scan) {
    assert(!painted.triangles.empty() && is_marked.size() == painted.points.size());
    const TriangleTree tree(painted);
    std::vector<std::uint8_t> marks(scan.points.size());
    parallel_ranges(0, marks.size(), points_at_once, [&](std::size_t first, std::size_t end) {
        for (std::size_t v = first; v < end; ++v) {
            const Vec3 p = scan.points[v];
            const Triangle& corners = painted.triangles[tree.nearest(painted, p).triangle];
            const std::uint32_t nearest =
                *std::min_element(corners.begin(), corners.end(), [&](std::uint32_t a, std::uint32_t b) {
                    return norm(painted.points[a] - p) < norm(painted.points[b] - p);
                });
            marks[v] = is_marked[nearest];
        }
    });
    std::vector<Vec3> points;
    for (std::size_t v = 0; v < marks.size(); ++v) {
        if (marks[v] != 0) points.push_back(scan.points[v]);
    }
    return points;
}

double share_off_scan(const TriangleMesh& painted, const TriangleMesh& scan, double distance) {
    const TriangleTree tree(scan);
    std::vector<std::uint8_t> is_off(painted.triangles.size());
    for_each_triangle(
        painted, [&](std::size_t t) { is_off[t] = tree.is_any_nearer(scan, centroid(painted, t), distance) ? 0 : 1; });
    double off = 0;
    double all = 0;
    for (std::size_t t = 0; t < is_off.size(); ++t) {
        const double area = norm(area_vector(painted, t));
        all += area;
        if (is_off[t] != 0) off += area;
    }
    return all > 0 ? off / all : 0;
}

}  // namespace qchopper
