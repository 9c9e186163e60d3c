// The minimum-weight triangulation of P. Liepa, "Filling holes in meshes" (2003), as in CGAL. It searches among the
// faces of the Delaunay tetrahedra first; where these do not close a loop of n <= 200 points, among all triangles in
// O(n^3).

#include "segment/repair/holes/fill_loop.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>
#include <CGAL/utility.h>

#include <algorithm>
#include <iterator>

namespace qchopper {

std::vector<Triangle> fill_loop(const std::vector<Vec3>& loop, const std::vector<Vec3>& beyond) {
    using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
    // Beyond this many edges only triangles of the Delaunay tetrahedra are tried: the search over all grows with n^3.
    constexpr std::size_t max_edges_for_full_search = 200;
    std::vector<Kernel::Point_3> points;
    std::vector<Kernel::Point_3> thirds;
    points.reserve(loop.size());
    thirds.reserve(beyond.size());
    for (const Vec3& p : loop) points.emplace_back(p.x, p.y, p.z);
    for (const Vec3& p : beyond) thirds.emplace_back(p.x, p.y, p.z);
    std::vector<CGAL::Triple<int, int, int>> found;
    CGAL::Polygon_mesh_processing::triangulate_hole_polyline(
        points, thirds, std::back_inserter(found),
        CGAL::parameters::do_not_use_cubic_algorithm(loop.size() > max_edges_for_full_search));
    std::vector<Triangle> triangles;
    for (const auto& [a, b, c] : found) {
        Triangle t{static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b), static_cast<std::uint32_t>(c)};
        std::sort(t.begin(), t.end());  // ascending positions run along the loop
        triangles.push_back(t);
    }
    return triangles;
}

}  // namespace qchopper
