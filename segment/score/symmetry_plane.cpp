// The directions are asked with few of the points first, and what remains with more of them. A point is compared with
// the nearest of the points on the other side of the plane, found in a k-d tree: O(points log points) for the tree,
// some 600,000 queries of O(log points) in all.

#include "segment/score/symmetry_plane.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "base/parallel.h"
#include "segment/mesh/solids.h"
#include "segment/score/surface_samples.h"
#include "segment/score/tool_directions.h"

namespace qchopper {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double scored_share = 0.9;   // of the distances
constexpr double matched_share = 0.8;  // of the pairs

// How well matches are looked for.
struct Matching {
    std::size_t every = 1;      // n-th of the points is matched
    double within = 1;          // a match may be so many times as far as the nearest point
    double enough_turn = 5e-5;  // of the normal, in radians: a smaller one ends matching and fitting
};

// Points in a k-d tree without pointers: the middle one of a range divides it along the axis in which it is longest.
class PointTree {
 public:
    explicit PointTree(std::vector<Vec3> points) : points_(std::move(points)), axis_(points_.size()) {
        divide(0, points_.size());
    }

    const std::vector<Vec3>& points() const { return points_; }

    struct Found {
        double distance2 = infinite;
        std::size_t point = 0;
    };
    // The nearest of the points that lie above the plane, or of those that do not. `near`: one of them, the match of a
    // point nearby, which limits the search from the start; or none, of infinite distance.
    Found nearest(Vec3 p, const Plane& plane, bool above, const Found& near, double within) const {
        Found found = near;
        if (near.distance2 < infinite) {
            const Vec3 away = points_[near.point] - p;
            found.distance2 = dot(away, away);
        }
        search({p, plane, above, within * within}, 0, points_.size(), {}, found);
        return found;
    }

 private:
    static constexpr std::size_t per_leaf = 8;
    struct Query {
        Vec3 point;
        Plane plane;
        bool above;
        double within2;
    };

    void divide(std::size_t begin, std::size_t end) {
        if (end - begin <= per_leaf) return;
        Box box{points_[begin], points_[begin]};
        for (std::size_t i = begin; i < end; ++i) {
            for (int a = 0; a < 3; ++a) {
                box.min[a] = std::min(box.min[a], points_[i][a]);
                box.max[a] = std::max(box.max[a], points_[i][a]);
            }
        }
        int axis = 0;
        for (int a = 1; a < 3; ++a) axis = box.size()[a] > box.size()[axis] ? a : axis;
        const std::size_t middle = begin + (end - begin) / 2;
        const auto at = [&](std::size_t i) { return points_.begin() + static_cast<std::ptrdiff_t>(i); };
        std::nth_element(at(begin), at(middle), at(end), [axis](Vec3 a, Vec3 b) { return a[axis] < b[axis]; });
        axis_[middle] = static_cast<std::uint8_t>(axis);
        divide(begin, middle);
        divide(middle + 1, end);
    }

    void compare(const Query& query, std::size_t i, Found& found) const {
        const Vec3 away = points_[i] - query.point;
        const double distance2 = dot(away, away);
        if (distance2 < found.distance2 && (height(query.plane.normal, points_[i]) > query.plane.offset) == query.above)
            found = {distance2, i};
    }

    // `off`: along each axis at least so far the point lies outside the range (S. Arya and D. M. Mount, Algorithms for
    // fast vector quantization, 1993).
    void search(const Query& query, std::size_t begin, std::size_t end, Vec3 off, Found& found) const {
        if (end - begin <= per_leaf) {
            for (std::size_t i = begin; i < end; ++i) compare(query, i, found);
            return;
        }
        const std::size_t middle = begin + (end - begin) / 2;
        const int axis = axis_[middle];
        const double away = query.point[axis] - points_[middle][axis];
        if (away < 0)
            search(query, begin, middle, off, found);
        else
            search(query, middle + 1, end, off, found);
        off[axis] = away;
        if (query.within2 * dot(off, off) >= found.distance2) return;
        compare(query, middle, found);
        if (away < 0)
            search(query, middle + 1, end, off, found);
        else
            search(query, begin, middle, off, found);
    }

