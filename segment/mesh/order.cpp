#include "segment/mesh/order.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "segment/mesh/measure.h"

namespace qchopper {
namespace {

// Spreads the low 21 bits so that two zeros follow each.
std::uint64_t spread(std::uint64_t x) {
    x &= 0x1FFFFF;
    x = (x | x << 32) & 0x1F00000000FFFF;
    x = (x | x << 16) & 0x1F0000FF0000FF;
    x = (x | x << 8) & 0x100F00F00F00F00F;
    x = (x | x << 4) & 0x10C30C30C30C30C3;
    x = (x | x << 2) & 0x1249249249249249;
    return x;
}

using Keyed = std::pair<std::uint64_t, std::uint32_t>;

}  // namespace

TriangleMesh in_memory_order(const TriangleMesh& mesh) {
    const Box box = bounds(mesh);
    const Vec3 size = box.size();
    const double longest = std::max({size.x, size.y, size.z});
    const double scale = longest > 0 ? 2097151.0 / longest : 0;
    std::vector<Keyed> order(mesh.points.size());
    for (std::uint32_t v = 0; v < order.size(); ++v) {
        const Vec3 p = scale * (mesh.points[v] - box.min);
        order[v] = {spread(static_cast<std::uint64_t>(p.x)) | spread(static_cast<std::uint64_t>(p.y)) << 1 |
                        spread(static_cast<std::uint64_t>(p.z)) << 2,
                    v};
    }
    std::sort(order.begin(), order.end());
    TriangleMesh result;
    result.points.reserve(order.size());
    std::vector<std::uint32_t> number(order.size());
    for (const auto& [key, v] : order) {
        number[v] = static_cast<std::uint32_t>(result.points.size());
        result.points.push_back(mesh.points[v]);
    }
    std::vector<Keyed> by_point(mesh.triangles.size());
    for (std::uint32_t t = 0; t < by_point.size(); ++t) {
        const Triangle& v = mesh.triangles[t];
        by_point[t] = {std::min({number[v[0]], number[v[1]], number[v[2]]}), t};
    }
    std::sort(by_point.begin(), by_point.end());
    result.triangles.reserve(by_point.size());
    for (const auto& [key, t] : by_point) {
        const Triangle& v = mesh.triangles[t];
        result.triangles.push_back({number[v[0]], number[v[1]], number[v[2]]});
        if (!mesh.cap_of.empty()) result.cap_of.push_back(mesh.cap_of[t]);
    }
    return result;
}

}  // namespace qchopper
