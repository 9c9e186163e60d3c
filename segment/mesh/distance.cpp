// Branch and bound over the triangles, after M. Guthe, P. Borodin and R. Klein, "Fast and accurate Hausdorff distance
// calculation between meshes" (2005): a triangle whose bound stays below the distance found is dropped, the others are
// split in four. farthest_sample samples faces, as P. Cignoni, C. Rocchini and R. Scopigno do in "Metro: measuring
// error on simplified surfaces" (1998), but for faces of which no sample can be the farthest. O(log triangles) per
// point on average; a triangle tree of `to` in memory.

#include "segment/mesh/distance.h"

#include <algorithm>
#include <array>
#include <atomic>
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

// The distance to one triangle of the other surface is convex: where that triangle is nearest to all corners, no inner
// point is farther than a corner. Otherwise no point is farther than a corner's distance plus its distance from that
// corner.
void compute_bounds(TrianglePart& part, const TriangleTree& tree, const TriangleMesh& to) {
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
    for (std::size_t k = 0; k < 3; ++k) {
        longest_edge = std::max(longest_edge, norm(part.corner[(k + 1) % 3] - part.corner[k]));
        const TriangleCorners target = corners_of(to, nearest[k].triangle);
        double above = 0;
        for (const Vec3& corner : part.corner) {
            above = std::max(above, norm(corner - closest_on_triangle(corner, target)));
        }
        by_plane = std::min(by_plane, above);
    }
    // In a right or obtuse triangle the point farthest from all corners lies on the longest edge, at half of it. In an
    // acute one it is the circumcentre, at most the longest edge divided by the root of three away.
    part.at_most = std::max(part.found, std::min(part.found + 0.578 * longest_edge, by_plane));
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

// Updates the largest distance found, and drops the parts that need not be split; at_most then bounds those.
void settle(Farthest& result, std::vector<TrianglePart>& open, const DistanceOptions& options) {
    for (const TrianglePart& part : open) {
        if (part.found <= result.mm) continue;
        result.mm = part.found;
        result.at = part.at;
    }
    const double enough = result.mm + std::max(options.tolerance * result.mm, options.tolerance_mm);
    std::erase_if(open, [&](const TrianglePart& part) {
        const bool is_settled = part.at_most <= enough;
        if (is_settled) result.at_most = std::max(result.at_most, part.at_most);
        return is_settled;
    });
}

double longest_side(const TriangleCorners& p) {
    return std::max({norm(p[1] - p[0]), norm(p[2] - p[1]), norm(p[0] - p[2])});
}

double mean_longest_side(const TriangleMesh& mesh) {
    double sum = 0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) sum += longest_side(corners_of(mesh, t));
    return sum / static_cast<double>(mesh.triangles.size());
}

// A triangle, and its box grown by about the largest distance, in the coordinates of the tree.
struct NearTriangle {
    FloatBox box;
    std::uint32_t triangle = 0;
};

// The largest distance of the samples of the faces added, or `mm` if none is larger. A sample closer than that to any
// triangle cannot change it. If all corners of a face are that close to one triangle, none of its samples can, because
// the distance to a triangle is convex. So it is with nearly all, and few are searched for in the tree. The triangles
// that are tried are those around the face; what is found does not depend on them.
class LargestDistance {
 public:
    // `rounding` in mm is more than the error of any distance.
    LargestDistance(const TriangleMesh& to, const TriangleTree& tree, double mm, double rounding)
        : to_(to), tree_(tree), mm_(mm), rounding_(rounding) {}

    // A grid of n steps along each side, and the middles of its upright cells.
    void add_face(const TriangleCorners& p, int n) {
        constexpr int steps_at_once = 5;
        if (is_covered(p, last_)) return;
        const Vec3 u = (1.0 / n) * (p[1] - p[0]);
        const Vec3 v = (1.0 / n) * (p[2] - p[0]);
        const int tiles = (n + steps_at_once - 1) / steps_at_once;
        if (tiles == 1) {
            list_near(p, p[0]);
            if (!is_covered(p, near_)) add_tile(p[0], u, v, n, {0, 0, n + 1});
            return;
        }
        const int size = n / tiles + 1;
        const double steps = size;
        for (int i = 0; i <= n; i += size) {
            for (int k = 0; i + k <= n; k += size) {
                const Vec3 a = p[0] + static_cast<double>(i) * u + static_cast<double>(k) * v;
                list_near({a, a + steps * u, a + steps * v}, a + steps * (u + v));
                add_tile(p[0], u, v, n, {i, k, size});
            }
        }
    }

    double mm() const { return mm_; }

 private:
    double squared_distance(Vec3 p, const NearTriangle& near) const {
        const Vec3 away = closest_on_triangle(p, corners_of(to_, near.triangle)) - p;
        return dot(away, away);
    }

    bool is_covered(const TriangleCorners& face, const std::vector<NearTriangle>& by) {
        const double limit = mm_ - rounding_;
        if (limit <= 0) return false;
        std::array<FloatBox, 3> at;
        for (std::size_t k = 0; k < 3; ++k) at[k] = tree_.box_of({face[k], face[k], face[k]});
        for (std::size_t i = 0; i < by.size(); ++i) {
            if (!do_meet(at[0], by[i].box) || !do_meet(at[1], by[i].box) || !do_meet(at[2], by[i].box)) continue;
            const auto is_near = [&](Vec3 p) { return squared_distance(p, by[i]) <= limit * limit; };
            if (!std::all_of(face.begin(), face.end(), is_near)) continue;
            keep(by[i]);
            return true;
        }
        return false;
    }

