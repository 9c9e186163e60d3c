// The farthest two of many places are corners of their hull (A. M. Andrew, Another efficient algorithm for convex hulls
// in two dimensions, 1979): O(places + corners squared).

#include "segment/objectives/joint_measure.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace qchopper {
namespace {

constexpr double min_diameters_apart = 3;
constexpr double tolerated_ratio = 10;  // T_C
constexpr double largest_ratio = 100;

// The corners of the hull, counter-clockwise. `points` ascend in y; those of equal y in x.
std::vector<Point2> hull_of(std::span<const Point2> points) {
    std::vector<Point2> hull;
    const auto add = [&](Point2 p, std::size_t least) {
        while (hull.size() >= least + 2 && orientation(hull[hull.size() - 2], hull.back(), p) <= 0) hull.pop_back();
        hull.push_back(p);
    };
    for (const Point2 p : points) add(p, 0);
    const std::size_t least = hull.empty() ? 0 : hull.size() - 1;
    for (std::size_t i = points.size(); i-- > 0;) add(points[i], least);
    if (hull.size() > 1) hull.pop_back();  // the first one again
    return hull;
}

double distance(Point2 a, Point2 b) {
    return std::hypot(a.x - b.x, a.y - b.y);
}

double farthest_two(std::span<const Point2> places) {
    const std::vector<Point2> hull = hull_of(places);
    double farthest = 0;
    for (std::size_t a = 0; a < hull.size(); ++a) {
        for (std::size_t b = a + 1; b < hull.size(); ++b) farthest = std::max(farthest, distance(hull[a], hull[b]));
    }
    return farthest;
}

// The area of the hull of discs of this radius.
double disc_hull_mm2(std::span<const Point2> places, double radius) {
    const std::vector<Point2> hull = hull_of(places);
    if (hull.empty()) return 0;
    double area = std::numbers::pi * radius * radius;
    for (std::size_t a = 0; a < hull.size(); ++a) {
        const Point2 p = hull[a];
        const Point2 q = hull[(a + 1) % hull.size()];
        area += (p.x * q.y - p.y * q.x) / 2 + radius * distance(p, q);
    }
    return area;
}

}  // namespace

void Extent16::include(Point2 p) {
    static const std::array<Point2, count> directions = [] {
        std::array<Point2, count> all;
        for (std::size_t k = 0; k < count; ++k) {
            const double angle = std::numbers::pi * static_cast<double>(k) / count;
            all[k] = {std::cos(angle), std::sin(angle)};
        }
        return all;
    }();
    for (std::size_t k = 0; k < count; ++k) {
        const double along = directions[k].x * p.x + directions[k].y * p.y;
        low_[k] = along < low_[k] ? along : low_[k];
        high_[k] = along > high_[k] ? along : high_[k];
    }
}

void Extent16::include(const Extent16& other) {
    for (std::size_t k = 0; k < count; ++k) {
        low_[k] = std::min(low_[k], other.low_[k]);
        high_[k] = std::max(high_[k], other.high_[k]);
    }
}

double Extent16::largest() const {
    double largest = 0;
    for (std::size_t k = 0; k < count; ++k) largest = std::max(largest, high_[k] - low_[k]);
    return largest;
}

double connector_of(std::span<const JointMeasure> joints, const ConnectorOptions& options) {
    double value = 0;
    double area = 0;
    for (const JointMeasure& joint : joints) {
        if (options.form == ConnectorForm::ratio) {
            const double held = disc_hull_mm2(joint.places, options.diameter / 2);
            value = std::max(value, held > 0 ? joint.area_mm2 / held - tolerated_ratio : largest_ratio);
            continue;
        }
        const double s = farthest_two(joint.places);
        value += joint.area_mm2 *
                 (s < min_diameters_apart * options.diameter ? 1 : std::max(0.0, 1 - 2 * s / joint.diameter));
        area += joint.area_mm2;
    }
    if (options.form == ConnectorForm::ratio) return std::min(value, largest_ratio);
    return area > 0 ? value / area : 0;
}

}  // namespace qchopper
