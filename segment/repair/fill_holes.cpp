// Borders are closed by the minimum-weight triangulation of P. Liepa, "Filling holes in meshes" (2003), as in CGAL.
// OpenMesh holds the connectivity. CGAL rounds the points that it writes to an OpenMesh mesh to float; here it
// writes none, and our own points never leave our own mesh.

#include "segment/repair/fill_holes.h"

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
// OpenMesh first: CGAL's header adapts to it
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>
#include <CGAL/boost/graph/graph_traits_TriMesh_ArrayKernelT.h>

#include <iterator>

#include "segment/repair/manifold.h"

namespace qchopper {
namespace {

struct Doubles : OpenMesh::DefaultTraits {
    using Point = OpenMesh::Vec3d;
    using Normal = OpenMesh::Vec3d;
};
using Surface = OpenMesh::TriMesh_ArrayKernelT<Doubles>;

// Beyond this many edges only triangles of the Delaunay tetrahedra are tried: the search over all grows with n^3.
constexpr std::size_t most_edges_for_full_search = 400;

// False where the surface folds onto itself in a way that half-edges cannot tell.
bool build(const TriangleMesh& mesh, Surface& surface) {
    omerr().disable();  // it would print what the caller reports
    surface.reserve(mesh.points.size(), 3 * mesh.triangles.size() / 2 + 1, mesh.triangles.size());
    for (const Vec3& p : mesh.points) surface.add_vertex({p.x, p.y, p.z});
    for (const Triangle& t : mesh.triangles) {
        const auto corner = [&](std::size_t i) { return surface.vertex_handle(t[i]); };
        if (!surface.add_face(corner(0), corner(1), corner(2)).is_valid()) return false;
    }
    return true;
}

// The half-edge of the border that runs along this open edge, outside of the surface.
Surface::HalfedgeHandle border_half_edge(const Surface& surface, const TriangleMesh& mesh, std::uint32_t open) {
    return surface.find_halfedge(surface.vertex_handle(end_of(mesh, open)),
                                 surface.vertex_handle(start_of(mesh, open)));
}

std::vector<Surface::FaceHandle> fill(Surface& surface, Surface::HalfedgeHandle border, std::size_t edges) {
    std::vector<Surface::FaceHandle> added;
    CGAL::Polygon_mesh_processing::triangulate_hole(
        surface, border, std::back_inserter(added),
        CGAL::parameters::do_not_use_cubic_algorithm(edges > most_edges_for_full_search));
    return added;
}

}  // namespace

FilledHoles fill_holes(TriangleMesh& mesh) {
    FilledHoles result;
    const std::vector<std::vector<std::uint32_t>> loops = border_loops(mesh, unpaired(mesh, edges(mesh)).open);
    if (loops.empty()) return result;
    Surface surface;
    const bool is_built = build(mesh, surface);
    std::vector<Triangle> added;
    for (const std::vector<std::uint32_t>& loop : loops) {
        std::vector<Surface::FaceHandle> faces;
        if (is_built) faces = fill(surface, border_half_edge(surface, mesh, loop.front()), loop.size());
        if (faces.empty()) {
            result.left.push_back({centre_of(mesh, loop), loop.size()});
            continue;
        }
        ++result.filled;
        for (const Surface::FaceHandle face : faces) {
            Triangle triangle{};
            std::size_t i = 0;
            for (const Surface::VertexHandle corner : surface.fv_range(face)) {
                triangle[i++] = static_cast<std::uint32_t>(corner.idx());
            }
            added.push_back(triangle);
        }
    }
    result.triangles = added.size();
    mesh.triangles.insert(mesh.triangles.end(), added.begin(), added.end());
    if (!mesh.cap_of.empty()) mesh.cap_of.resize(mesh.triangles.size(), no_cap);
    return result;
}

}  // namespace qchopper
