// Borders are closed by the minimum-weight triangulation of P. Liepa, "Filling holes in meshes" (2003), as in CGAL.
// It searches among the faces of the Delaunay tetrahedra of a loop first; where these do not close a loop of n <= 400
// edges, among all triangles in O(n^3). The mesh is copied once: OpenMesh holds the connectivity. CGAL would round
// points that it writes to an OpenMesh mesh to float; a flat fill writes none. A fair fill is triangulated, refined to
// the density of the border and faired. Fairing reads two rings of the surface, so CGAL gets only a strip around the
// loop: O(points + triangles) of the mesh to find it, and a sparse linear system.

#include "segment/repair/fill_holes.h"

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
// OpenMesh first: CGAL's header adapts to it
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/graph_traits_TriMesh_ArrayKernelT.h>
#include <CGAL/utility.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <optional>
#include <span>
#include <utility>

#include "segment/mesh/connectivity/manifold.h"
#include "segment/mesh/measure.h"

namespace qchopper {
namespace {

struct FillTraits : OpenMesh::DefaultTraits {
    using Point = OpenMesh::Vec3d;
    using Normal = OpenMesh::Vec3d;
};
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using StripSurface = CGAL::Surface_mesh<Kernel::Point_3>;
using Surface = OpenMesh::TriMesh_ArrayKernelT<FillTraits>;

// Beyond this many edges only triangles of the Delaunay tetrahedra are tried: the search over all grows with n^3.
constexpr std::size_t max_edges_for_full_search = 400;

constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
constexpr int rings = 3;  // of the strip that a fair fill continues

// Returns false where the mesh is no manifold that half-edges can hold.
bool build(const TriangleMesh& mesh, Surface& surface) {
    omerr().disable();  // OpenMesh would print an error that the caller reports
    surface.reserve(mesh.points.size(), 3 * mesh.triangles.size() / 2 + 1, mesh.triangles.size());
    for (const Vec3& p : mesh.points) surface.add_vertex({p.x, p.y, p.z});
    for (const Triangle& t : mesh.triangles) {
        const auto corner = [&](std::size_t i) { return surface.vertex_handle(t[i]); };
        if (!surface.add_face(corner(0), corner(1), corner(2)).is_valid()) return false;
    }
    return true;
}

// The border half-edge opposite to an open half-edge of the mesh.
Surface::HalfedgeHandle border_half_edge(const Surface& surface, const TriangleMesh& mesh, std::uint32_t open) {
    return surface.find_halfedge(surface.vertex_handle(end_of(mesh, open)),
                                 surface.vertex_handle(start_of(mesh, open)));
}

std::vector<Surface::FaceHandle> fill(Surface& surface, Surface::HalfedgeHandle border, std::size_t edges) {
    std::vector<Surface::FaceHandle> added;
    CGAL::Polygon_mesh_processing::triangulate_hole(
        surface, border, std::back_inserter(added),
        CGAL::parameters::do_not_use_cubic_algorithm(edges > max_edges_for_full_search));
    return added;
}

// The triangles that close the loop flat; empty if there are none.
std::vector<Triangle> flat_triangles(Surface& surface, const TriangleMesh& mesh, std::span<const std::uint32_t> loop) {
    std::vector<Triangle> triangles;
    for (const Surface::FaceHandle face : fill(surface, border_half_edge(surface, mesh, loop.front()), loop.size())) {
        Triangle triangle{};
        std::size_t i = 0;
        for (const Surface::VertexHandle corner : surface.fv_range(face)) {
            triangle[i++] = static_cast<std::uint32_t>(corner.idx());
        }
        triangles.push_back(triangle);
    }
    return triangles;
}

// The longest edge of the filling that is not on the border of the hole.
double longest_chord(const TriangleMesh& mesh, std::span<const std::uint32_t> loop,
                     const std::vector<Triangle>& filling) {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> border;
    for (const std::uint32_t h : loop) border.emplace_back(end_of(mesh, h), start_of(mesh, h));
    std::sort(border.begin(), border.end());
    double longest = 0;
    for (const Triangle& t : filling) {
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t a = t[i];
            const std::uint32_t b = t[(i + 1) % 3];
            if (std::binary_search(border.begin(), border.end(), std::pair{a, b})) continue;
            longest = std::max(longest, norm(mesh.points[a] - mesh.points[b]));
        }
    }
    return longest;
}

// New points, and triangles over the points of the mesh followed by these: the first new point has the number
// mesh.points.size().
struct FairFill {
    std::vector<Vec3> points;
    std::vector<Triangle> triangles;
};

struct Strip {
    StripSurface surface;
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
        StripSurface::Vertex_index corner[3];
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t v = mesh.triangles[t][i];
            if (strip.vertex[v] == none) {
                const Vec3 p = mesh.points[v];
                strip.vertex[v] = strip.surface.add_vertex({p.x, p.y, p.z});
                strip.number.push_back(v);
            }
            corner[i] = StripSurface::Vertex_index(strip.vertex[v]);
        }
        if (strip.surface.add_face(corner[0], corner[1], corner[2]) == StripSurface::null_face()) return std::nullopt;
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

// Closes one loop with a refined and faired fill, which continues the curvature of the surface around it. `loop` is one
// of border_loops (manifold.h). Returns nothing if no fill is found, or one that reaches farther from the centre of the
// loop than three times the radius of the loop. The mesh stays as it is.
std::optional<FairFill> fair_hole(const TriangleMesh& mesh, std::span<const std::uint32_t> loop) {
    namespace pmp = CGAL::Polygon_mesh_processing;
    std::optional<Strip> strip = strip_around(mesh, loop);
    if (!strip) return std::nullopt;
    StripSurface& surface = strip->surface;
    const StripSurface::Halfedge_index border =
        surface.halfedge(StripSurface::Vertex_index(strip->vertex[end_of(mesh, loop.front())]),
                         StripSurface::Vertex_index(strip->vertex[start_of(mesh, loop.front())]));
    if (border == StripSurface::null_halfedge() || !surface.is_border(border)) return std::nullopt;
    std::vector<StripSurface::Face_index> faces;
    std::vector<StripSurface::Vertex_index> vertices;
    pmp::triangulate_refine_and_fair_hole(
        surface, border, std::back_inserter(faces), std::back_inserter(vertices),
        pmp::parameters::fairing_continuity(1).do_not_use_cubic_algorithm(loop.size() > max_edges_for_full_search));
    if (faces.empty()) return std::nullopt;
    FairFill fill;
    std::sort(vertices.begin(), vertices.end());
    strip->number.resize(surface.number_of_vertices(), none);
    for (const StripSurface::Vertex_index v : vertices) {
        const Kernel::Point_3& p = surface.point(v);
        if (!std::isfinite(p.x()) || !std::isfinite(p.y()) || !std::isfinite(p.z())) return std::nullopt;
        strip->number[v] = static_cast<std::uint32_t>(mesh.points.size() + fill.points.size());
        fill.points.push_back({p.x(), p.y(), p.z()});
    }
    if (!is_near(fill.points, mesh, loop)) return std::nullopt;
    for (const StripSurface::Face_index face : faces) {
        Triangle triangle{};
        std::size_t i = 0;
        for (const StripSurface::Vertex_index v : surface.vertices_around_face(surface.halfedge(face))) {
            triangle[i++] = strip->number[v];
        }
        fill.triangles.push_back(triangle);
    }
    return fill;
}

class Filling {
 public:
    Filling(TriangleMesh& mesh, const FillOptions& options)
        : mesh_(mesh), options_(options), flat_chord_(options.flat_chord_share * norm(bounds(mesh).size())) {}

