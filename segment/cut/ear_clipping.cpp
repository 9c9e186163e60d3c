// After Meisters 1975 (two ears) and Eberly 2002 (bridges). Where no ear is left, as on loops that cross themselves,
// the least bad corner is cut instead: the combinatorics, and so closedness, never depend on the geometry.

#include "segment/cut/ear_clipping.h"

#include <algorithm>
#include <limits>
#include <unordered_set>

namespace qchopper {
namespace {

double distance2(Point2 a, Point2 b) {
    return (a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y);
}

std::uint64_t edge_key(std::uint32_t a, std::uint32_t b) {
    return (static_cast<std::uint64_t>(std::min(a, b)) << 32) | std::max(a, b);
}

// Does the open segment p-q properly cross a-b?
bool crosses(Point2 p, Point2 q, Point2 a, Point2 b) {
    return (orientation(p, q, a) > 0) != (orientation(p, q, b) > 0) &&
           (orientation(a, b, p) > 0) != (orientation(a, b, q) > 0);
}

// Is the direction from a ring corner towards q inside the material there? A corner that a bridge has doubled stands
// in the ring twice, and only one of the two may be right.
bool opens_towards(std::span<const Point2> points, const Loop& ring, std::size_t at, Point2 q) {
    const Point2 a = points[ring[(at + ring.size() - 1) % ring.size()]];
    const Point2 b = points[ring[at]];
    const Point2 c = points[ring[(at + 1) % ring.size()]];
    const bool is_left_of_first = orientation(a, b, q) > 0;
    const bool is_left_of_second = orientation(b, c, q) > 0;
    return orientation(a, b, c) > 0 ? is_left_of_first && is_left_of_second : is_left_of_first || is_left_of_second;
}

bool is_clear_of(std::span<const Point2> points, const Loop& loop, Point2 p, Point2 q) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
        const Point2 a = points[loop[i]];
        const Point2 b = points[loop[(i + 1) % loop.size()]];
        if (a == p || a == q || b == p || b == q) continue;
        if (crosses(p, q, a, b)) return false;
    }
    return true;
}

// The ring position from which the hole is reached: the nearest one that is in sight, else the nearest.
std::size_t bridge_position(std::span<const Point2> points, const Loop& ring, Point2 from,
                            std::span<const Loop> holes) {
    std::vector<std::size_t> by_distance(ring.size());
    for (std::size_t i = 0; i < ring.size(); ++i) by_distance[i] = i;
    std::stable_sort(by_distance.begin(), by_distance.end(), [&](std::size_t a, std::size_t b) {
        return distance2(points[ring[a]], from) < distance2(points[ring[b]], from);
    });
    constexpr std::size_t tries = 64;  // in sight is almost always one of the first few
    for (std::size_t k = 0; k < std::min(tries, by_distance.size()); ++k) {
        const std::size_t at = by_distance[k];
        const Point2 to = points[ring[at]];
        if (opens_towards(points, ring, at, from) && is_clear_of(points, ring, from, to) &&
            std::all_of(holes.begin(), holes.end(), [&](const Loop& h) { return is_clear_of(points, h, from, to); })) {
            return at;
        }
    }
    return by_distance.front();
}

// Walks into the hole and back over the bridge, so that one ring remains. No bridge may pass any hole.
void bridge(std::span<const Point2> points, Loop& ring, const Loop& hole, std::span<const Loop> holes) {
    std::size_t start = 0;
    for (std::size_t i = 1; i < hole.size(); ++i) {
        if (points[hole[i]].x > points[hole[start]].x) start = i;
    }
    const std::size_t at = bridge_position(points, ring, points[hole[start]], holes);
    Loop detour;
    for (std::size_t i = 0; i <= hole.size(); ++i) detour.push_back(hole[(start + i) % hole.size()]);
    detour.push_back(ring[at]);
    ring.insert(ring.begin() + static_cast<std::ptrdiff_t>(at) + 1, detour.begin(), detour.end());
}

