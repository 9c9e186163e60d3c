// CGAL's quickhull, after C. B. Barber, D. P. Dobkin and H. Huhdanpaa, "The quickhull algorithm for convex hulls"
// (1996), with exact predicates. Into a Surface_mesh, because CGAL 5.5 writes the hull into lists of points and
// triangles with inexact planes, and then crashes on points of which many lie nearly in a plane.

#include "segment/regions/engines/convex_hull.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/convex_hull_3.h>

#include <algorithm>
#include <cmath>

namespace qchopper {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

// Of the volume to the area^1.5; a ball has 0.094. What is flatter counts as points in a plane, of which CGAL gives the
// triangles of one side.
constexpr double flat = 1e-9;

Vec3 point_of(const Kernel::Point_3& p) {
    return {p.x(), p.y(), p.z()};
}

}  // namespace

ConvexHull convex_hull_of(const std::vector<Vec3>& points) {
    std::vector<Kernel::Point_3> given;
    given.reserve(points.size());
    for (const Vec3& p : points) given.emplace_back(p.x, p.y, p.z);
    std::sort(given.begin(), given.end());
    given.erase(std::unique(given.begin(), given.end()), given.end());
    CGAL::Surface_mesh<Kernel::Point_3> found;
    if (!given.empty()) CGAL::convex_hull_3(given.begin(), given.end(), found);
    ConvexHull hull;
    for (const auto v : found.vertices()) hull.points.push_back(point_of(found.point(v)));
    for (const auto f : found.faces()) {
        const auto first = found.halfedge(f);
        const Vec3 a = point_of(found.point(found.target(first)));
        const Vec3 b = point_of(found.point(found.target(found.next(first))));
        const Vec3 c = point_of(found.point(found.target(found.next(found.next(first)))));
        const Vec3 twice = cross(b - a, c - a);
        const double length = norm(twice);
        if (!(length > 0)) continue;
        const Vec3 normal = (1 / length) * twice;
        hull.sides.push_back({normal, dot(normal, a)});
        hull.area += length / 2;
        hull.volume += dot(twice, a - hull.points.front()) / 6;
    }
    if (!(hull.volume > flat * std::pow(hull.area, 1.5))) return {hull.points, {}, 0, 0};
    return hull;
}

}  // namespace qchopper
