// Sums over triangles. O(triangles).

#include "cam/setup/undercut.h"

#include <algorithm>
#include <cassert>

#include "segment/mesh/measure.h"

namespace qchopper {

Facing facing(const TriangleMesh& mesh, Vec3 up, std::optional<std::int32_t> base, std::span<const std::int32_t> sawn) {
    assert(is_consistent(mesh) && norm(up) > 0);
    Facing sums;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        if (std::find(sawn.begin(), sawn.end(), cap_of(mesh, t)) != sawn.end()) continue;
        const double projected = dot(area_vector(mesh, t), up);
        if (base && cap_of(mesh, t) == *base) {
            sums.base -= projected;
        } else if (projected < 0) {
            sums.down -= projected;
            ++sums.triangles_down;
        } else {
            sums.up += projected;
            ++sums.triangles_up;
        }
    }
    return sums;
}

}  // namespace qchopper