    FilledHoles run(const IndexLists& loops, const Context& context) {
        is_built_ = options_.fill != Fill::none && build(mesh_, surface_);
        for (const std::span<const std::uint32_t> loop : loops) {
            context.check_cancelled();
            if (!close(loop)) result_.left.push_back({centre_of(mesh_, loop), loop.size()});
            ++result_.filled;
        }
        result_.filled -= result_.left.size();
        result_.triangles = triangles_.size();
        result_.points = points_.size();
        mesh_.points.insert(mesh_.points.end(), points_.begin(), points_.end());
        mesh_.triangles.insert(mesh_.triangles.end(), triangles_.begin(), triangles_.end());
        if (!mesh_.cap_of.empty()) mesh_.cap_of.resize(mesh_.triangles.size(), no_cap);
        return std::move(result_);
    }

 private:
    bool close(std::span<const std::uint32_t> loop) {
        if (!is_built_) return false;
        const std::vector<Triangle> flat = flat_triangles(surface_, mesh_, loop);
        const bool is_fair = options_.fill == Fill::fair ||
                             (options_.fill == Fill::by_size && longest_chord(mesh_, loop, flat) > flat_chord_);
        if ((is_fair || flat.empty()) && options_.fill != Fill::flat && fair(loop)) return true;
        triangles_.insert(triangles_.end(), flat.begin(), flat.end());
        return !flat.empty() || (options_.fill != Fill::flat && fan(loop));
    }

