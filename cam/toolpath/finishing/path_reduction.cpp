// Shortest path over places on the gates. From each of them the directions that pass all gates up to the next one form
// a wedge, which narrows from gate to gate (H. Imai and M. Iri, "Polygonal approximations of a curve", 1988, for the
// graph; the wedge after J. Sklansky and V. Gonzalez, "Fast polygonal approximation of digitized curves", 1980). A
// corner that is rounded is compared with the gates at points of its parabola. O(gates * gates that a straight line
// passes).

#include "cam/toolpath/finishing/path_reduction.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>

namespace qchopper {
namespace {

constexpr std::size_t places = 5;  // on a gate, from its right end to its left end
constexpr double widest = 1.3;     // how far from the right end rounded corners may be, in widths

Point2 minus(Point2 a, Point2 b) {
    return {a.x - b.x, a.y - b.y};
}
double cross(Point2 a, Point2 b) {
    return a.x * b.y - a.y * b.x;
}
double dot(Point2 a, Point2 b) {
    return a.x * b.x + a.y * b.y;
}
double length(Point2 a) {
    return std::hypot(a.x, a.y);
}
Point2 between(Point2 a, Point2 b, double t) {
    return {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)};
}

Point2 place(const Gate& gate, std::size_t k) {
    return between(gate.right, gate.left, static_cast<double>(k) / (places - 1));
}

// Directions from a point that pass every gate so far.
class GateWedge {
 public:
    explicit GateWedge(Point2 from) : from_(from) {}

    bool holds(Point2 to) const {
        const Point2 d = minus(to, from_);
        if (!is_bounded_) return true;
        return cross(right_, d) >= 0 && cross(d, left_) >= 0 && dot(right_, d) > 0;
    }

    // False once no direction is left.
    bool narrow(const Gate& gate) {
        const Point2 right = minus(gate.right, from_);
        const Point2 left = minus(gate.left, from_);
        if (cross(right, left) < 0) return false;  // the gate is seen from behind
        if (!is_bounded_) {
            right_ = right;
            left_ = left;
            is_bounded_ = true;
            return true;
        }
        if (dot(right_, right) <= 0) return false;
        if (cross(right_, right) > 0) right_ = right;
        if (cross(left, left_) > 0) left_ = left;
        return cross(right_, left_) >= 0;
    }

 private:
    Point2 from_;
    Point2 right_;
    Point2 left_;
    bool is_bounded_ = false;
};

struct GatePlace {
    std::size_t gate = 0;
    std::size_t place = 0;
};

// Of a path: straight lines, and by how much they pass the gates left of their right ends, in places summed over gates.
struct PathCost {
    std::size_t lines = std::numeric_limits<std::size_t>::max();
    std::size_t aside = 0;
    bool operator<(const PathCost& other) const {
        return lines != other.lines ? lines < other.lines : aside < other.aside;
    }
    bool is_reached() const { return lines != std::numeric_limits<std::size_t>::max(); }
};

// Cheapest paths from the first gate to each place of each gate.
class FewestCorners {
 public:
    FewestCorners(const std::vector<Gate>& gates, bool is_closed, std::size_t reach)
        : gates_(gates), reach_(reach), cost_(gates.size()), before_(gates.size()) {
        for (std::size_t k = 0; k < places; ++k) {
            if (!is_closed || k == places / 2) cost_[0][k] = {0, 0};
        }
        for (std::size_t i = 0; i + 1 < gates.size(); ++i) {
            for (std::size_t k = 0; k < places; ++k) {
                if (cost_[i][k].is_reached()) extend({i, k});
            }
        }
        const auto& last = cost_.back();
        end_.gate = gates.size() - 1;
        end_.place = is_closed ? places / 2
                               : static_cast<std::size_t>(std::min_element(last.begin(), last.end()) - last.begin());
    }

    std::vector<GatePlace> corners() const {
        std::vector<GatePlace> path{end_};
        while (path.back().gate > 0) path.push_back(before_[path.back().gate][path.back().place]);
        std::reverse(path.begin(), path.end());
        return path;
    }

 private:
    void extend(GatePlace from) {
        GateWedge wedge(place(gates_[from.gate], from.place));
        const PathCost so_far = cost_[from.gate][from.place];
        const std::size_t end = std::min(gates_.size(), from.gate + 1 + reach_);
        for (std::size_t j = from.gate + 1; j < end; ++j) {
            for (std::size_t k = 0; k < places; ++k) {
                const PathCost cost{so_far.lines + 1, so_far.aside + (from.place + k) * (j - from.gate)};
                // The next gate can always be reached.
                if (!(cost < cost_[j][k]) || (j > from.gate + 1 && !wedge.holds(place(gates_[j], k)))) continue;
                cost_[j][k] = cost;
                before_[j][k] = from;
            }
            if (!wedge.narrow(gates_[j])) return;
        }
    }

