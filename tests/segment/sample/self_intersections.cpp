#include "tests/segment/sample/self_intersections.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>

#include <iterator>
#include <utility>
#include <vector>

namespace qchopper {

std::size_t count_self_intersections(const TriangleMesh& mesh) {
    using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
    using Surface = CGAL::Surface_mesh<Kernel::Point_3>;
    Surface surface;
    for (const Vec3& p : mesh.points) surface.add_vertex({p.x, p.y, p.z});
    for (const Triangle& t : mesh.triangles) {
        surface.add_face(Surface::Vertex_index(t[0]), Surface::Vertex_index(t[1]), Surface::Vertex_index(t[2]));
    }
    std::vector<std::pair<Surface::Face_index, Surface::Face_index>> pairs;
    CGAL::Polygon_mesh_processing::self_intersections(surface, std::back_inserter(pairs));
    return pairs.size() + (mesh.triangles.size() - surface.number_of_faces());  // a refused face is a fault too
}

}  // namespace qchopper
