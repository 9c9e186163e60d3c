// Product and application of affine maps. place_points: O(points).

#include "segment/io/formats/placement.h"

#include <cmath>

#include "base/error.h"

namespace qchopper {

Placement operator*(const Placement& outer, const Placement& inner) {
    Placement both;
    const Placement linear{outer.axes, {}};
    for (std::size_t i = 0; i < 3; ++i) both.axes[i] = linear(inner.axes[i]);
    both.origin = outer(inner.origin);
    return both;
}

bool is_mirroring(const Placement& placement) {
    return dot(cross(placement.axes[0], placement.axes[1]), placement.axes[2]) < 0;
}

std::uint32_t place_points(RawMesh& scan, const std::vector<Vec3>& points, const Placement& placement,
                           const std::string& what) {
    const std::size_t first = scan.mesh.points.size();
    if (points.size() > max_placed - first) {
        throw InputError(InputFault::mesh,
                         what + ": with all its repetitions the scene has more than 50 million points",
                         "export only what is to be carved");
    }
    for (const Vec3& point : points) {
        const Vec3 p = placement(point);
        if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) {
            throw InputError(InputFault::mesh, what + " has a point whose position is not a finite number",
                             "export the scan again");
        }
        scan.mesh.points.push_back(p);
    }
    return static_cast<std::uint32_t>(first);
}

}  // namespace qchopper
