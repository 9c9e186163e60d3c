// Branch and bound over the triangles, after M. Guthe, P. Borodin and R. Klein, "Fast and accurate Hausdorff distance
// calculation between meshes" (2005): a triangle whose bound stays below the distance found is dropped, the others are
// split in four. A bound sees three triangles of the other surface at once, so that parts across their sides need not
// be split. O(log triangles) per point on average; a triangle tree of `to` in memory.

#include "segment/mesh/distance.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <vector>

#include "base/parallel.h"
#include "segment/mesh/measure.h"
#include "segment/mesh/triangle_tree.h"

namespace qchopper {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

constexpr std::size_t chunk = 1U << 17;

using TriangleCorners = std::array<Vec3, 3>;

// A triangle, or a part of one, with the bounds of its distance.
struct TrianglePart {
    TriangleCorners corner;
    double found = 0;    // largest distance at a corner
    double at_most = 0;  // anywhere in it
    Vec3 at{};           // the corner with the largest distance
};

// A convex polygon: a triangle of which up to three sides were cut off.
class Polygon {
 public:
    explicit Polygon(const TriangleCorners& corners) {
        for (const Vec3& p : corners) add(p);
    }

    // Removes and returns what lies where dot(normal, p) < offset.
    Polygon cut_off(Vec3 normal, double offset) {
        Polygon below;
        Polygon above;
        for (std::size_t k = 0; k < count_; ++k) {
            const Vec3 a = corners_[k];
            const Vec3 b = corners_[(k + 1) % count_];
            const double height_a = dot(normal, a) - offset;
            const double height_b = dot(normal, b) - offset;
            (height_a < 0 ? below : above).add(a);
            if ((height_a < 0) == (height_b < 0)) continue;
            const Vec3 crossing = a + height_a / (height_a - height_b) * (b - a);
            below.add(crossing);
            above.add(crossing);
        }
        *this = above;
        return below;
    }

    // The largest distance of a corner from a triangle: it is convex, so no other point of the polygon is farther.
    double farthest_from(const TriangleCorners& triangle) const {
        double farthest = 0;
        for (std::size_t k = 0; k < count_; ++k) {
            farthest = std::max(farthest, norm(corners_[k] - closest_on_triangle(corners_[k], triangle)));
        }
        return farthest;
    }

 private:
    Polygon() = default;
    void add(Vec3 p) {
        assert(count_ < corners_.size());
        corners_[count_++] = p;
    }

    std::array<Vec3, 9> corners_;  // rounding may cut a side twice: two more per cut at most
    std::size_t count_ = 0;
};

// No point of the part is farther from the three triangles: what lies over the first one is bounded by that, and what
// is cut off at each of its sides by the best of the three. So a part across the common side of two triangles in its
// own plane need not be split down to the tolerance.
double bound_by_sides(const TriangleCorners& part, const std::array<TriangleCorners, 3>& near) {
    const Vec3 normal = cross(near[0][1] - near[0][0], near[0][2] - near[0][0]);
    Polygon over(part);
    double bound = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 inwards = cross(normal, near[0][(k + 1) % 3] - near[0][k]);
        const Polygon beside = over.cut_off(inwards, dot(inwards, near[0][k]));
        double least = infinite;
        for (const TriangleCorners& triangle : near) least = std::min(least, beside.farthest_from(triangle));
        bound = std::max(bound, least);
    }
    return std::max(bound, over.farthest_from(near[0]));
}

// The distance to one triangle of the other surface is convex: where that triangle is nearest to all corners, no inner
// point is farther than a corner. Otherwise no point is farther than a corner's distance plus its distance from that
// corner. Bounds of at most `enough` are not made tighter.
void compute_bounds(TrianglePart& part, const TriangleTree& tree, const TriangleMesh& to, double enough) {
    std::array<TriangleTree::Nearest, 3> nearest;
    part.found = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        nearest[k] = tree.nearest(to, part.corner[k]);
        if (nearest[k].distance >= part.found) {
            part.found = nearest[k].distance;
            part.at = part.corner[k];
        }
    }
    double longest_edge = 0;  // every inner point is nearest to some corner, at most 0.58 of the longest edge away
    double by_plane = infinite;
    std::array<TriangleCorners, 3> near;
    for (std::size_t k = 0; k < 3; ++k) {
        longest_edge = std::max(longest_edge, norm(part.corner[(k + 1) % 3] - part.corner[k]));
        const TriangleCorners target = near[k] = corners_of(to, nearest[k].triangle);
        double above = 0;
        for (const Vec3& corner : part.corner) {
            above = std::max(above, norm(corner - closest_on_triangle(corner, target)));
        }
        by_plane = std::min(by_plane, above);
    }
    // In a right or obtuse triangle the point farthest from all corners lies on the longest edge, at half of it. In an
    // acute one it is the circumcentre, at most the longest edge divided by the root of three away.
    part.at_most = std::max(part.found, std::min(part.found + 0.578 * longest_edge, by_plane));
    for (std::size_t k = 0; k < 3 && part.found <= enough && part.at_most > enough; ++k) {
        std::rotate(near.begin(), near.begin() + (k > 0 ? 1 : 0), near.end());
        part.at_most = std::max(part.found, std::min(part.at_most, bound_by_sides(part.corner, near)));
    }
}

std::array<TrianglePart, 4> split(const TrianglePart& part) {
    const auto& [a, b, c] = part.corner;
    const Vec3 ab = 0.5 * (a + b);
    const Vec3 bc = 0.5 * (b + c);
    const Vec3 ca = 0.5 * (c + a);
    return {TrianglePart{{a, ab, ca}}, TrianglePart{{ab, b, bc}}, TrianglePart{{ca, bc, c}},
            TrianglePart{{ab, bc, ca}}};
}

