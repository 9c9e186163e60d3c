// P. Liepa, "Filling holes in meshes" (2003), as in CGAL: triangulate, refine to the density of the border, fair.
// Fairing reads two rings of the surface, so CGAL gets only a strip around the loop. O(points + triangles) of the mesh
// to find the strip; the triangulation costs what it costs in fill_holes.cpp, fairing solves a sparse linear system.

#include "segment/repair/holes/fair_hole.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>
#include <CGAL/Surface_mesh.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "segment/mesh/connectivity/manifold.h"

namespace qchopper {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Surface = CGAL::Surface_mesh<Kernel::Point_3>;

constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
constexpr int rings = 3;
constexpr std::size_t max_edges_for_full_search = 400;  // as in fill_holes.cpp

struct Strip {
    Surface surface;
    std::vector<std::uint32_t> number;  // per vertex of the surface the point of the mesh
    std::vector<std::uint32_t> vertex;  // per point of the mesh the vertex of the surface, or none
};

std::vector<std::uint32_t> triangles_around(const TriangleMesh& mesh, std::span<const std::uint32_t> loop) {
    std::vector<bool> is_near(mesh.points.size());
    for (const std::uint32_t h : loop) is_near[start_of(mesh, h)] = true;
    std::vector<std::uint32_t> found;
    for (int ring = 0; ring < rings; ++ring) {
        found.clear();
        for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
            const Triangle& v = mesh.triangles[t];
            if (is_near[v[0]] || is_near[v[1]] || is_near[v[2]]) found.push_back(t);
        }
        for (const std::uint32_t t : found) {
            for (const std::uint32_t v : mesh.triangles[t]) is_near[v] = true;
        }
    }
    return found;
}

std::optional<Strip> strip_around(const TriangleMesh& mesh, std::span<const std::uint32_t> loop) {
    Strip strip;
    strip.vertex.assign(mesh.points.size(), none);
    for (const std::uint32_t t : triangles_around(mesh, loop)) {
        Surface::Vertex_index corner[3];
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t v = mesh.triangles[t][i];
            if (strip.vertex[v] == none) {
                const Vec3 p = mesh.points[v];
                strip.vertex[v] = strip.surface.add_vertex({p.x, p.y, p.z});
                strip.number.push_back(v);
            }
            corner[i] = Surface::Vertex_index(strip.vertex[v]);
        }
        if (strip.surface.add_face(corner[0], corner[1], corner[2]) == Surface::null_face()) return std::nullopt;
    }
    return strip;
}

// Whether no new point is farther from the centre of the loop than three times the radius of the loop.
bool is_near(const std::vector<Vec3>& points, const TriangleMesh& mesh, std::span<const std::uint32_t> loop) {
    const Vec3 centre = centre_of(mesh, loop);
    double radius = 0;
    for (const std::uint32_t h : loop) radius = std::max(radius, norm(mesh.points[start_of(mesh, h)] - centre));
    return std::all_of(points.begin(), points.end(), [&](Vec3 p) { return norm(p - centre) <= 3 * radius; });
}

}  // namespace

std::optional<FairFill> fair_hole(const TriangleMesh& mesh, std::span<const std::uint32_t> loop) {
    namespace pmp = CGAL::Polygon_mesh_processing;
    std::optional<Strip> strip = strip_around(mesh, loop);
    if (!strip) return std::nullopt;
    Surface& surface = strip->surface;
    const Surface::Halfedge_index border =
        surface.halfedge(Surface::Vertex_index(strip->vertex[end_of(mesh, loop.front())]),
                         Surface::Vertex_index(strip->vertex[start_of(mesh, loop.front())]));
    if (border == Surface::null_halfedge() || !surface.is_border(border)) return std::nullopt;
    std::vector<Surface::Face_index> faces;
    std::vector<Surface::Vertex_index> vertices;
    pmp::triangulate_refine_and_fair_hole(
        surface, border, std::back_inserter(faces), std::back_inserter(vertices),
        pmp::parameters::fairing_continuity(1).do_not_use_cubic_algorithm(loop.size() > max_edges_for_full_search));
    if (faces.empty()) return std::nullopt;
    FairFill fill;
    std::sort(vertices.begin(), vertices.end());
    strip->number.resize(surface.number_of_vertices(), none);
    for (const Surface::Vertex_index v : vertices) {
        const Kernel::Point_3& p = surface.point(v);
        if (!std::isfinite(p.x()) || !std::isfinite(p.y()) || !std::isfinite(p.z())) return std::nullopt;
        strip->number[v] = static_cast<std::uint32_t>(mesh.points.size() + fill.points.size());
        fill.points.push_back({p.x(), p.y(), p.z()});
    }
    if (!is_near(fill.points, mesh, loop)) return std::nullopt;
    for (const Surface::Face_index face : faces) {
        Triangle triangle{};
        std::size_t i = 0;
        for (const Surface::Vertex_index v : surface.vertices_around_face(surface.halfedge(face))) {
            triangle[i++] = strip->number[v];
        }
        fill.triangles.push_back(triangle);
    }
    return fill;
}

}  // namespace qchopper
