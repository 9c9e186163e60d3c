// From the definition.

#include "tests/reference/segment/objectives/symmetry_score.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <vector>

#include "segment/objectives/mirror_matches.h"
#include "segment/objectives/symmetry_plane.h"

namespace qchopper {

double symmetry_score(std::span<const Vec3> points, const Plane& plane) {
    std::vector<double> distances;
    for (const Vec3& p : points) {
        const bool is_above = height(plane.normal, p) > plane.offset;
        double least = std::numeric_limits<double>::infinity();
        for (const Vec3& q : points) {
            if ((height(plane.normal, q) > plane.offset) == is_above) continue;
            least = std::min(least, norm(q - reflected(p, plane)));
        }
        distances.push_back(least);
    }
    if (distances.empty()) return std::numeric_limits<double>::infinity();
    std::sort(distances.begin(), distances.end());
    const auto count = static_cast<double>(distances.size());
    const std::size_t kept = std::max<std::size_t>(1, static_cast<std::size_t>(scored_share * count));
    return std::accumulate(distances.begin(), distances.begin() + static_cast<std::ptrdiff_t>(kept), 0.0) /
           static_cast<double>(kept);
}

}  // namespace qchopper
