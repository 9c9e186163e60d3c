// Quadric errors weighted by area: M. Garland and P. Heckbert, "Surface simplification using quadric error metrics"
// (1997). Instead of a queue, passes: the errors of all points are computed and sorted once, and edges without a common
// point collapse in that order, as in A. Kapoulkine's meshoptimizer (2016-2022). The link condition keeps the surface
// manifold: T. Dey, H. Edelsbrunner, S. Guha and D. Nekhayev, "Topology preserving edge contraction" (1999). O(n) a
// pass for n faces; while a pass removes a fixed share of the points, O(n) in all. 200 bytes a point in memory.
//
// Why not meshoptimizer itself: it turns faces by up to 90 degrees, makes needles and moves to single precision; here
// no face turns by more than 60 degrees, caps stay and no point moves, at the same time. Why not the queue of
// collapse.h alone: two minutes in place of seconds for 1.9 million faces. The order is nearly that of the queue;
// deviations are 0.91 to 1.22 times the queue's, which is still taken where the passes miss the number and for a given
// deviation.

#include "segment/simplify/collapse_passes.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>
#include <utility>

#include "base/parallel.h"
#include "segment/simplify/sound_face.h"

namespace qchopper {
namespace {

constexpr std::uint32_t no_number = std::numeric_limits<std::uint32_t>::max();
constexpr float never = std::numeric_limits<float>::infinity();

// The squared distances to planes, each times the area of its face: p A p + 2 b p + c.
struct PlaneQuadric {
    double xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;  // A
    double x = 0, y = 0, z = 0;                             // b
    double c = 0;

    double at(Vec3 p) const {
        return p.x * (xx * p.x + 2 * (xy * p.y + xz * p.z + x)) + p.y * (yy * p.y + 2 * (yz * p.z + y)) +
               p.z * (zz * p.z + 2 * z) + c;
    }
    PlaneQuadric& operator+=(const PlaneQuadric& q) {
        xx += q.xx, xy += q.xy, xz += q.xz, yy += q.yy, yz += q.yz, zz += q.zz;
        x += q.x, y += q.y, z += q.z;
        c += q.c;
        return *this;
    }
};

PlaneQuadric quadric_of(const std::array<Vec3, 3>& corner) {
    const Vec3 across = cross(corner[1] - corner[0], corner[2] - corner[0]);
    const double length = norm(across);
    if (!(length > 0)) return {};
    const Vec3 n = (1 / length) * across;
    const Vec3 m = 0.5 * across;  // n times the area
    const double d = -dot(n, corner[0]);
    return {n.x * m.x, n.x * m.y, n.x * m.z, n.y * m.y, n.y * m.z,
            n.z * m.z, d * m.x,   d * m.y,   d * m.z,   0.5 * length * d * d};
}

// A point, and the error of all points that collapsed to it.
struct CollapsePoint {
    Vec3 at;
    double error = 0;
};

// The other two corners of a face of a point, in its orientation.
struct FanFace {
    std::uint32_t next;
    std::uint32_t last;
};

// Between passes, `triangles` has the faces that are left; `points` may have some without a face. In a pass the faces
// stay as they were, and `becomes` maps the points that are gone. A point that is an end of a collapse is used: no
// other collapse of the pass has it as an end, so the list of faces of every unused point is complete, and its corners
// only have to be mapped.
class CollapsePasses {
 public:
    CollapsePasses(const TriangleMesh& mesh, const std::vector<std::uint8_t>& is_locked);

    std::size_t faces() const { return triangles_.size(); }
    std::size_t points() const { return 2 + triangles_.size() / 2; }  // about
    // Collapses up to `most` edges, of the `share` cheapest points. Returns how many.
    std::size_t pass(std::size_t most, std::size_t share, const Context& context);
    TriangleMesh result();

 private:
    void list_fans();
    void compute_costs();
    std::vector<std::uint32_t> cheapest(std::size_t share);
    bool collapse(std::uint32_t from);
    void list_ring(std::uint32_t of);
    bool stays_manifold(std::uint32_t to);
    bool stays_sound(std::uint32_t from, std::uint32_t to) const;
    void map_faces();
    void drop_points();

    std::span<const FanFace> fan(std::uint32_t point) const {
        return std::span(fans_).subspan(first_[point], first_[point + 1] - first_[point]);
    }
    double cost(std::uint32_t from, std::uint32_t to) const {
        return std::max(0.0, quadrics_[from].at(points_[to].at)) + points_[to].error;
    }

