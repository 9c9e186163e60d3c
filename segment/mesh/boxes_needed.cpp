// The six orders of the axes, one by one.

#include "segment/mesh/boxes_needed.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace qchopper {

double boxes_needed(Vec3 size, Vec3 limit, double tolerated) {
    constexpr double infinite = std::numeric_limits<double>::infinity();
    constexpr double rounding = 1e-6;
    if (!(limit.x > 0 && limit.y > 0 && limit.z > 0)) return infinite;
    std::array<double, 3> order{size.x, size.y, size.z};
    std::sort(order.begin(), order.end());
    const auto parts = [&](double length, double most) {
        return std::max(1.0, std::ceil((length - rounding) / most - tolerated));
    };
    double fewest = infinite;
    do {
        fewest = std::min(fewest, parts(order[0], limit.x) * parts(order[1], limit.y) * parts(order[2], limit.z));
    } while (std::next_permutation(order.begin(), order.end()));
    return fewest;
}

}  // namespace qchopper
