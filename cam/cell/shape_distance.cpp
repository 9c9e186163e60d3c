// Capsules: two lines in closed form (C. Ericson, "Real-time collision detection", 2005, section 5.1.9); a line and a
// box by the minimum of a convex function that is quadratic between at most six parameters. Cylinders: the method of E.
// Gilbert, D. Johnson and S. Keerthi (1988) on support functions. What is returned is its lower bound, the distance of
// the supporting plane that it has found, so that it is on the safe side wherever the iteration ends. Some 20 to 100 ns
// for capsules, up to a microsecond or two for cylinders.

#include "cam/cell/shape_distance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace qchopper {
namespace {

constexpr int max_iterations = 100;
constexpr double touching = 1e-9;  // mm
constexpr double flat = 1e-5;      // mm; a tetrahedron this low has no inside
constexpr double wanted_error = 0.1 * distance_error;

double clamped(double t) {
    return std::clamp(t, 0.0, 1.0);
}

double segment_distance(const Capsule& a, const Capsule& b) {
    const Vec3 d1 = a.to - a.from;
    const Vec3 d2 = b.to - b.from;
    const Vec3 r = a.from - b.from;
    const double aa = dot(d1, d1);
    const double ee = dot(d2, d2);
    const double f = dot(d2, r);
    const double c = dot(d1, r);
    const double bb = dot(d1, d2);
    const double determinant = aa * ee - bb * bb;
    double s = aa > 0 && determinant > 1e-12 * aa * ee ? clamped((bb * f - c * ee) / determinant) : 0;
    double t = ee > 0 ? (bb * s + f) / ee : 0;
    if (t < 0 || t > 1 || !(ee > 0)) {
        t = clamped(t);
        s = aa > 0 ? clamped((bb * t - c) / aa) : 0;
    }
    return norm(r + s * d1 - t * d2);
}

// How far a coordinate lies outside of -half..half.
double outside(double p, double half) {
    return std::max(std::abs(p) - half, 0.0);
}

double square_outside(Vec3 from, Vec3 along, Vec3 half, double t) {
    double sum = 0;
    for (int i = 0; i < 3; ++i) {
        const double d = outside(from[i] + t * along[i], half[i]);
        sum += d * d;
    }
    return sum;
}

// The least value between two parameters between which no coordinate passes a side of the box.
double min_between(Vec3 from, Vec3 along, Vec3 half, double t0, double t1) {
    double slope = 0;      // of half the square at t0
    double curvature = 0;  // of half the square
    const double middle = 0.5 * (t0 + t1);
    for (int i = 0; i < 3; ++i) {
        const double p = from[i] + middle * along[i];
        if (std::abs(p) <= half[i]) continue;
        const double d = from[i] + t0 * along[i] - std::copysign(half[i], p);
        slope += d * along[i];
        curvature += along[i] * along[i];
    }
    const double t = curvature > 0 ? std::clamp(t0 - slope / curvature, t0, t1) : t0;
    return square_outside(from, along, half, t);
}

double segment_box_distance(Vec3 from, Vec3 to, Vec3 half) {
    const Vec3 along = to - from;
    std::array<double, 8> at{};
    std::size_t count = 0;
    at[count++] = 0;
    for (int i = 0; i < 3; ++i) {
        if (along[i] == 0) continue;
        for (const double side : {-half[i], half[i]}) {
            const double t = (side - from[i]) / along[i];
            if (t > 0 && t < 1) at[count++] = t;
        }
    }
    at[count++] = 1;
    std::sort(at.begin(), at.begin() + static_cast<std::ptrdiff_t>(count));
    double least = square_outside(from, along, half, 1);
    for (std::size_t i = 0; i + 1 < count; ++i) {
        least = std::min(least, min_between(from, along, half, at[i], at[i + 1]));
    }
    return std::sqrt(least);
}

// The point farthest along a direction, which is not zero.
class CylinderSupport {
 public:
    explicit CylinderSupport(const Cylinder& c)
        : middle_(0.5 * (c.from + c.to)), axis_(normalized(c.to - c.from)), radius_(c.radius) {
        half_ = 0.5 * norm(c.to - c.from);
    }
    Vec3 middle() const { return middle_; }
    Vec3 operator()(Vec3 d) const {
        const double along = dot(d, axis_);
        const Vec3 across = d - along * axis_;
        const double length = norm(across);
        // Of a direction along the axis nothing but rounding is left, in no direction that is across it.
        const double out = length > 1e-9 * norm(d) ? radius_ / length : 0;
        return middle_ + (along < 0 ? -half_ : half_) * axis_ + out * across;
    }

