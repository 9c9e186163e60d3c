// G. Thürmer and C. Wüthrich, "Computing vertex normals from polygonal facets" (1998). O(triangles + points).

#include "segment/mesh/normals.h"

#include <cassert>
#include <cmath>

namespace qchopper {

std::vector<Vec3> vertex_normals(const TriangleMesh& mesh) {
    assert(is_consistent(mesh));
    std::vector<Vec3> normals(mesh.points.size());
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const Triangle& v = mesh.triangles[t];
        const Vec3 n = normalized(area_vector(mesh, t));
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3 a = mesh.points[v[(k + 1) % 3]] - mesh.points[v[k]];
            const Vec3 b = mesh.points[v[(k + 2) % 3]] - mesh.points[v[k]];
            const double angle = std::atan2(norm(cross(a, b)), dot(a, b));
            normals[v[k]] = normals[v[k]] + angle * n;
        }
    }
    for (Vec3& n : normals) n = normalized(n);
    return normals;
}

}  // namespace qchopper
