// Simple shapes for robot, spindle, table and block, and how far apart two of them are.
//
// mm, in one frame. A distance is 0 where two shapes touch or overlap; it is never larger than the true one, and where
// a cylinder takes part less than it by at most distance_error, else by rounding alone. Pure functions that allocate
// nothing; lengths and half sizes are not negative (tests/cam/cell/shape_distance_test.cpp).

#pragma once

#include "base/box.h"
#include "base/pose.h"

namespace qchopper {

constexpr double distance_error = 0.01;  // mm

// All points within `radius` of the line from `from` to `to`.
struct Capsule {
    Vec3 from;
    Vec3 to;
    double radius = 0;
    bool operator==(const Capsule&) const = default;
};

// With flat ends in the middle of which `from` and `to` lie.
struct Cylinder {
    Vec3 from;
    Vec3 to;
    double radius = 0;
    bool operator==(const Cylinder&) const = default;
};

// A box in any orientation, its middle in the origin of its own frame.
struct PlacedBox {
    Pose box_in_frame;
    Vec3 half;  // of its sides
    bool operator==(const PlacedBox&) const = default;
};

// The box whose coordinates in a frame of its own are `box`.
PlacedBox placed(const Pose& own_in_frame, const Box& box);

double distance(const Capsule& a, const Capsule& b);
double distance(const Capsule& a, const PlacedBox& b);
double distance(const Capsule& a, const Cylinder& b);
double distance(const Cylinder& a, const Cylinder& b);
double distance(const Cylinder& a, const PlacedBox& b);

// Of its lowest point, along the frame's z.
double lowest(const Capsule& shape);
double lowest(const Cylinder& shape);

// A capsule or cylinder of frame a, in frame b.
template <class Shape>
Shape moved(const Pose& a_in_b, const Shape& shape) {
    return {apply(a_in_b, shape.from), apply(a_in_b, shape.to), shape.radius};
}

// The capsule with the same axis and radius, which holds the cylinder: distances from it are quick lower bounds.
inline Capsule around(const Cylinder& shape) {
    return {shape.from, shape.to, shape.radius};
}

}  // namespace qchopper
