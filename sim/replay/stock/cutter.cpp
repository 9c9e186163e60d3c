// The lower surface of a swept convex body is the least of the body's over all places along the move, a convex function
// of the place. For a ball and a flat end it is solved; for the rest it is searched. O(1). Compiled without errno of
// sqrt() and traps, for which points of a row would be computed one after the other.

#include "sim/replay/stock/cutter.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace qchopper {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr int search_steps = 48;  // (2/3)^48 = 3.5e-9 of the move

double length_of(double x, double y) {
    return std::sqrt(x * x + y * y);
}

// Negative inside; z from the tip.
double distance_from(const Cutter& cutter, double r, double z) {
    switch (cutter.shape) {
        case ToolShape::ball:
            return (z >= cutter.radius ? r : std::sqrt(r * r + (z - cutter.radius) * (z - cutter.radius))) -
                   cutter.radius;
        case ToolShape::flat:
            return std::max(r - cutter.radius, -z);
        case ToolShape::bull: {
            const double dr = r - (cutter.radius - cutter.corner);
            const double dz = cutter.corner - z;
            const double outside = std::hypot(std::max(dr, 0.0), std::max(dz, 0.0));
            return (outside > 0 ? outside : std::max(dr, dz)) - cutter.corner;
        }
        case ToolShape::drill:
        case ToolShape::cone: {
            // The cone with its apex in the middle of the tip's sphere, grown by the sphere's radius.
            const double up = z - cutter.corner;
            const bool is_below = up * cutter.cos_half + r * cutter.sin_half < 0;
            const double flank = is_below ? std::hypot(r, up) : r * cutter.cos_half - up * cutter.sin_half;
            return std::max(flank - cutter.corner, r - cutter.radius);
        }
    }
    return infinite;
}

// The place in 0..1 where a convex function is least.
template <class Function>
double place_of_least(double from, double to, const Function& f) {
    for (int i = 0; i < search_steps && to - from > 1e-9; ++i) {
        const double a = from + (to - from) / 3;
        const double b = to - (to - from) / 3;
        if (f(a) <= f(b)) {
            to = b;
        } else {
            from = a;
        }
    }
    return 0.5 * (from + to);
}

}  // namespace

Cutter cutter_of(const CuttingTool& tool) {
    Cutter cutter{tool.shape, 0.5 * tool.diameter, tool.corner_radius, 0, 1};
    if (tool.shape == ToolShape::ball) cutter.corner = cutter.radius;
    if (tool.shape == ToolShape::flat) cutter.corner = 0;
    if (tool.shape == ToolShape::cone || is_drill(tool)) {
        cutter.sin_half = std::sin(0.5 * tool.tip_angle);
        cutter.cos_half = std::cos(0.5 * tool.tip_angle);
    }
    return cutter;
}

Cutter inset_cutter(const Cutter& cutter, double inset) {
    Cutter inner = cutter;
    inner.radius -= inset;
    inner.corner = std::max(0.0, cutter.corner - inset);
    return inner;
}

double profile_height(const Cutter& cutter, double r) {
    const double from_corner = r - (cutter.radius - cutter.corner);
    switch (cutter.shape) {
        case ToolShape::ball:
            return cutter.radius - std::sqrt(std::max(0.0, cutter.radius * cutter.radius - r * r));
        case ToolShape::flat:
            return 0;
        case ToolShape::bull:
            if (from_corner <= 0) return 0;
            return cutter.corner - std::sqrt(std::max(0.0, cutter.corner * cutter.corner - from_corner * from_corner));
        case ToolShape::drill:
        case ToolShape::cone:
            break;
    }
    const double touch = cutter.corner * cutter.cos_half;
    if (r <= touch) return cutter.corner - std::sqrt(std::max(0.0, cutter.corner * cutter.corner - r * r));
    return cutter.corner * (1 - cutter.sin_half) + (r - touch) * cutter.cos_half / cutter.sin_half;
}

// That of the rounded tip or edge, or the rim at full radius.
double lowest_point(const Cutter& cutter, double axis_z) {
    const double sine = std::sqrt(std::max(0.0, 1 - axis_z * axis_z));
    const double of_corner = cutter.corner * (axis_z - 1);
    if (cutter.sin_half > 0) {
        return std::min(of_corner, profile_height(cutter, cutter.radius) * axis_z - cutter.radius * sine);
    }
    return of_corner - (cutter.radius - cutter.corner) * sine;
}