 private:
    Vec3 middle_;
    Vec3 axis_;
    double half_ = 0;
    double radius_ = 0;
};

struct SegmentSupport {
    Vec3 from;
    Vec3 to;
    Vec3 middle() const { return 0.5 * (from + to); }
    Vec3 operator()(Vec3 d) const { return dot(d, to - from) > 0 ? to : from; }
};

struct BoxSupport {
    Vec3 half;
    static Vec3 middle() { return {}; }
    Vec3 operator()(Vec3 d) const {
        return {std::copysign(half.x, d.x), std::copysign(half.y, d.y), std::copysign(half.z, d.z)};
    }
};

// One to four points of the difference of two shapes.
struct Simplex {
    std::array<Vec3, 4> p{};
    std::size_t size = 0;
    void set(std::initializer_list<Vec3> points) {
        size = 0;
        for (const Vec3& point : points) p[size++] = point;
    }
};

// Each keeps in `s` the points whose hull holds the point nearest to the origin, and returns that point.
Vec3 nearest_of_line(Simplex& s, Vec3 a, Vec3 b) {
    const Vec3 ab = b - a;
    const double square = dot(ab, ab);
    const double t = square > 0 ? -dot(a, ab) / square : 0;
    if (t <= 0) return s.set({a}), a;
    if (t >= 1) return s.set({b}), b;
    s.set({a, b});
    return a + t * ab;
}

// Its corners lie in a line.
Vec3 nearest_of_flat_triangle(Simplex& s, Vec3 a, Vec3 b, Vec3 c) {
    Vec3 best = nearest_of_line(s, a, b);
    for (const auto& [from, to] : {std::pair(b, c), std::pair(a, c)}) {
        Simplex edge;
        const Vec3 nearest = nearest_of_line(edge, from, to);
        if (dot(nearest, nearest) >= dot(best, best)) continue;
        best = nearest;
        s = edge;
    }
    return best;
}

// Ericson, section 5.1.5, with the origin as the point.
Vec3 nearest_of_triangle(Simplex& s, Vec3 a, Vec3 b, Vec3 c) {
    const Vec3 ab = b - a;
    const Vec3 ac = c - a;
    const double d1 = -dot(ab, a);
    const double d2 = -dot(ac, a);
    if (d1 <= 0 && d2 <= 0) return s.set({a}), a;
    const double d3 = -dot(ab, b);
    const double d4 = -dot(ac, b);
    if (d3 >= 0 && d4 <= d3) return s.set({b}), b;
    const double vc = d1 * d4 - d3 * d2;
    if (vc <= 0 && d1 >= 0 && d3 <= 0) return nearest_of_line(s, a, b);
    const double d5 = -dot(ab, c);
    const double d6 = -dot(ac, c);
    if (d6 >= 0 && d5 <= d6) return s.set({c}), c;
    const double vb = d5 * d2 - d1 * d6;
    if (vb <= 0 && d2 >= 0 && d6 <= 0) return nearest_of_line(s, a, c);
    const double va = d3 * d6 - d5 * d4;
    if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) return nearest_of_line(s, b, c);
    const double sum = va + vb + vc;
    if (!(sum > 0)) return nearest_of_flat_triangle(s, a, b, c);
    s.set({a, b, c});
    return a + (vb / sum) * ab + (vc / sum) * ac;
}

