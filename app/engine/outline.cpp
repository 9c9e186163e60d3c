// The loops of the plane section, each begun where the cut begins it.

#include "app/engine/outline.h"

#include <algorithm>
#include <cstdint>

#include "segment/mesh/plane_section.h"

namespace qchopper {
Outline outline(const TriangleMesh& mesh, const Plane& plane) {
    Outline result;
    const PlaneSection section = plane_section(mesh, plane, points_above(mesh, plane));
    for (const Loop& points : section.loops) {
        std::vector<Vec3>& loop = result.loops.emplace_back();
        for (const std::uint32_t p : points) loop.push_back(section.points[p]);
        std::rotate(loop.begin(), loop.end() - 1, loop.end());  // begins in the first triangle that is crossed
    }
    bool is_first = true;
    for (const auto& loop : result.loops) {
        for (std::size_t i = 0; i < loop.size(); ++i) {
            result.length_mm += norm(loop[(i + 1) % loop.size()] - loop[i]);
            if (is_first) result.box = {loop[i], loop[i]};
            is_first = false;
            extend(result.box, loop[i]);
        }
    }
    return result;
}

}  // namespace qchopper
