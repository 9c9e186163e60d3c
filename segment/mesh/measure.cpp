// The volume is the sum of signed tetrahedra over a point of the mesh (divergence theorem). O(triangles + points).

#include "segment/mesh/measure.h"

#include <cassert>

namespace qchopper {

Box bounds(const TriangleMesh& mesh) {
    if (mesh.points.empty()) return {};
    Box box{mesh.points.front(), mesh.points.front()};
    for (const Vec3& p : mesh.points) extend(box, p);
    assert(box.min.x <= box.max.x && box.min.y <= box.max.y && box.min.z <= box.max.z);
    return box;
}

double volume_mm3(const TriangleMesh& mesh) {
    assert(is_consistent(mesh));
    if (mesh.points.empty()) return 0;
    const Vec3 origin = mesh.points.front();  // of the mesh: far from the origin the terms would cancel
    double six_volumes = 0;
    for (const Triangle& t : mesh.triangles) {
        six_volumes += dot(mesh.points[t[0]] - origin, cross(mesh.points[t[1]] - origin, mesh.points[t[2]] - origin));
    }
    return six_volumes / 6;
}

double area_mm2(const TriangleMesh& mesh) {
    double area = 0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) area += norm(area_vector(mesh, t));
    return area;
}

}  // namespace qchopper
