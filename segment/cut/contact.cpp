// For every corner of a loop, the edges that it touches are found by rows (polygon.h); the angles of their ends about
// the corner show whether they lie in its material or in the void. O(N) for N points while few edges lie in one row.

#include "segment/cut/contact.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace qchopper {
namespace {

// Shares of the region's size. Rounding is far below the first; the distance of two vertices at a nudged plane is far
// above the last.
constexpr double contact_share = 1e-11;
constexpr double move_share = 1e-10;
constexpr double probe_share = 1e-9;
constexpr double equal_angle = 1e-6;

Point2 operator-(Point2 a, Point2 b) {
    return {a.x - b.x, a.y - b.y};
}

Point2 along(Point2 p, double angle, double distance) {
    return {p.x + distance * std::cos(angle), p.y + distance * std::sin(angle)};
}

double angle_of(Point2 d) {
    return std::atan2(d.y, d.x);
}

// The angle counter-clockwise from one direction to another: 0 to 2 pi.
double turn(double from, double to) {
    const double t = std::fmod(to - from, 2 * std::numbers::pi);
    return t < 0 ? t + 2 * std::numbers::pi : t;
}

// A point of a loop, and the last point before it and the first one after it at another place.
struct Corner {
    Point2 at;
    Point2 before;
    Point2 after;
    std::uint32_t point = 0;
    bool is_doubled_before = false;  // the neighbour lies in the same place
    bool is_doubled_after = false;
};

// The two sides of a corner: the material, counter-clockwise from the edge that leaves it to the one that arrives, and
// the void.
struct Sides {
    double out = 0;       // direction of the edge that leaves the corner
    double material = 0;  // angle of the material
    double into_material() const { return out + material / 2; }
    double into_void() const { return out + material / 2 + std::numbers::pi; }
};

struct Edge {
    Point2 a;
    Point2 b;
    std::size_t from = 0;  // indices of its corners
    std::size_t to = 0;
};

class ContactSeparator {
 public:
    ContactSeparator(std::span<const Point2> points, std::span<const Loop* const> loops)
        : points_(points), loops_(loops) {
        Rectangle2 box;
        for (const Loop* loop : loops) {
            for (const std::uint32_t p : *loop) box.include(points[p]);
        }
        size_ = std::hypot(box.max.x - box.min.x, box.max.y - box.min.y);
        reach_ = contact_share * size_;
        for (const Loop* loop : loops) add_corners(*loop);
        rows_ = EdgeRows(box.min.y, box.max.y, edges_.size());
        for (std::uint32_t e = 0; e < edges_.size(); ++e) {
            const auto [low, high] = std::minmax(edges_[e].a.y, edges_[e].b.y);
            rows_.add(low - reach_, high + reach_, e);
        }
    }

    std::optional<std::vector<Point2>> run() {
        std::vector<Point2> moved(points_.begin(), points_.end());
        bool is_any = false;
        for (std::size_t c = 0; c < corners_.size(); ++c) {
            const std::optional<double> direction = move_direction(c);
            if (!direction) continue;
            moved[corners_[c].point] = along(corners_[c].at, *direction, move_share * size_);
            is_any = true;
        }
        if (!is_any) return std::nullopt;
        for (std::size_t i = 0; i < loops_.size(); ++i) {
            const double area = signed_area(moved, *loops_[i]);
            if (i == 0 ? area <= 0 : area >= 0) return std::nullopt;
        }
        return moved;
    }

 private:
    bool is_same_place(Point2 a, Point2 b) const {
        return std::abs(a.x - b.x) <= reach_ && std::abs(a.y - b.y) <= reach_;
    }

    void add_corners(const Loop& loop) {
        const std::size_t n = loop.size();
        const std::size_t first = corners_.size();
        for (std::size_t i = 0; i < n; ++i) {
            Corner c;
            c.point = loop[i];
            c.at = points_[loop[i]];
            std::size_t before = (i + n - 1) % n;
            std::size_t after = (i + 1) % n;
            c.is_doubled_before = is_same_place(points_[loop[before]], c.at);
            c.is_doubled_after = is_same_place(points_[loop[after]], c.at);
            while (before != i && is_same_place(points_[loop[before]], c.at)) before = (before + n - 1) % n;
            while (after != i && is_same_place(points_[loop[after]], c.at)) after = (after + 1) % n;
            c.before = points_[loop[before]];
            c.after = points_[loop[after]];
            edges_.push_back({c.at, points_[loop[(i + 1) % n]], first + i, first + (i + 1) % n});
            corners_.push_back(c);
        }
    }

    // By the even-odd rule, in the region before the move.
    bool is_material(Point2 p) const {
        bool inside = false;
        for (const std::uint32_t number : rows_.at(p.y)) {
            const Edge& e = edges_[number];
            if (ray_crosses(p, e.a, e.b)) inside = !inside;
        }
        return inside;
    }

    Sides sides(const Corner& c) const {
        Sides s;
        s.out = angle_of(c.after - c.at);
        s.material = turn(s.out, angle_of(c.before - c.at));
        // A spike of material or of void: the sides have no breadth.
        if (s.material < equal_angle || s.material > 2 * std::numbers::pi - equal_angle) {
            const bool is_around = is_material(along(c.at, s.out + std::numbers::pi, probe_share * size_));
            s.material = is_around ? 2 * std::numbers::pi : 0;
        }
        return s;
    }

    // The direction in which a corner has to move; nothing if it touches nothing, or if it does on both its sides.
    std::optional<double> move_direction(std::size_t number) const {
        const Corner& c = corners_[number];
        if (c.is_doubled_before != c.is_doubled_after) {
            return angle_of((c.is_doubled_before ? c.after : c.before) - c.at);
        }
        bool in_material = false;
        bool in_void = false;
        std::optional<Sides> own;
        for (const std::uint32_t e : rows_.at(c.at.y)) {
            const Edge& edge = edges_[e];
            if (edge.from == number || edge.to == number || !is_on_segment(c.at, edge.a, edge.b, reach_)) continue;
            if (!own) own = sides(c);
            for (const Point2 end : {edge.a, edge.b}) {
                if (is_same_place(end, c.at)) continue;
                const double angle = turn(own->out, angle_of(end - c.at));
                if (angle < equal_angle || angle > 2 * std::numbers::pi - equal_angle) continue;
                if (std::abs(angle - own->material) < equal_angle) continue;
                (angle < own->material ? in_material : in_void) = true;
            }
        }
        if (!own) return std::nullopt;
        // Only edges along its own: the contact is in the side that is not found a little farther away.
        if (!in_material && !in_void) {
            const bool has_material = is_material(along(c.at, own->into_material(), probe_share * size_));
            (has_material ? in_void : in_material) = true;
        }
        if (in_material == in_void) return std::nullopt;
        return in_material ? own->into_void() : own->into_material();
    }

    std::span<const Point2> points_;
    std::span<const Loop* const> loops_;
    double size_ = 0;
    double reach_ = 0;
    std::vector<Corner> corners_;
    std::vector<Edge> edges_;
    EdgeRows rows_;
};

}  // namespace

std::optional<std::vector<Point2>> without_contacts(std::span<const Point2> points,
                                                    std::span<const Loop* const> loops) {
    return ContactSeparator(points, loops).run();
}

}  // namespace qchopper
