// CGAL's Polygon_mesh_processing::clip, once per side; only the clips are timed.

#include "bench/cgal_clip.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/clip.h>
#include <CGAL/Surface_mesh.h>

#include <vector>

#include "bench/clock.h"

namespace qchopper::bench {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;

Mesh to_cgal(const TriangleMesh& mesh) {
    Mesh result;
    std::vector<Mesh::Vertex_index> vertex;
    for (const Vec3& p : mesh.points) vertex.push_back(result.add_vertex({p.x, p.y, p.z}));
    for (const Triangle& t : mesh.triangles) result.add_face(vertex[t[0]], vertex[t[1]], vertex[t[2]]);
    return result;
}

}  // namespace

ClipResult cgal_clip(const TriangleMesh& mesh, const Plane& plane) {
    namespace pmp = CGAL::Polygon_mesh_processing;
    Mesh above = to_cgal(mesh);
    Mesh below = above;
    const Kernel::Plane_3 upper(plane.normal.x, plane.normal.y, plane.normal.z, -plane.offset);
    ClipResult result;
    const double started = cpu_s();
    pmp::clip(below, upper, pmp::parameters::clip_volume(true));
    pmp::clip(above, upper.opposite(), pmp::parameters::clip_volume(true));
    result.cpu_s = cpu_s() - started;
    above.collect_garbage();
    below.collect_garbage();
    result.faces_above = above.number_of_faces();
    result.faces_below = below.number_of_faces();
    result.is_closed = CGAL::is_closed(above) && CGAL::is_closed(below);
    return result;
}

}  // namespace qchopper::bench
