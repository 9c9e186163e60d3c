// Points are sorted along the curve of G. Morton, "A computer oriented geodetic data base and a new technique in file
// sequencing" (1966), by a radix sort of three digits; triangles by the first of their points, and then clusters are
// formed greedily in that order. O(triangles + points).

#include "segment/mesh/order.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "base/huge_pages.h"
#include "segment/mesh/measure.h"

namespace qchopper {
namespace {

constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
constexpr unsigned bits_per_axis = 11;  // 2048 cells along the longest side: finer than a scan of ten million faces
constexpr std::size_t keys = std::size_t{1} << bits_per_axis;

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

struct Keyed {
    std::uint64_t key;
    std::uint32_t point;
};

// Radix sort, by one digit of the key after the other; ties keep their order.
void sort_by_key(std::vector<Keyed>& points) {
    auto other = huge<Keyed>(points.size());
    for (unsigned digit = 0; digit < 3; ++digit) {
        const auto digit_of = [&](const Keyed& p) { return (p.key >> (digit * bits_per_axis)) & (keys - 1); };
        std::array<std::uint32_t, keys + 1> first{};
        for (const Keyed& p : points) ++first[digit_of(p) + 1];
        for (std::size_t k = 1; k <= keys; ++k) first[k] += first[k - 1];
        for (const Keyed& p : points) other[first[digit_of(p)]++] = p;
        points.swap(other);
    }
}

// One number per point: its place along the curve.
std::vector<std::uint32_t> along_curve(const TriangleMesh& mesh) {
    const Box box = bounds(mesh);
    const Vec3 size = box.size();
    const double longest = std::max({size.x, size.y, size.z});
    const double scale = longest > 0 ? static_cast<double>(keys - 1) / longest : 0;
    auto order = huge<Keyed>(mesh.points.size());
    for (std::uint32_t v = 0; v < order.size(); ++v) {
        const Vec3 p = scale * (mesh.points[v] - box.min);
        order[v] = {spread(static_cast<std::uint64_t>(p.x)) | spread(static_cast<std::uint64_t>(p.y)) << 1 |
                        spread(static_cast<std::uint64_t>(p.z)) << 2,
                    v};
    }
    sort_by_key(order);
    auto place = huge<std::uint32_t>(order.size());
    for (std::uint32_t i = 0; i < order.size(); ++i) place[order[i].point] = i;
    return place;
}

// The items in the order of their keys, which are below `end`; ties keep their order. `item_keys` has one entry per
// item, at the item's value.
std::vector<std::uint32_t> sorted_by(const std::vector<std::uint32_t>& item_keys, std::size_t end,
                                     const std::vector<std::uint32_t>& items) {
    std::vector<std::uint32_t> first(end + 1, 0);
    assert(item_keys.size() == items.size());
    for (const std::uint32_t key : item_keys) {
        assert(key < end);
        ++first[key + 1];
    }
    for (std::size_t key = 1; key <= end; ++key) first[key] += first[key - 1];
    auto result = huge<std::uint32_t>(items.size());
    for (const std::uint32_t item : items) result[first[item_keys[item]]++] = item;
    return result;
}

// One number per triangle: its cluster. In `order`, each triangle joins the earliest cluster at its corners that is not
// full, or begins a new one. `count` receives the number of clusters.
std::vector<std::uint32_t> divide(const TriangleMesh& mesh, const std::vector<std::uint32_t>& order,
                                  std::size_t& count) {
    std::vector<std::uint32_t> size;
    std::vector<std::uint32_t> at_point(mesh.points.size(), none);  // the cluster that a triangle at the point joins
    auto cluster = huge<std::uint32_t>(mesh.triangles.size());
    for (const std::uint32_t t : order) {
        std::uint32_t chosen = none;
        for (const std::uint32_t v : mesh.triangles[t]) {
            const std::uint32_t c = at_point[v];
            if (c != none && size[c] < triangles_per_cluster && c < chosen) chosen = c;
        }
        if (chosen == none) {
            chosen = static_cast<std::uint32_t>(size.size());
            size.push_back(0);
        }
        ++size[chosen];
        cluster[t] = chosen;
        for (const std::uint32_t v : mesh.triangles[t]) {
            if (at_point[v] == none || size[at_point[v]] >= triangles_per_cluster) at_point[v] = chosen;
        }
    }
    count = size.size();
    return cluster;
}

}  // namespace

TriangleMesh in_memory_order(const TriangleMesh& mesh) {
    assert(is_consistent(mesh));
    const std::vector<std::uint32_t> place = along_curve(mesh);
    auto least = huge<std::uint32_t>(mesh.triangles.size());
    std::vector<std::uint32_t> order(mesh.triangles.size());
    std::iota(order.begin(), order.end(), 0U);
    for (std::size_t t = 0; t < least.size(); ++t) {
        const Triangle& v = mesh.triangles[t];
        least[t] = std::min({place[v[0]], place[v[1]], place[v[2]]});
    }
    std::size_t clusters = 0;
    order = sorted_by(least, mesh.points.size(), order);
    const std::vector<std::uint32_t> cluster = divide(mesh, order, clusters);
    TriangleMesh result;
    reserve_huge(result.points, mesh.points.size());
    reserve_huge(result.triangles, mesh.triangles.size());
    std::vector<std::uint32_t> number(mesh.points.size(), none);
    const auto numbered = [&](std::uint32_t v) {
        if (number[v] == none) {
            number[v] = static_cast<std::uint32_t>(result.points.size());
            result.points.push_back(mesh.points[v]);
        }
        return number[v];
    };
    for (const std::uint32_t t : sorted_by(cluster, clusters, order)) {
        const Triangle& v = mesh.triangles[t];
        const std::uint32_t a = numbered(v[0]);
        const std::uint32_t b = numbered(v[1]);
        result.triangles.push_back({a, b, numbered(v[2])});
        if (!mesh.cap_of.empty()) result.cap_of.push_back(mesh.cap_of[t]);
        if (!mesh.ignored.empty()) result.ignored.push_back(mesh.ignored[t]);
    }
    for (std::uint32_t v = 0; v < number.size(); ++v) numbered(v);
    assert(result.points.size() == mesh.points.size() && result.triangles.size() == mesh.triangles.size());
    assert(is_consistent(result));
    return result;
}

}  // namespace qchopper
