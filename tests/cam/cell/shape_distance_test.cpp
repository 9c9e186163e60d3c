// Distances of shapes against alternating projections, which converge to the nearest points of two convex shapes.

#include "cam/cell/shape_distance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>

namespace qchopper {
namespace {

using Projection = std::function<Vec3(Vec3)>;

Vec3 onto_line(Vec3 from, Vec3 to, Vec3 p) {
    const Vec3 d = to - from;
    const double square = dot(d, d);
    return from + std::clamp(square > 0 ? dot(p - from, d) / square : 0.0, 0.0, 1.0) * d;
}

Projection onto(const Capsule& c) {
    return [c](Vec3 p) {
        const Vec3 nearest = onto_line(c.from, c.to, p);
        const Vec3 off = p - nearest;
        return norm(off) <= c.radius ? p : nearest + c.radius * normalized(off);
    };
}

Projection onto(const Cylinder& c) {
    return [c](Vec3 p) {
        const Vec3 axis = normalized(c.to - c.from);
        const double along = std::clamp(dot(p - c.from, axis), 0.0, norm(c.to - c.from));
        const Vec3 across = (p - c.from) - dot(p - c.from, axis) * axis;
        const double out = norm(across);
        return c.from + along * axis + (out > c.radius ? c.radius / out : 1) * across;
    };
}

Projection onto(const PlacedBox& b) {
    return [b](Vec3 p) {
        Vec3 own = apply_inverse(b.box_in_frame, p);
        for (int i = 0; i < 3; ++i) own[i] = std::clamp(own[i], -b.half[i], b.half[i]);
        return apply(b.box_in_frame, own);
    };
}

double nearest_points(const Projection& a, const Projection& b, Vec3 start) {
    Vec3 p = a(start);
    double last = -1;
    for (int i = 0; i < 200'000; ++i) {
        const Vec3 q = b(p);
        p = a(q);
        const double d = norm(p - q);
        if (i % 100 == 0 && std::abs(d - last) < 1e-9) break;
        if (i % 100 == 0) last = d;
    }
    return norm(p - b(p));
}

class Shapes {
 public:
    explicit Shapes(unsigned seed) : random_(seed) {}
    double number(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
    Vec3 point(double size = 600) { return {number(-size, size), number(-size, size), number(-size, size)}; }
    Vec3 near(Vec3 p, double size) { return p + point(size); }
    Capsule capsule() {
        const Vec3 from = point();
        return {from, near(from, 400), number(0, 200)};
    }
    Cylinder cylinder() {
        const Vec3 from = point();
        return {from, near(from, 400), number(1, 200)};
    }
    Pose pose() {
        const Vec3 x = normalized(point());
        const Vec3 y = normalized(cross(point(), x));
        const Vec3 z = cross(x, y);
        return {{Vec3{x.x, y.x, z.x}, Vec3{x.y, y.y, z.y}, Vec3{x.z, y.z, z.z}}, point()};
    }
    PlacedBox box() { return {pose(), {number(1, 300), number(1, 300), number(1, 300)}}; }

 private:
    std::mt19937 random_;
};

template <class A, class B>
void expect_nearest(const A& a, const B& b, double error) {
    const double expected = nearest_points(onto(a), onto(b), {1, 2, 3});
    const double found = distance(a, b);
    EXPECT_LE(found, expected + 1e-6);
    EXPECT_GE(found, expected - error - 1e-3);  // the projections come from above, and slowly where surfaces are flat
}

TEST(ShapeDistance, IsThatOfTheNearestPoints) {
    Shapes some(1);
    for (int i = 0; i < 150; ++i) {
        expect_nearest(some.capsule(), some.capsule(), 1e-6);
        expect_nearest(some.capsule(), some.box(), 1e-6);
        expect_nearest(some.capsule(), some.cylinder(), distance_error);
        expect_nearest(some.cylinder(), some.cylinder(), distance_error);
        expect_nearest(some.cylinder(), some.box(), distance_error);
    }
}

TEST(ShapeDistance, IsZeroWhereShapesHoldACommonPoint) {
    Shapes some(2);
    for (int i = 0; i < 300; ++i) {
        const Capsule capsule = some.capsule();
        Cylinder cylinder = some.cylinder();
        PlacedBox box = some.box();
        const Vec3 common = capsule.from + some.number(0, 1) * (capsule.to - capsule.from);
        const Vec3 shift = common - 0.5 * (cylinder.from + cylinder.to);
        cylinder.from = cylinder.from + shift;
        cylinder.to = cylinder.to + shift;
        box.box_in_frame.shift = common - rotate(box.box_in_frame, 0.5 * box.half);
        EXPECT_EQ(distance(capsule, box), 0);
        EXPECT_LE(distance(capsule, cylinder), 1e-6);
        EXPECT_LE(distance(cylinder, box), 1e-6);
        EXPECT_EQ(distance(capsule, Capsule{common, some.point(), 1}), 0);
    }
}

TEST(ShapeDistance, MovesWithTheFrame) {
    Shapes some(3);
    for (int i = 0; i < 200; ++i) {
        const Pose pose = some.pose();
        const Capsule a = some.capsule();
        const Cylinder b = some.cylinder();
        const PlacedBox c = some.box();
        const Capsule moved_a{apply(pose, a.from), apply(pose, a.to), a.radius};
        const Cylinder moved_b{apply(pose, b.from), apply(pose, b.to), b.radius};
        const PlacedBox moved_c{pose * c.box_in_frame, c.half};
        EXPECT_NEAR(distance(a, c), distance(moved_a, moved_c), 1e-6);
        EXPECT_NEAR(distance(a, b), distance(moved_a, moved_b), distance_error);
        EXPECT_NEAR(distance(b, c), distance(moved_b, moved_c), distance_error);
        EXPECT_GE(distance(b, c) + distance_error, distance(around(b), c));
    }
}

TEST(ShapeDistance, HoldsForWhatHasNoLengthOrNoWidth) {
    const Capsule ball{{0, 0, 0}, {0, 0, 0}, 10};
    EXPECT_NEAR(distance(ball, Capsule{{50, 0, 0}, {50, 0, 0}, 5}), 35, 1e-9);
    EXPECT_NEAR(distance(ball, Capsule{{50, -20, 0}, {50, 20, 0}, 5}), 35, 1e-9);
    EXPECT_NEAR(distance(ball, placed({}, {{20, -5, -5}, {40, 5, 5}})), 10, 1e-9);
    EXPECT_NEAR(distance(ball, Cylinder{{0, 0, 40}, {0, 0, 90}, 30}), 30, distance_error);
    EXPECT_NEAR(distance(Cylinder{{0, 0, 40}, {0, 0, 90}, 30}, placed({}, {{-9, -9, -9}, {9, 9, 0}})), 40,
                distance_error);
    EXPECT_NEAR(distance(Capsule{{0, 0, 0}, {100, 0, 0}, 1}, Capsule{{0, 7, 0}, {100, 7, 0}, 1}), 5, 1e-9);
}

TEST(ShapeDistance, LowestIsThatOfAllPoints) {
    Shapes some(4);
    for (int i = 0; i < 200; ++i) {
        const Cylinder c = some.cylinder();
        const Vec3 far = onto(c)(Vec3{0.5 * (c.from.x + c.to.x), 0.5 * (c.from.y + c.to.y), -1e7});
        EXPECT_NEAR(lowest(c), far.z, 0.05);
        const Capsule d = some.capsule();
        EXPECT_NEAR(lowest(d), std::min(d.from.z, d.to.z) - d.radius, 1e-9);
    }
}

}  // namespace
}  // namespace qchopper