SweptCutter::SweptCutter(const Cutter& cutter, Vec3 move)
    : cutter_(cutter), move_(move), length_(std::sqrt(move.x * move.x + move.y * move.y)) {
    if (length_ < 1e-9) {
        length_ = 0;
        return;
    }
    unit_x_ = move.x / length_;
    unit_y_ = move.y / length_;
    slope_ = move.z / length_;
    ball_share_ = slope_ / std::sqrt(1 + slope_ * slope_);
}

SweptCutter::Height SweptCutter::height(double x, double y) const {
    const double r2 = cutter_.radius * cutter_.radius;
    if (length_ == 0) {
        const double d2 = x * x + y * y;
        if (d2 > r2) return {infinite, 0};
        const double low = std::min(0.0, move_.z);
        return {low + profile_height(cutter_, std::sqrt(d2)), low};
    }
    const double along = x * unit_x_ + y * unit_y_;
    const double aside = x * unit_y_ - y * unit_x_;
    const double half2 = r2 - aside * aside;
    if (half2 < 0) return {infinite, 0};
    const double half = std::sqrt(half2);
    const double from = std::max(0.0, along - half);
    const double to = std::min(length_, along + half);
    if (from > to) return {infinite, 0};
    const double tip_z = slope_ * (slope_ < 0 ? to : from);
    if (cutter_.shape == ToolShape::ball) {
        const double place = std::clamp(along - ball_share_ * half, from, to);
        const double off = along - place;
        return {slope_ * place + cutter_.radius - std::sqrt(std::max(0.0, half2 - off * off)), tip_z};
    }
    double place = slope_ < 0 ? to : from;
    const auto height_at = [&](double at) {
        const double off = along - at;
        return slope_ * at + profile_height(cutter_, std::min(cutter_.radius, std::sqrt(off * off + aside * aside)));
    };
    if (cutter_.shape != ToolShape::flat) place = place_of_least(from, to, height_at);
    return {height_at(place), tip_z};
}

// As height() has it, without branches, so that the compiler computes several points at once.
void SweptCutter::heights(const Row& x, double y, Row& z) const {
    const bool is_flat = cutter_.shape == ToolShape::flat;
    if (length_ == 0 || (cutter_.shape != ToolShape::ball && !is_flat)) {
        for (std::size_t k = 0; k < at_once; ++k) z[k] = height(x[k], y).z;
        return;
    }
    const double radius = cutter_.radius;
    const double r2 = radius * radius;
    const double length = length_;
    const double slope = slope_;
    const double share = ball_share_;
    const double unit_x = unit_x_;
    const double unit_y = unit_y_;
    std::array<double, at_once> along;
    std::array<double, at_once> half2;
    std::array<double, at_once> from;
    std::array<double, at_once> to;
    std::array<double, at_once> place;
    for (std::size_t k = 0; k < at_once; ++k) {
        along[k] = x[k] * unit_x + y * unit_y;
        const double aside = x[k] * unit_y - y * unit_x;
        half2[k] = r2 - aside * aside;
        const double half = std::sqrt(half2[k] > 0 ? half2[k] : 0);
        const double first = along[k] - half;
        const double last = along[k] + half;
        from[k] = first > 0 ? first : 0;
        to[k] = last < length ? last : length;
        place[k] = along[k] - share * half;
    }
    if (is_flat) {
        const Row& end = slope < 0 ? to : from;
        for (std::size_t k = 0; k < at_once; ++k) {
            const double beside = half2[k] < 0 ? infinite : 0;
            z[k] = from[k] > to[k] ? infinite : slope * end[k] + beside;
        }
        return;
    }
    for (std::size_t k = 0; k < at_once; ++k) {
        const double not_before = place[k] < from[k] ? from[k] : place[k];
        const double at = to[k] < not_before ? to[k] : not_before;
        const double off = along[k] - at;
        const double under = half2[k] - off * off;
        const double surface = slope * at + radius - std::sqrt(under > 0 ? under : 0);
        const double beside = half2[k] < 0 ? infinite : 0;
        z[k] = from[k] > to[k] ? infinite : surface + beside;
    }
}

// Of a level or rising move the surface over a point rises with the place, as long as the point is behind it. A ball
// that descends touches the point behind its middle by the sine of the slope.
double SweptCutter::touches_before() const {
    if (slope_ >= 0) return 0;
    return cutter_.shape == ToolShape::ball ? -ball_share_ * cutter_.radius : cutter_.radius;
}