    std::vector<CollapsePoint> points_;
    std::vector<PlaneQuadric> quadrics_;
    std::vector<std::uint8_t> is_locked_;
    std::vector<Triangle> triangles_;
    std::vector<std::int32_t> cap_of_;

    std::vector<std::uint32_t> first_;  // fan of each point in fans_
    std::vector<FanFace> fans_;
    std::vector<float> costs_;  // least of each point
    float limit_ = never;       // no collapse of this pass costs more
    std::vector<std::uint32_t> becomes_;
    std::vector<std::uint8_t> is_used_;

    std::vector<FanFace> ring_;  // of the point that is to go, mapped
    std::vector<std::pair<double, std::uint32_t>> targets_;
    std::vector<std::uint32_t> mark_;  // mark_[i] == marked_: i is a neighbour of the other end
    std::uint32_t marked_ = 0;
};

CollapsePasses::CollapsePasses(const TriangleMesh& mesh, const std::vector<std::uint8_t>& is_locked)
    : points_(mesh.points.size()),
      quadrics_(mesh.points.size()),
      is_locked_(is_locked),
      triangles_(mesh.triangles),
      cap_of_(mesh.cap_of),
      mark_(mesh.points.size(), 0) {
    is_locked_.resize(mesh.points.size(), 0);
    for (std::size_t i = 0; i < mesh.points.size(); ++i) points_[i].at = mesh.points[i];
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const PlaneQuadric q = quadric_of(corners_of(mesh, t));
        for (const std::uint32_t corner : mesh.triangles[t]) quadrics_[corner] += q;
    }
}

void CollapsePasses::list_fans() {
    first_.assign(points_.size() + 2, 0);
    for (const Triangle& t : triangles_) {
        for (const std::uint32_t corner : t) ++first_[corner + 2];
    }
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    fans_.resize(3 * triangles_.size());
    for (const Triangle& t : triangles_) {
        for (std::size_t k = 0; k < 3; ++k) fans_[first_[t[k] + 1]++] = {t[(k + 1) % 3], t[(k + 2) % 3]};
    }
    first_.pop_back();
}

void CollapsePasses::compute_costs() {
    costs_.resize(points_.size());
    parallel_ranges(0, points_.size(), 4096, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const auto point = static_cast<std::uint32_t>(i);
            double least = never;
            if (is_locked_[i] == 0) {
                for (const FanFace& face : fan(point)) least = std::min(least, cost(point, face.next));
            }
            costs_[i] = static_cast<float>(least);
        }
    });
}

// Sorted by the exponent and the first bits of the cost, and by number: points that are close to each other in memory
// remain so. Sets the limit.
std::vector<std::uint32_t> CollapsePasses::cheapest(std::size_t share) {
    constexpr int shift = 21;  // of the 23 bits of the fraction: two bits remain
    const auto class_of = [](float cost) { return std::bit_cast<std::uint32_t>(cost) >> shift; };
    std::vector<std::size_t> place(class_of(never) + 2, 0);
    for (const float cost : costs_) ++place[class_of(cost) + 1];
    place.pop_back();  // points that cannot collapse
    std::partial_sum(place.begin(), place.end(), place.begin());
    const auto classes =
        static_cast<std::uint32_t>(std::lower_bound(place.begin(), place.end() - 1, share) - place.begin());
    limit_ = std::bit_cast<float>(classes << shift);
    std::vector<std::uint32_t> order(place[classes]);
    for (std::size_t i = 0; i < costs_.size(); ++i) {
        if (class_of(costs_[i]) < classes) order[place[class_of(costs_[i])]++] = static_cast<std::uint32_t>(i);
    }
    return order;
}

void CollapsePasses::list_ring(std::uint32_t of) {
    ring_.clear();
    for (const FanFace& face : fan(of)) {
        const FanFace now{becomes_[face.next], becomes_[face.last]};
        if (now.next != now.last) ring_.push_back(now);
    }
}

// Both ends have two neighbours in common, the corners opposite of the edge, and the surface is no tetrahedron.
bool CollapsePasses::stays_manifold(std::uint32_t to) {
    ++marked_;
    std::size_t neighbours = 0;
    for (const FanFace& face : fan(to)) {
        const std::uint32_t next = becomes_[face.next];
        if (next == becomes_[face.last]) continue;
        mark_[next] = marked_;
        ++neighbours;
    }
    const auto common =
        std::count_if(ring_.begin(), ring_.end(), [&](const FanFace& face) { return mark_[face.next] == marked_; });
    return common == 2 && (ring_.size() > 3 || neighbours > 3);
}

