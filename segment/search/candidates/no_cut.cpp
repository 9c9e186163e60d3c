// Intervals of single triangles are sorted by their lower ends, then those that overlap are united.

#include "segment/search/candidates/no_cut.h"

#include <algorithm>
#include <tuple>

namespace qchopper {
namespace {

bool is_before(const Vec3& a, const Vec3& b) {
    return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
}

}  // namespace

NoCut no_cut_at(std::vector<Vec3> points) {
    if (points.empty()) return {};
    std::sort(points.begin(), points.end(), is_before);
    return {std::make_shared<const std::vector<Vec3>>(std::move(points))};
}

std::vector<NoCutTriangle> no_cut_triangles(const TriangleMesh& mesh, const NoCut& no_cut) {
    std::vector<NoCutTriangle> found;
    if (!no_cut.points) return found;
    std::vector<bool> is_marked;
    is_marked.reserve(mesh.points.size());
    for (const Vec3& p : mesh.points) {
        is_marked.push_back(std::binary_search(no_cut.points->begin(), no_cut.points->end(), p, is_before));
    }
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const auto [a, b, c] = mesh.triangles[t];
        if (is_marked[a] || is_marked[b] || is_marked[c]) found.push_back(corners_of(mesh, t));
    }
    return found;
}

std::vector<Extent> forbidden_heights(std::span<const NoCutTriangle> triangles, Vec3 normal) {
    std::vector<Extent> of_triangles;
    of_triangles.reserve(triangles.size());
    for (const auto& [a, b, c] : triangles) {
        const auto [low, high] = std::minmax({height(normal, a), height(normal, b), height(normal, c)});
        if (low < high) of_triangles.push_back({low, high});
    }
    std::sort(of_triangles.begin(), of_triangles.end(), [](const Extent& a, const Extent& b) { return a.low < b.low; });
    std::vector<Extent> heights;
    for (const Extent& next : of_triangles) {
        if (heights.empty() || next.low >= heights.back().high) {
            heights.push_back(next);
        } else {
            heights.back().high = std::max(heights.back().high, next.high);
        }
    }
    return heights;
}

bool is_forbidden(std::span<const Extent> heights, double offset) {
    // The first interval that ends above the offset.
    const auto at = std::upper_bound(heights.begin(), heights.end(), offset,
                                     [](double o, const Extent& interval) { return o < interval.high; });
    return at != heights.end() && at->low < offset;
}

}  // namespace qchopper
