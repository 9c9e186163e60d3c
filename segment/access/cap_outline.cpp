// Green's theorem: along the boundary the integral of min(distance across, that of the plane) over the way along the
// section.

#include "segment/access/cap_outline.h"

#include <algorithm>

#include "segment/access/offset_counts.h"
#include "segment/mesh/plane.h"

namespace qchopper {
namespace {

constexpr double parallel = 1e-6;  // sine of the angle between cap and plane
constexpr double rounding = 1e-9;  // of the cap's area

}  // namespace

CapOutline::CapOutline(const TriangleMesh& mesh, const OwnedCap& cap, std::span<const std::uint32_t> triangles)
    : cap_(cap) {
    std::vector<std::array<std::uint32_t, 2>> ends;
    for (const std::uint32_t t : triangles) {
        const Triangle& corners = mesh.triangles[t];
        for (std::size_t k = 0; k < 3; ++k) ends.push_back({corners[k], corners[(k + 1) % 3]});
    }
    std::sort(ends.begin(), ends.end());
    for (const auto& [a, b] : ends) {
        if (std::binary_search(ends.begin(), ends.end(), std::array{b, a})) continue;
        edges_.push_back({mesh.points[a], mesh.points[b]});
    }
    if (!edges_.empty()) origin_ = edges_.front()[0];
}

std::vector<double> CapOutline::area_below(Vec3 normal, std::span<const double> offsets) const {
    std::vector<double> area(offsets.size());
    const double at_origin = height(normal, origin_);
    const Vec3 across = normal - dot(normal, cap_.outward) * cap_.outward;
    const double slope = norm(across);
    if (slope < parallel) {
        for (std::size_t j = 0; j < area.size(); ++j) area[j] = at_origin < offsets[j] ? cap_.area_mm2 : 0;
        return area;
    }
    std::vector<double> above_origin(offsets.begin(), offsets.end());
    for (double& offset : above_origin) offset -= at_origin;
    const OffsetCounts counts(above_origin);
    const Vec3 along = (1 / slope) * cross(cap_.outward, across);
    // Per number of offsets at or below the upper end, or below the lower one: what such edges add.
    std::vector<double> whole(offsets.size() + 1);
    std::vector<double> beyond(offsets.size() + 1);
    for (const auto& [a, b] : edges_) {
        const double way = dot(along, b - a);
        const double of_a = dot(normal, a - origin_);
        const double of_b = dot(normal, b - origin_);
        const double low = std::min(of_a, of_b);
        const double high = std::max(of_a, of_b);
        const std::uint32_t first = counts.at_most(low);
        const std::uint32_t last = counts.less_than(high);
        beyond[first] += way;
        whole[std::max(first, last)] += way * (low + high) / 2;
        for (std::uint32_t j = first; j < last; ++j) {
            const double offset = above_origin[j];
            area[j] += way * (offset - (offset - low) * (offset - low) / (2 * (high - low)));
        }
    }
    double sum = 0;
    for (std::size_t j = 0; j < area.size(); ++j) area[j] += sum += whole[j];
    sum = 0;
    for (std::size_t j = area.size(); j > 0; --j) area[j - 1] += (sum += beyond[j]) * above_origin[j - 1];
    for (double& a : area) {
        a = std::clamp(a / slope, 0.0, cap_.area_mm2);
        if (a < rounding * cap_.area_mm2) a = 0;
        if (a > (1 - rounding) * cap_.area_mm2) a = cap_.area_mm2;
    }
    return area;
}

std::vector<CapOutline> outlines(const TriangleMesh& mesh, std::span<const OwnedCap> caps) {
    std::vector<std::vector<std::uint32_t>> triangles(caps.size());
    for (std::uint32_t t = 0; t < mesh.cap_of.size(); ++t) {
        if (mesh.cap_of[t] == no_cap) continue;
        for (std::size_t c = 0; c < caps.size(); ++c) {
            if (caps[c].cut == mesh.cap_of[t]) triangles[c].push_back(t);
        }
    }
    std::vector<CapOutline> result;
    for (std::size_t c = 0; c < caps.size(); ++c) result.emplace_back(mesh, caps[c], triangles[c]);
    return result;
}

}  // namespace qchopper
