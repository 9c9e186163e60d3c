// CGAL's Polygon_mesh_processing::self_intersections; the mesh is built once, outside the times.

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>

#include <iterator>
#include <utility>
#include <vector>

#include "bench/other_readers.h"

namespace qchopper::bench {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;

}  // namespace

struct CgalSurface::Surface {
    Mesh mesh;
};

CgalSurface::CgalSurface(const TriangleMesh& mesh) : surface_(new Surface) {
    for (const Vec3& p : mesh.points) surface_->mesh.add_vertex({p.x, p.y, p.z});
    for (const Triangle& t : mesh.triangles) {
        surface_->mesh.add_face(Mesh::Vertex_index(t[0]), Mesh::Vertex_index(t[1]), Mesh::Vertex_index(t[2]));
    }
}

CgalSurface::~CgalSurface() {
    delete surface_;
}

bool CgalSurface::does_self_intersect() const {
    return CGAL::Polygon_mesh_processing::does_self_intersect(surface_->mesh);
}

std::size_t CgalSurface::self_intersections() const {
    std::vector<std::pair<Mesh::Face_index, Mesh::Face_index>> pairs;
    CGAL::Polygon_mesh_processing::self_intersections(surface_->mesh, std::back_inserter(pairs));
    return pairs.size();
}

}  // namespace qchopper::bench