bool CollapsePasses::stays_sound(std::uint32_t from, std::uint32_t to) const {
    return std::all_of(ring_.begin(), ring_.end(), [&](const FanFace& face) {
        if (face.next == to || face.last == to) return true;
        const Vec3 a = points_[face.next].at;
        const Vec3 b = points_[face.last].at;
        return is_sound_change({points_[from].at, a, b}, {points_[to].at, a, b});
    });
}

// To the neighbour that costs least of those that may be taken.
bool CollapsePasses::collapse(std::uint32_t from) {
    if (is_used_[from] != 0) return false;
    list_ring(from);
    targets_.clear();
    for (const FanFace& face : ring_) {
        if (is_used_[face.next] != 0) continue;
        const double needed = cost(from, face.next);
        if (needed < limit_) targets_.emplace_back(needed, face.next);
    }
    std::sort(targets_.begin(), targets_.end());
    for (const auto& [needed, to] : targets_) {
        if (!stays_sound(from, to) || !stays_manifold(to)) continue;
        becomes_[from] = to;
        is_used_[from] = is_used_[to] = 1;
        quadrics_[to] += quadrics_[from];
        points_[to].error = needed;
        return true;
    }
    return false;
}

void CollapsePasses::map_faces() {
    std::size_t kept = 0;
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
        const Triangle& old = triangles_[t];
        const Triangle now{becomes_[old[0]], becomes_[old[1]], becomes_[old[2]]};
        if (now[0] == now[1] || now[1] == now[2] || now[2] == now[0]) continue;
        if (!cap_of_.empty()) cap_of_[kept] = cap_of_[t];
        triangles_[kept++] = now;
    }
    triangles_.resize(kept);
    if (!cap_of_.empty()) cap_of_.resize(kept);
}

void CollapsePasses::drop_points() {
    std::vector<std::uint32_t> number(points_.size(), no_number);
    for (const Triangle& t : triangles_) {
        for (const std::uint32_t corner : t) number[corner] = 0;
    }
    std::uint32_t kept = 0;
    for (std::size_t i = 0; i < points_.size(); ++i) {
        if (number[i] == no_number) continue;
        points_[kept] = points_[i];
        quadrics_[kept] = quadrics_[i];
        is_locked_[kept] = is_locked_[i];
        number[i] = kept++;
    }
    points_.resize(kept);
    quadrics_.resize(kept);
    is_locked_.resize(kept);
    for (Triangle& t : triangles_) {
        for (std::uint32_t& corner : t) corner = number[corner];
    }
}

std::size_t CollapsePasses::pass(std::size_t most, std::size_t share, const Context& context) {
    list_fans();
    compute_costs();
    becomes_.resize(points_.size());
    std::iota(becomes_.begin(), becomes_.end(), 0U);
    is_used_.assign(points_.size(), 0);
    std::size_t collapsed = 0;
    std::size_t tried = 0;
    for (const std::uint32_t point : cheapest(share)) {
        if (collapsed == most) break;
        if (++tried % 65536 == 0) context.check_cancelled();
        if (collapse(point)) ++collapsed;
    }
    map_faces();
    if (2 * points() < points_.size()) drop_points();
    return collapsed;
}

TriangleMesh CollapsePasses::result() {
    drop_points();
    TriangleMesh mesh;
    for (const CollapsePoint& point : points_) mesh.points.push_back(point.at);
    mesh.triangles = std::move(triangles_);
    mesh.cap_of = std::move(cap_of_);
    return mesh;
}

}  // namespace

TriangleMesh collapse_in_passes(const TriangleMesh& mesh, const std::vector<std::uint8_t>& is_locked,
                                std::size_t max_faces, const Context& context) {
    constexpr double share_of_points = 0.35;
    CollapsePasses passes(mesh, is_locked);
    std::size_t removed = 0;
    double room = 1;  // more where a pass has found little
    while (passes.faces() > max_faces) {
        context.check_cancelled();
        context.progress("points removed", removed, mesh.points.size());
        const std::size_t most = (passes.faces() - max_faces + 1) / 2;
        const std::size_t all = passes.points();
        const double share =
            room * std::min(share_of_points * static_cast<double>(all), 1.5 * static_cast<double>(most));
        const bool is_whole = share >= static_cast<double>(all);
        const std::size_t made = passes.pass(most, is_whole ? all : static_cast<std::size_t>(share) + 1, context);
        removed += made;
        if (is_whole && (made == 0 || 1000 * made < std::min(most, all))) break;
        room = 20 * made < std::min(most, all) ? 4 * room : 1;
    }
    return passes.result();
}

}  // namespace qchopper