// Zero with all four points where they enclose the origin.
Vec3 nearest_of_tetrahedron(Simplex& s) {
    constexpr std::array<std::array<std::size_t, 4>, 4> faces{{{0, 1, 2, 3}, {0, 1, 3, 2}, {0, 2, 3, 1}, {1, 2, 3, 0}}};
    const Simplex all = s;
    Vec3 best;
    double least = -1;
    for (const auto& f : faces) {
        const Vec3 normal = cross(all.p[f[1]] - all.p[f[0]], all.p[f[2]] - all.p[f[0]]);
        const double origin_side = -dot(normal, all.p[f[0]]);
        const double inner_side = dot(normal, all.p[f[3]] - all.p[f[0]]);
        const bool is_flat = std::abs(inner_side) <= flat * norm(normal);
        if (!is_flat && origin_side * inner_side > 0) continue;
        Simplex face;
        const Vec3 nearest = nearest_of_triangle(face, all.p[f[0]], all.p[f[1]], all.p[f[2]]);
        if (least >= 0 && dot(nearest, nearest) >= least) continue;
        least = dot(nearest, nearest);
        best = nearest;
        s = face;
    }
    return best;
}

Vec3 nearest_of(Simplex& s) {
    const auto p = s.p;
    if (s.size == 1) return p[0];
    if (s.size == 2) return nearest_of_line(s, p[0], p[1]);
    if (s.size == 3) return nearest_of_triangle(s, p[0], p[1], p[2]);
    return nearest_of_tetrahedron(s);
}

template <class A, class B>
double convex_distance(const A& a, const B& b) {
    Vec3 v = a.middle() - b.middle();
    if (norm(v) < touching) return 0;
    Simplex simplex;
    double lower = 0;
    for (int i = 0; i < max_iterations; ++i) {
        const double length = norm(v);
        const Vec3 w = a(-v) - b(v);
        lower = std::max(lower, dot(v, w) / length);
        if (length - lower <= wanted_error && i > 0) return lower;
        simplex.p[simplex.size++] = w;
        v = nearest_of(simplex);
        if (simplex.size == 4 || norm(v) < touching) return std::max(0.0, lower);
    }
    return lower;
}

}  // namespace

PlacedBox placed(const Pose& own_in_frame, const Box& box) {
    return {own_in_frame * Pose{Pose{}.row, box.centre()}, 0.5 * box.size()};
}

double distance(const Capsule& a, const Capsule& b) {
    return std::max(0.0, segment_distance(a, b) - a.radius - b.radius);
}

double distance(const Capsule& a, const PlacedBox& b) {
    const Vec3 from = apply_inverse(b.box_in_frame, a.from);
    const Vec3 to = apply_inverse(b.box_in_frame, a.to);
    return std::max(0.0, segment_box_distance(from, to, b.half) - a.radius);
}

double distance(const Capsule& a, const Cylinder& b) {
    return std::max(0.0, convex_distance(SegmentSupport{a.from, a.to}, CylinderSupport(b)) - a.radius);
}

double distance(const Cylinder& a, const Cylinder& b) {
    return convex_distance(CylinderSupport(a), CylinderSupport(b));
}

double distance(const Cylinder& a, const PlacedBox& b) {
    return convex_distance(CylinderSupport(moved(inverse(b.box_in_frame), a)), BoxSupport{b.half});
}

double lowest(const Capsule& shape) {
    return std::min(shape.from.z, shape.to.z) - shape.radius;
}

double lowest(const Cylinder& shape) {
    const Vec3 axis = normalized(shape.to - shape.from);
    return std::min(shape.from.z, shape.to.z) - shape.radius * std::hypot(axis.x, axis.y);
}

}  // namespace qchopper