void SweptCutter::reach_of_row(double y, double& x_min, double& x_max) const {
    const double r = cutter_.radius;
    double from = 0;
    double to = 1;
    if (std::abs(move_.y) > 1e-9) {
        const double a = (y - r) / move_.y;
        const double b = (y + r) / move_.y;
        from = std::clamp(std::min(a, b), 0.0, 1.0);
        to = std::clamp(std::max(a, b), 0.0, 1.0);
    }
    x_min = std::min(from * move_.x, to * move_.x) - r;
    x_max = std::max(from * move_.x, to * move_.x) + r;
}

double SweptCutter::distance(Vec3 point) const {
    if (cutter_.shape == ToolShape::ball) {
        Vec3 gradient;
        return ball_distance(point, gradient);
    }
    const auto at = [&](double s) {
        const double x = point.x - s * move_.x;
        const double y = point.y - s * move_.y;
        return distance_from(cutter_, std::sqrt(x * x + y * y), point.z - s * move_.z);
    };
    if (cutter_.shape == ToolShape::flat) return at(place_in_cylinder(point));
    return dot(move_, move_) < 1e-18 ? at(0) : at(place_of_least(0, 1, at));
}

// Where the axis is nearest, unless the tip is farther above the point there: then towards the lower end of the move.
double SweptCutter::place_in_cylinder(Vec3 p) const {
    const double lower_end = move_.z < 0 ? 1 : 0;
    if (length_ == 0) return lower_end;
    const double nearest = std::clamp((p.x * unit_x_ + p.y * unit_y_) / length_, 0.0, 1.0);
    const auto aside = [&](double s) { return length_of(p.x - s * move_.x, p.y - s * move_.y) - cutter_.radius; };
    const auto below = [&](double s) { return s * move_.z - p.z; };
    if (move_.z == 0 || aside(nearest) >= below(nearest)) return nearest;
    return place_of_least(std::min(nearest, lower_end), std::max(nearest, lower_end),
                          [&](double s) { return std::max(aside(s), below(s)); });
}

// The distance from the cylinder is the least over the places s of the larger of two convex functions of point and
// place: `aside` from the axis, `below` the tip. Any mean of their tangents at one place is below both.
double SweptCutter::min_from_cylinder(const std::array<Vec3, 3>& triangle) const {
    const Vec3 m = (1.0 / 3) * (triangle[0] + triangle[1] + triangle[2]);
    const double s = place_in_cylinder(m);
    const double r = length_of(m.x - s * move_.x, m.y - s * move_.y);
    const double aside = r - cutter_.radius;
    const double below = s * move_.z - m.z;
    const Vec3 out = r > 0 ? (1 / r) * Vec3{m.x - s * move_.x, m.y - s * move_.y, 0} : Vec3{};
    const double aside_by_s = -(out.x * move_.x + out.y * move_.y);
    const auto bound = [&](double share) {
        const Vec3 gradient = share * out - (1 - share) * Vec3{0, 0, 1};
        const double by_s = share * aside_by_s + (1 - share) * move_.z;
        double slope = std::numeric_limits<double>::infinity();
        for (const Vec3 corner : triangle) slope = std::min(slope, dot(gradient, corner - m));
        return share * aside + (1 - share) * below + slope + std::min(-by_s * s, by_s * (1 - s));
    };
    const double even = move_.z / (move_.z - aside_by_s);  // where the mean does not change with the place
    const double both = even > 0 && even < 1 ? bound(even) : -infinite;
    return std::max({bound(0), bound(1), both});
}

Vec3 SweptCutter::off_strip(Vec3 point) const {
    const Vec3 p{point.x, point.y, point.z - cutter_.radius};
    double s = 0;
    if (length_ > 0) s = std::clamp((p.x * unit_x_ + p.y * unit_y_) / length_, 0.0, 1.0);
    if (length_ == 0 && move_.z < 0) s = 1;
    if (p.z >= s * move_.z) return {p.x - s * move_.x, p.y - s * move_.y, 0};
    const double length2 = dot(move_, move_);
    s = length2 > 0 ? std::clamp(dot(p, move_) / length2, 0.0, 1.0) : 0;
    return p - s * move_;
}

// A ball and its shank are all points within the radius of a strip: the way of the centre, and all above it.
double SweptCutter::ball_distance(Vec3 point, Vec3& gradient) const {
    const Vec3 off = off_strip(point);
    const double distance = norm(off);
    gradient = distance > 0 ? (1 / distance) * off : Vec3{0, 0, 0};
    return distance - cutter_.radius;
}

}  // namespace qchopper