class EarCutter {
 public:
    EarCutter(std::span<const Point2> points, const Loop& ring) : points_(points), ring_(ring) {
        const std::size_t n = ring.size();
        next_.resize(n);
        previous_.resize(n);
        for (std::size_t i = 0; i < n; ++i) {
            next_[i] = (i + 1) % n;
            previous_[i] = (i + n - 1) % n;
            used_.insert(edge_key(ring[i], ring[(i + 1) % n]));
        }
    }

    std::vector<std::array<std::uint32_t, 3>> run() {
        std::vector<std::array<std::uint32_t, 3>> triangles;
        std::size_t left = ring_.size();
        std::size_t at = 0;
        std::size_t since_last_ear = 0;
        while (left > 3) {
            // After one fruitless round take the least bad corner.
            const bool is_forced = since_last_ear > left;
            if (is_forced) at = least_bad(at, left);
            if (is_forced || is_ear(at)) {
                triangles.push_back({ring_[previous_[at]], ring_[at], ring_[next_[at]]});
                used_.insert(edge_key(ring_[previous_[at]], ring_[next_[at]]));
                next_[previous_[at]] = next_[at];
                previous_[next_[at]] = previous_[at];
                --left;
                since_last_ear = 0;
                at = next_[next_[at]];  // skipping one spreads the ears and keeps triangles fat
            } else {
                ++since_last_ear;
                at = next_[at];
            }
        }
        triangles.push_back({ring_[previous_[at]], ring_[at], ring_[next_[at]]});
        return triangles;
    }

 private:
    Point2 point(std::size_t position) const { return points_[ring_[position]]; }

    // An edge that exists already would be used by more than two triangles.
    bool is_allowed(std::size_t at) const {
        const std::uint32_t a = ring_[previous_[at]];
        const std::uint32_t b = ring_[next_[at]];
        return a != b && !used_.contains(edge_key(a, b));
    }

    bool is_ear(std::size_t at) const {
        const Point2 a = point(previous_[at]);
        const Point2 b = point(at);
        const Point2 c = point(next_[at]);
        if (!is_allowed(at) || orientation(a, b, c) <= 0) return false;
        for (std::size_t i = next_[next_[at]]; i != previous_[at]; i = next_[i]) {
            const Point2 p = point(i);
            if (p == a || p == b || p == c) continue;
            if (orientation(a, b, p) >= 0 && orientation(b, c, p) >= 0 && orientation(c, a, p) >= 0) return false;
        }
        return true;
    }

    // The allowed corner that overlaps least: convex or flat ones first, small ones first.
    std::size_t least_bad(std::size_t start, std::size_t left) const {
        std::size_t best = start;
        double best_badness = std::numeric_limits<double>::infinity();
        std::size_t at = start;
        for (std::size_t i = 0; i < left; ++i, at = next_[at]) {
            if (ring_[previous_[at]] == ring_[next_[at]]) continue;
            const double area = orientation(point(previous_[at]), point(at), point(next_[at]));
            double badness = area >= 0 ? area : -1e6 * area;
            if (!is_allowed(at)) badness = std::numeric_limits<double>::max();
            if (badness < best_badness) {
                best_badness = badness;
                best = at;
            }
        }
        return best;
    }

    std::span<const Point2> points_;
    const Loop& ring_;
    std::vector<std::size_t> next_;
    std::vector<std::size_t> previous_;
    std::unordered_set<std::uint64_t> used_;
};

}  // namespace

std::vector<std::array<std::uint32_t, 3>> clip_ears(std::span<const Point2> points, const Loop& outer,
                                                    std::span<const Loop> holes) {
    Loop ring = outer;
    // From right to left: the rightmost point of a hole then sees the ring, not a hole that is not yet joined.
    std::vector<const Loop*> order;
    for (const Loop& hole : holes) order.push_back(&hole);
    const auto right_end = [&](const Loop* loop) {
        double x = -std::numeric_limits<double>::infinity();
        for (const std::uint32_t p : *loop) x = std::max(x, points[p].x);
        return x;
    };
    std::stable_sort(order.begin(), order.end(),
                     [&](const Loop* a, const Loop* b) { return right_end(a) > right_end(b); });
    for (const Loop* hole : order) bridge(points, ring, *hole, holes);
    return EarCutter(points, ring).run();
}

}  // namespace qchopper