    const std::vector<Gate>& gates_;
    std::size_t reach_;
    std::vector<std::array<PathCost, places>> cost_;
    std::vector<std::array<GatePlace, places>> before_;
    GatePlace end_;
};

// Where a point is between the exact line and its left limit: 0 on the line, 1 on the limit; gates [first, last].
double place_beside(const std::vector<Gate>& gates, std::size_t first, std::size_t last, Point2 p) {
    double nearest = std::numeric_limits<double>::infinity();
    double found = 0;
    for (std::size_t m = first; m < last; ++m) {
        const Point2 a = gates[m].right;
        const Point2 side = minus(gates[m + 1].right, a);
        const double square = dot(side, side);
        const double t = square > 0 ? std::clamp(dot(minus(p, a), side) / square, 0.0, 1.0) : 0;
        const Point2 away = minus(p, between(a, gates[m + 1].right, t));
        const double distance = length(away);
        if (distance >= nearest) continue;
        nearest = distance;
        const Point2 width = minus(between(gates[m].left, gates[m + 1].left, t), between(a, gates[m + 1].right, t));
        const double sign = dot(away, width) < 0 ? -1 : 1;
        // Square to the line, a limit that leans is nearer than its gate is wide.
        const double allowed = square > 0 ? std::abs(cross(side, width)) / std::sqrt(square) : length(width);
        found = sign * distance / std::max(allowed, 1e-9);
    }
    return found;
}

// A corner of a path, and the gate on which it lies.
struct PathCorner {
    std::size_t gate = 0;
    Point2 at;
};

bool can_round(const std::vector<Gate>& gates, const PathCorner& before, const PathCorner& corner,
               const PathCorner& behind, double rounding) {
    const double side_before = length(minus(before.at, corner.at));
    const double side_behind = length(minus(behind.at, corner.at));
    const double a = std::min(rounding, 0.5 * std::min(side_before, side_behind));
    if (!(a > 0)) return false;
    const Point2 begin = between(corner.at, before.at, a / side_before);
    const Point2 end = between(corner.at, behind.at, a / side_behind);
    for (const double t : {0.25, 0.5, 0.75}) {
        const Point2 on_parabola = between(between(begin, corner.at, t), between(corner.at, end, t), t);
        const double beside = place_beside(gates, before.gate, behind.gate, on_parabola);
        if (beside < -0.02 || beside > widest + 0.02) return false;
    }
    return true;
}

// Whether a straight line passes all gates between two corners.
bool passes(const std::vector<Gate>& gates, const PathCorner& from, const PathCorner& to) {
    GateWedge wedge(from.at);
    for (std::size_t i = from.gate + 1; i < to.gate; ++i) {
        if (!wedge.narrow(gates[i])) return false;
    }
    return wedge.holds(to.at);
}

// Moves corners that cannot be rounded to another place on their gate, or beside it as far as is allowed, if they can
// be rounded there.
void move_to_round(std::vector<PathCorner>& corners, const std::vector<Gate>& gates, double rounding) {
    std::vector<Gate> wide = gates;
    for (Gate& gate : wide) gate.left = between(gate.right, gate.left, widest);
    for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
        const PathCorner& before = corners[i - 1];
        const PathCorner& behind = corners[i + 1];
        if (can_round(gates, before, corners[i], behind, rounding)) continue;
        for (const double t : {0.0, 0.5, 1.0, widest}) {
            const Gate& gate = gates[corners[i].gate];
            const PathCorner moved{corners[i].gate, between(gate.right, gate.left, t)};
            if (!passes(wide, before, moved) || !passes(wide, moved, behind) ||
                !can_round(gates, before, moved, behind, rounding)) {
                continue;
            }
            corners[i] = moved;
            break;
        }
    }
}

}  // namespace

std::vector<ReducedPoint> reduced_path(const std::vector<Gate>& gates, bool is_closed,
                                       const ReductionOptions& options) {
    assert(gates.size() >= 2);
    std::vector<PathCorner> corners;
    for (const GatePlace& found : FewestCorners(gates, is_closed, options.reach).corners()) {
        corners.push_back({found.gate, place(gates[found.gate], found.place)});
    }
    if (options.rounding > 0) move_to_round(corners, gates, options.rounding);
    std::vector<ReducedPoint> path;
    path.reserve(corners.size());
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const bool is_end = i == 0 || i + 1 == corners.size();
        path.push_back(
            {corners[i].at, !is_end && options.rounding > 0 &&
                                can_round(gates, corners[i - 1], corners[i], corners[i + 1], options.rounding)});
    }
    return path;
}

}  // namespace qchopper