    // For loops across which no triangle fits, because its edge exists already: triangles around a point in the centre.
    bool fan(std::span<const std::uint32_t> loop) {
        if (loop.size() < 3) return false;
        const auto middle = static_cast<std::uint32_t>(mesh_.points.size() + points_.size());
        points_.push_back(centre_of(mesh_, loop));
        for (const std::uint32_t h : loop) triangles_.push_back({end_of(mesh_, h), start_of(mesh_, h), middle});
        return true;
    }

    bool fair(std::span<const std::uint32_t> loop) {
        const std::optional<FairFill> fill = fair_hole(mesh_, loop);
        if (!fill) return false;
        const auto own = static_cast<std::uint32_t>(mesh_.points.size());
        for (Triangle t : fill->triangles) {
            for (std::uint32_t& v : t) v += v < own ? 0 : static_cast<std::uint32_t>(points_.size());
            triangles_.push_back(t);
        }
        points_.insert(points_.end(), fill->points.begin(), fill->points.end());
        ++result_.faired;
        return true;
    }

    TriangleMesh& mesh_;
    const FillOptions& options_;
    double flat_chord_;
    Surface surface_;
    bool is_built_ = false;
    std::vector<Triangle> triangles_;
    std::vector<Vec3> points_;
    FilledHoles result_;
};

}  // namespace

FilledHoles fill_holes(TriangleMesh& mesh, const FillOptions& options, const Context& context) {
    const IndexLists loops = border_loops(mesh, unpaired(mesh, edges(mesh)).open);
    if (loops.empty()) return {};
    return Filling(mesh, options).run(loops, context);
}

std::vector<Triangle> fill_loop(const std::vector<Vec3>& loop, const std::vector<Vec3>& beyond) {
    constexpr std::size_t max_edges = 200;  // as max_edges_for_full_search; many loops are tried
    std::vector<Kernel::Point_3> points;
    std::vector<Kernel::Point_3> thirds;
    points.reserve(loop.size());
    thirds.reserve(beyond.size());
    for (const Vec3& p : loop) points.emplace_back(p.x, p.y, p.z);
    for (const Vec3& p : beyond) thirds.emplace_back(p.x, p.y, p.z);
    std::vector<CGAL::Triple<int, int, int>> found;
    CGAL::Polygon_mesh_processing::triangulate_hole_polyline(
        points, thirds, std::back_inserter(found),
        CGAL::parameters::do_not_use_cubic_algorithm(loop.size() > max_edges));
    std::vector<Triangle> triangles;
    for (const auto& [a, b, c] : found) {
        Triangle t{static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b), static_cast<std::uint32_t>(c)};
        std::sort(t.begin(), t.end());  // ascending positions run along the loop
        triangles.push_back(t);
    }
    return triangles;
}

}  // namespace qchopper