    // Among the last ones that covered a face.
    void keep(NearTriangle triangle) {
        constexpr std::size_t most = 8;
        const auto same = std::find_if(last_.begin(), last_.end(),
                                       [&](const NearTriangle& other) { return other.triangle == triangle.triangle; });
        if (same != last_.end()) return std::iter_swap(same, last_.begin());
        if (last_.size() == most) last_.pop_back();
        last_.insert(last_.begin(), triangle);
    }

    // A part of the grid of a face: the fewer triangles are around, the faster.
    struct Tile {
        int i;
        int k;
        int size;
    };

    void add_tile(Vec3 origin, Vec3 u, Vec3 v, int n, const Tile& tile) {
        for (int i = tile.i; i < std::min(tile.i + tile.size, n + 1); ++i) {
            for (int k = tile.k; k < std::min(tile.k + tile.size, n + 1 - i); ++k) {
                const Vec3 corner = origin + static_cast<double>(i) * u + static_cast<double>(k) * v;
                add(corner);
                if (i + k < n) add(corner + (1.0 / 3) * (u + v));
            }
        }
    }

    // Around four points.
    void list_near(const TriangleCorners& face, Vec3 fourth) {
        constexpr std::size_t most = 256;
        near_.clear();
        const auto by = static_cast<float>(0.5 * std::min(mm_, longest_side(face)));
        FloatBox around = grown(tree_.box_of(face), by);
        const FloatBox more = grown(tree_.box_of({fourth, fourth, fourth}), by);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            around.min[axis] = std::min(around.min[axis], more.min[axis]);
            around.max[axis] = std::max(around.max[axis], more.max[axis]);
        }
        tree_.for_each_place_near(around, [&](std::size_t place) {
            if (near_.size() == most) return;
            near_.push_back({grown(tree_.of_triangle[place], by), tree_.order[place]});
        });
    }

    static FloatBox grown(FloatBox box, float by) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            box.min[axis] -= by;
            box.max[axis] += by;
        }
        return box;
    }

    void add(Vec3 p) {
        const FloatBox at = tree_.box_of({p, p, p});
        double least = infinite;
        for (std::size_t i = 0; i < near_.size(); ++i) {
            if (!do_meet(at, near_[i].box)) continue;
            const double squared = squared_distance(p, near_[i]);
            if (squared <= mm_ * mm_) return std::swap(near_[i], near_[0]);
            least = std::min(least, squared);
        }
        const TriangleTree::Nearest found = tree_.nearest(to_, p, std::sqrt(least) + rounding_);
        mm_ = std::max(mm_, found.distance);
    }

    const TriangleMesh& to_;
    const TriangleTree& tree_;
    std::vector<NearTriangle> near_;  // around the face
    std::vector<NearTriangle> last_;  // that covered the last faces
    double mm_ = 0;
    double rounding_ = 0;
};

}  // namespace

Farthest farthest(const TriangleMesh& from, std::span<const std::uint32_t> triangles, const TriangleMesh& to,
                  const DistanceOptions& options, const Context& context) {
    Farthest result;
    result.triangles = triangles.size();
    if (triangles.empty()) return result;
    if (to.triangles.empty()) {
        result.mm = result.at_most = infinite;
        return result;
    }
    const TriangleTree tree(to);
    const auto compute_all = [&](std::vector<TrianglePart>& parts) {
        context.check_cancelled();
        parallel_for(0, parts.size(), [&](std::size_t i) { compute_bounds(parts[i], tree, to); });
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
    while (!open.empty() && points < options.most_points) {
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
    found.from_scan = farthest(scan, gone, result, options, context);
    found.from_result = farthest(result, made, scan, options, context);
    return found;
}

double farthest_sample(const TriangleMesh& from, const TriangleMesh& to, const Context& context) {
    constexpr int most_steps = 200;
    constexpr std::size_t faces_at_once = 1024;
    constexpr std::size_t first_faces = 64;
    const double spacing = mean_longest_side(to);
    const TriangleTree tree(to);
    const Box box = bounds(to);
    const double rounding = 1e-10 * (norm(box.min) + norm(box.max));
    std::atomic<double> farthest_mm{0};
    const auto sample_faces = [&](std::size_t first, std::size_t end, std::size_t stride) {
        context.check_cancelled();
        LargestDistance largest(to, tree, farthest_mm.load(), rounding);
        for (std::size_t t = first; t < end; t += stride) {
            const TriangleCorners corners = corners_of(from, t);
            const double steps = std::ceil(longest_side(corners) / std::max(spacing, 1e-12));
            largest.add_face(corners, std::clamp(static_cast<int>(std::min(steps, 1e6)), 2, most_steps));
        }
        double before = farthest_mm.load();
        while (before < largest.mm() && !farthest_mm.compare_exchange_weak(before, largest.mm())) {
        }
    };
    // Some faces first: the larger the distance that is known, the less is searched for.
    sample_faces(0, from.triangles.size(), from.triangles.size() / first_faces + 1);
    parallel_ranges(0, from.triangles.size(), faces_at_once,
                    [&](std::size_t first, std::size_t end) { sample_faces(first, end, 1); });
    return farthest_mm.load();
}

}  // namespace qchopper
