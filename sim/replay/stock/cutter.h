// The shape of a tool of revolution, for what it removes and how deep a point lies in it.
//
// mm. The tip is the origin, the axis is z, from the tip into the spindle; the body goes on upwards without end. All
// shapes are convex (ISO 14649-111: ball, flat, bull, cone). O(1); generic shapes minimise along a move by ternary
// search (tests/sim/replay/gouge_test.cpp).

#pragma once

#include <array>
#include <cstddef>

#include "base/vec3.h"
#include "cam/cell/cutting_tool.h"

namespace qchopper {

struct Cutter {
    ToolShape shape = ToolShape::ball;
    double radius = 0;
    double corner = 0;    // of the edge or the tip; ball: radius
    double sin_half = 0;  // of a cone's half angle
    double cos_half = 1;
    bool operator==(const Cutter&) const = default;
};

Cutter cutter_of(const CuttingTool& tool);

// The same shape with its whole surface moved inwards by `inset`, below the radius; its tip stays where the surface is.
// The tip of the result stands `inset` above that of the cutter.
Cutter inset_cutter(const Cutter& cutter, double inset);

// Height of the surface above the tip at a distance r from the axis, 0 <= r <= radius.
double profile_height(const Cutter& cutter, double r);

// Height above the tip, never above 0, of the lowest point of a cutter that leans: `axis_z` is the z of the unit vector
// from its tip into the spindle. Precondition: it does not point down (tests/sim/replay/stock/cutter_test.cpp).
double lowest_point(const Cutter& cutter, double axis_z);

// A cutter whose tip goes straight from (0, 0, 0) along `move`, while its axis stays z.
class SweptCutter {
 public:
    SweptCutter(const Cutter& cutter, Vec3 move);

    // Where its surface is lowest over a point of the plane.
    struct Height {
        double z = 0;      // of the surface; infinite where the tool does not come
        double tip_z = 0;  // of the tip, at its lowest while the tool is over the point
    };
    Height height(double x, double y) const;
    // Of several points of a row the same z, to the bit; of balls and flat ends computed together.
    static constexpr std::size_t at_once = 8;
    using Row = std::array<double, at_once>;
    void heights(const Row& x, double y, Row& z) const;
    // How far a point is outside: negative inside, where it is the distance from the surface. It changes by no more
    // than the distance between two points; outside of flat, bull and cone it may be too small.
    double distance(Vec3 point) const;
    // Of a ball: the same with its gradient; the distance is a convex function of the point.
    double ball_distance(Vec3 point, Vec3& gradient) const;
    // Of a ball: whether a point is at least so far outside; below 0: at most so deep inside. Without a root.
    bool is_ball_beyond(Vec3 point, double distance) const {
        const double from_strip = distance + cutter_.radius;
        const Vec3 off = off_strip(point);
        return from_strip <= 0 || dot(off, off) >= from_strip * from_strip;
    }
    // A lower bound of the distance for all points of a triangle, from the cylinder about the tool. It nears the
    // distance with the square of the triangle's size, except at the edge of the cylinder.
    double min_from_cylinder(const std::array<Vec3, 3>& triangle) const;
    // How far before the place where the move begins, against its way, points may be that it does not leave to the tool
    // as it stands there.
    double touches_before() const;
    // The x of the points of a row that the tool can reach lie between these two.
    void reach_of_row(double y, double& x_min, double& x_max) const;
    const Cutter& cutter() const { return cutter_; }

 private:
    // Of a ball: from the nearest point of the strip that is the way of its centre and all above.
    Vec3 off_strip(Vec3 point) const;
    // Of 0..1 of the move, where the cylinder about the tool is nearest to a point or holds it deepest.
    double place_in_cylinder(Vec3 point) const;

    Cutter cutter_;
    Vec3 move_;
    double length_ = 0;  // along the plane
    double slope_ = 0;
    double ball_share_ = 0;  // slope / sqrt(1 + slope^2)
    double unit_x_ = 0;
    double unit_y_ = 0;
};

}  // namespace qchopper