// The corners of a triangle by their coordinates, whatever its orientation and first corner.
TriangleCorners sorted_corners(const TriangleMesh& mesh, std::size_t t) {
    TriangleCorners corners = corners_of(mesh, t);
    std::sort(corners.begin(), corners.end(), [](const Vec3& a, const Vec3& b) {
        return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z;
    });
    return corners;
}

std::uint64_t hash_of(const TriangleCorners& corners) {
    std::uint64_t h = 0;
    for (const Vec3& p : corners) {
        for (int axis = 0; axis < 3; ++axis) {
            h ^= std::hash<double>{}(p[axis]) + 0x9e3779b97f4a7c15U + (h << 12) + (h >> 4);
            h *= 0xff51afd7ed558ccdU;
        }
    }
    return h ^ h >> 32;
}

// Triangles by the hash of their corners, so that equal ones of two meshes are found.
using TriangleHashes = std::vector<std::pair<std::uint64_t, std::uint32_t>>;

TriangleHashes triangle_hashes(const TriangleMesh& mesh) {
    TriangleHashes all(mesh.triangles.size());
    for (std::uint32_t t = 0; t < all.size(); ++t) all[t] = {hash_of(sorted_corners(mesh, t)), t};
    std::sort(all.begin(), all.end());
    return all;
}

// The triangles of `mesh` that `other` does not have; ascending.
std::vector<std::uint32_t> missing_in(const TriangleMesh& mesh, const TriangleHashes& hashes, const TriangleMesh& other,
                                      const TriangleHashes& other_hashes) {
    std::vector<std::uint32_t> missing;
    auto begin = other_hashes.begin();
    for (const auto& [hash, t] : hashes) {
        while (begin != other_hashes.end() && begin->first < hash) ++begin;
        bool is_there = false;
        for (auto it = begin; !is_there && it != other_hashes.end() && it->first == hash; ++it) {
            is_there = sorted_corners(mesh, t) == sorted_corners(other, it->second);
        }
        if (!is_there) missing.push_back(t);
    }
    std::sort(missing.begin(), missing.end());
    return missing;
}

// A part that is bounded by it need not be split.
double enough_for(const OneSidedDistance& result, const DistanceOptions& options) {
    return result.mm + std::max(options.tolerance * result.mm, options.tolerance_mm);
}

// Updates the largest distance found, and drops the parts that need not be split; at_most then bounds those.
void settle(OneSidedDistance& result, std::vector<TrianglePart>& open, const DistanceOptions& options) {
    for (const TrianglePart& part : open) {
        if (part.found <= result.mm) continue;
        result.mm = part.found;
        result.at = part.at;
    }
    const double enough = enough_for(result, options);
    std::erase_if(open, [&](const TrianglePart& part) {
        const bool is_settled = part.at_most <= enough;
        if (is_settled) result.at_most = std::max(result.at_most, part.at_most);
        return is_settled;
    });
}

}  // namespace

OneSidedDistance one_sided_distance(const TriangleMesh& from, std::span<const std::uint32_t> triangles,
                                    const TriangleMesh& to, const DistanceOptions& options, const Context& context) {
    OneSidedDistance result;
    result.triangles = triangles.size();
    if (triangles.empty()) return result;
    if (to.triangles.empty()) {
        result.mm = result.at_most = infinite;
        return result;
    }
    const TriangleTree tree(to);
    const auto compute_all = [&](std::vector<TrianglePart>& parts) {
        context.check_cancelled();
        const double enough = enough_for(result, options);
        parallel_for(0, parts.size(), [&](std::size_t i) { compute_bounds(parts[i], tree, to, enough); });
        settle(result, parts, options);
    };
    // In chunks: most triangles are settled at once, so that few have to be kept.
    std::vector<TrianglePart> open;
    for (std::size_t begin = 0; begin < triangles.size(); begin += chunk) {
        std::vector<TrianglePart> some(std::min(chunk, triangles.size() - begin));
        for (std::size_t i = 0; i < some.size(); ++i) some[i].corner = corners_of(from, triangles[begin + i]);
        compute_all(some);
        open.insert(open.end(), some.begin(), some.end());
    }
    settle(result, open, options);
    std::size_t points = 3 * triangles.size();
    while (!open.empty() && points < options.max_points) {
        std::vector<TrianglePart> smaller;
        smaller.reserve(4 * open.size());
        for (const TrianglePart& part : open) {
            for (const TrianglePart& quarter : split(part)) smaller.push_back(quarter);
        }
        open = std::move(smaller);
        compute_all(open);
        points += 3 * open.size();
    }
    for (const TrianglePart& part : open) result.at_most = std::max(result.at_most, part.at_most);
    result.at_most = std::max(result.at_most, result.mm);
    return result;
}

Deviation deviation(const TriangleMesh& scan, const TriangleMesh& result, const DistanceOptions& options,
                    const Context& context) {
    std::vector<std::uint32_t> gone;
    std::vector<std::uint32_t> made;
    {
        const TriangleHashes in_scan = triangle_hashes(scan);
        const TriangleHashes in_result = triangle_hashes(result);
        gone = missing_in(scan, in_scan, result, in_result);
        made = missing_in(result, in_result, scan, in_scan);
    }
    Deviation found;
    found.from_scan = one_sided_distance(scan, gone, result, options, context);
    found.from_result = one_sided_distance(result, made, scan, options, context);
    return found;
}

}  // namespace qchopper
