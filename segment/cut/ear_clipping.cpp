// Ears after G. Meisters, "Polygons have ears" (1975); bridges to holes after D. Eberly, "Triangulation by ear
// clipping" (2002). Where no ear is left, as on loops that cross themselves, the corner that overlaps least is cut off
// instead: the combinatorics, and so closedness, never depend on the geometry. O(N^2) for N points as a rule, O(N^3) at
// worst.

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

// Whether the open segment p-q properly crosses a-b.
bool crosses(Point2 p, Point2 q, Point2 a, Point2 b) {
    return (orientation(p, q, a) > 0) != (orientation(p, q, b) > 0) &&
           (orientation(a, b, p) > 0) != (orientation(a, b, q) > 0);
}

// Whether the direction from a ring corner towards q runs into the material there. A corner at the end of a bridge is
// in the ring twice, and perhaps only one of the two opens towards q.
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

// The ring position for the bridge to a point of a hole: the nearest one that is visible, else the nearest.
std::size_t bridge_position(std::span<const Point2> points, const Loop& ring, Point2 from,
                            std::span<const Loop> holes) {
    std::vector<std::size_t> by_distance(ring.size());
    for (std::size_t i = 0; i < ring.size(); ++i) by_distance[i] = i;
    std::stable_sort(by_distance.begin(), by_distance.end(), [&](std::size_t a, std::size_t b) {
        return distance2(points[ring[a]], from) < distance2(points[ring[b]], from);
    });
    constexpr std::size_t tries = 64;  // almost always one of the first few is visible
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

// Inserts the hole and a bridge to it and back, so that one ring remains. `holes` are all: no bridge may cross one.
void bridge(std::span<const Point2> points, Loop& ring, const Loop& hole, std::span<const Loop> holes) {
    std::size_t start = 0;
    for (std::size_t i = 1; i < hole.size(); ++i) {
        if (points[hole[i]].x > points[hole[start]].x) start = i;
    }
    const std::size_t at = bridge_position(points, ring, points[hole[start]], holes);
    Loop inserted;
    for (std::size_t i = 0; i <= hole.size(); ++i) inserted.push_back(hole[(start + i) % hole.size()]);
    inserted.push_back(ring[at]);
    ring.insert(ring.begin() + static_cast<std::ptrdiff_t>(at) + 1, inserted.begin(), inserted.end());
}

class EarClipper {
 public:
    EarClipper(std::span<const Point2> points, const Loop& ring) : points_(points), ring_(ring) {
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
            // After a round without an ear, the corner that overlaps least.
            const bool is_forced = since_last_ear > left;
            if (is_forced) at = min_overlap(at, left);
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

    // An edge that exists already would belong to more than two triangles.
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
    std::size_t min_overlap(std::size_t start, std::size_t left) const {
        std::size_t best = start;
        double least = std::numeric_limits<double>::infinity();
        std::size_t at = start;
        for (std::size_t i = 0; i < left; ++i, at = next_[at]) {
            if (ring_[previous_[at]] == ring_[next_[at]]) continue;
            const double area = orientation(point(previous_[at]), point(at), point(next_[at]));
            double overlap = area >= 0 ? area : -1e6 * area;
            if (!is_allowed(at)) overlap = std::numeric_limits<double>::max();
            if (overlap < least) {
                least = overlap;
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
    // From right to left: from the rightmost point of a hole the ring is visible then, past no hole that is not yet
    // joined.
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
    return EarClipper(points, ring).run();
}

}  // namespace qchopper