    std::vector<Vec3> points_;
    std::vector<std::uint8_t> axis_;  // of the middle of a range that is divided
};

// A point, and the nearest one on the other side of the plane to its mirror image.
struct Pair {
    Vec3 point;
    Vec3 match;
    double distance2 = 0;
};

// Pairs of every n-th point. None where all points lie on one side.
std::vector<Pair> matched(const PointTree& tree, const Plane& plane, const Matching& how) {
    std::vector<Pair> pairs;
    pairs.reserve(tree.points().size() / how.every + 1);
    std::array<PointTree::Found, 2> last;  // below, above; points are near to those before them in the tree
    for (std::size_t i = 0; i < tree.points().size(); i += how.every) {
        const Vec3 p = tree.points()[i];
        const bool is_above = height(plane.normal, p) > plane.offset;
        PointTree::Found& found = last[is_above ? 0 : 1];
        found = tree.nearest(reflected(p, plane), plane, !is_above, found, how.within);
        if (found.distance2 == infinite) return {};
        pairs.push_back({p, tree.points()[found.point], found.distance2});
    }
    return pairs;
}

std::size_t share_of(std::size_t count, double share) {
    return std::max<std::size_t>(1, static_cast<std::size_t>(share * static_cast<double>(count)));
}

void keep_closest(std::vector<Pair>& pairs, double share) {
    if (pairs.empty()) return;
    const std::size_t kept = share_of(pairs.size(), share);
    std::nth_element(pairs.begin(), pairs.begin() + static_cast<std::ptrdiff_t>(kept) - 1, pairs.end(),
                     [](const Pair& a, const Pair& b) { return a.distance2 < b.distance2; });
    pairs.resize(kept);
}

double score(const PointTree& tree, const Plane& plane, const Matching& how) {
    std::vector<Pair> pairs = matched(tree, plane, how);
    if (pairs.empty()) return infinite;
    keep_closest(pairs, scored_share);
    double sum = 0;
    for (const Pair& pair : pairs) sum += std::sqrt(pair.distance2);
    return sum / static_cast<double>(pairs.size());
}

using Matrix = std::array<Vec3, 3>;  // symmetric, by rows

// Jacobi's rotations, each of which makes one pair of elements beside the diagonal zero.
Vec3 least_eigenvector(Matrix m) {
    constexpr int sweeps = 12;  // their size falls as the square from one to the next
    Matrix vectors{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
    for (int sweep = 0; sweep < sweeps; ++sweep) {
        for (const auto& [p, q] : {std::pair{0, 1}, std::pair{0, 2}, std::pair{1, 2}}) {
            if (m[p][q] == 0) continue;
            const double angle = 0.5 * std::atan2(2 * m[p][q], m[q][q] - m[p][p]);
            const double c = std::cos(angle);
            const double s = std::sin(angle);
            for (int k = 0; k < 3; ++k) {
                const Vec3 column{m[k][p], m[k][q], 0};
                m[k][p] = c * column.x - s * column.y;
                m[k][q] = s * column.x + c * column.y;
            }
            const Vec3 row = m[p];
            m[p] = c * row - s * m[q];
            m[q] = s * row + c * m[q];
            const Vec3 vector = vectors[p];
            vectors[p] = c * vector - s * vectors[q];
            vectors[q] = s * vector + c * vectors[q];
        }
    }
    int least = 0;
    for (int k = 1; k < 3; ++k) least = m[k][k] < m[least][least] ? k : least;
    return normalized(vectors[least]);
}

// The plane for which the squared distances of mirror images from their matches add up to least. With heights a and b
// of point and match over it, the squared distance is that of the points themselves plus 4 a b: so the plane goes
// through the centroid c of all, and its normal n makes the sum of (n.(p - c)) (n.(q - c)) least, an eigenvector.
Plane fitted(const std::vector<Pair>& pairs) {
    Vec3 sum;
    for (const Pair& pair : pairs) sum = sum + pair.point + pair.match;
    const Vec3 centre = (0.5 / static_cast<double>(pairs.size())) * sum;
    Matrix products{};
    for (const Pair& pair : pairs) {
        const Vec3 p = pair.point - centre;
        const Vec3 q = pair.match - centre;
        for (int i = 0; i < 3; ++i) {
            for (int j = 0; j < 3; ++j) products[i][j] += 0.5 * (p[i] * q[j] + p[j] * q[i]);
        }
    }
    const Vec3 n = least_eigenvector(products);
    return canonical({n, dot(n, centre)});
}

Plane refined(const PointTree& tree, Plane plane, const Matching& how, int turns) {
    for (int turn = 0; turn < turns; ++turn) {
        std::vector<Pair> pairs = matched(tree, plane, how);
        if (pairs.empty()) return plane;
        keep_closest(pairs, matched_share);
        const Plane before = plane;
        plane = fitted(pairs);
        if (norm(plane.normal - before.normal) < how.enough_turn) return plane;
    }
    return plane;
}

struct Scored {
    Plane plane;
    double score = infinite;
};

// Scores the planes with every n-th point and keeps so many of the best. Of equal scores the earlier plane is better.
void keep_best(std::vector<Scored>& planes, const PointTree& tree, const Matching& how, std::size_t kept) {
    parallel_for(0, planes.size(), [&](std::size_t i) { planes[i].score = score(tree, planes[i].plane, how); });
    std::stable_sort(planes.begin(), planes.end(), [](const Scored& a, const Scored& b) { return a.score < b.score; });
    planes.resize(std::min(planes.size(), kept));
}

void refine(std::vector<Scored>& planes, const PointTree& tree, const Matching& how, int turns) {
    parallel_for(0, planes.size(),
                 [&](std::size_t i) { planes[i].plane = refined(tree, planes[i].plane, how, turns); });
}

// The triangles of solids whose area is too small. Empty: none.
std::vector<bool> small_solids(const TriangleMesh& scan, double least_share) {
    const Shells found = shells(scan);
    if (found.count() < 2) return {};
    const std::vector<std::uint32_t> solid = solid_of_triangle(found, solids(scan, found, {0, 0, 1}));
    std::vector<double> area(*std::max_element(solid.begin(), solid.end()) + 1);
    for (std::size_t t = 0; t < solid.size(); ++t) area[solid[t]] += norm(area_vector(scan, t));
    const double least = least_share * *std::max_element(area.begin(), area.end());
    std::vector<bool> is_small(solid.size());
    for (std::size_t t = 0; t < solid.size(); ++t) is_small[t] = area[solid[t]] < least;
    return is_small;
}

Vec3 centroid(const std::vector<Vec3>& points) {
    const Vec3 sum = std::accumulate(points.begin(), points.end(), Vec3{});
    return (1 / static_cast<double>(points.size())) * sum;
}

}  // namespace

Vec3 reflected(Vec3 point, const Plane& mirror) {
    return point - 2 * (height(mirror.normal, point) - mirror.offset) * mirror.normal;
}

Plane reflected(const Plane& plane, const Plane& mirror) {
    const Vec3 normal = normalized(plane.normal - 2 * dot(plane.normal, mirror.normal) * mirror.normal);
    return canonical({normal, dot(normal, reflected(plane.offset * plane.normal, mirror))});
}

double symmetry_score(std::span<const Vec3> points, const Plane& plane) {
    std::vector<double> distances;
    for (const Vec3& p : points) {
        const bool is_above = height(plane.normal, p) > plane.offset;
        double least = infinite;
        for (const Vec3& q : points) {
            if ((height(plane.normal, q) > plane.offset) == is_above) continue;
            least = std::min(least, norm(q - reflected(p, plane)));
        }
        distances.push_back(least);
    }
    if (distances.empty()) return infinite;
    std::sort(distances.begin(), distances.end());
    const std::size_t kept = share_of(distances.size(), scored_share);
    return std::accumulate(distances.begin(), distances.begin() + static_cast<std::ptrdiff_t>(kept), 0.0) /
           static_cast<double>(kept);
}

std::optional<SymmetryPlane> symmetry_plane(const TriangleMesh& scan, const SymmetryOptions& options) {
    const SampledSurface surface{&scan, small_solids(scan, options.least_solid_area)};
    const SurfaceSamples samples = surface_samples({&surface, 1}, options.points);
    std::vector<Vec3> points;
    for (const SurfaceSample& sample : samples.sample) points.push_back(sample.point);
    if (points.size() < 4) return std::nullopt;
    const Vec3 centre = centroid(points);
    const PointTree tree(std::move(points));
    std::vector<Scored> planes;
    for (const Vec3& d : dense_directions(2 * options.directions)) {
        if (d.z > 0) planes.push_back({canonical({d, dot(d, centre)})});
    }
    // Points of a k-d tree in its order: every n-th of them are spread over the surface.
    const auto some = [&](std::size_t of, double within, double enough_turn) {
        return Matching{std::max<std::size_t>(1, options.points / of), within, enough_turn};
    };
    keep_best(planes, tree, some(250, 2, 0), planes.size() / 5);
    keep_best(planes, tree, some(1'000, 2, 0), 6 * options.refined);
    refine(planes, tree, some(400, 1.5, 2e-3), 10);
    keep_best(planes, tree, some(1'000, 1.5, 0), options.refined);
    refine(planes, tree, some(2'000, 1.2, 5e-4), 6);
    keep_best(planes, tree, some(2'500, 1, 0), 1);
    refine(planes, tree, {}, 8);
    keep_best(planes, tree, {}, 1);
    if (planes.front().score == infinite) return std::nullopt;
    return SymmetryPlane{planes.front().plane, planes.front().score, std::sqrt(samples.area_each_mm2)};
}

}  // namespace qchopper
