#include "base/pose.h"

#include <gtest/gtest.h>

#include <cmath>

namespace qchopper {
namespace {

// A turn about an axis (O. Rodrigues, 1840), row by row, and a shift.
Pose turned(Vec3 axis, double angle_rad, Vec3 shift) {
    const Vec3 k = normalized(axis);
    const auto turn = [&](Vec3 v) {
        return std::cos(angle_rad) * v + std::sin(angle_rad) * cross(k, v) + (1 - std::cos(angle_rad)) * dot(k, v) * k;
    };
    const Vec3 x = turn({1, 0, 0});
    const Vec3 y = turn({0, 1, 0});
    const Vec3 z = turn({0, 0, 1});
    return {{Vec3{x.x, y.x, z.x}, Vec3{x.y, y.y, z.y}, Vec3{x.z, y.z, z.z}}, shift};
}

const Pose stock_in_cell = turned({1, 2, 3}, 0.7, {1200, -300, 450});
const Pose piece_in_stock = turned({-2, 0.5, 1}, 2.1, {15, 20, -7});
const Vec3 points[] = {{0, 0, 0}, {1, 2, 3}, {-250, 1e3, 0.125}};

TEST(Pose, BackIsTheInverse) {
    for (const Vec3 p : points) {
        EXPECT_LT(norm(apply_inverse(stock_in_cell, apply(stock_in_cell, p)) - p), 1e-9);
        EXPECT_LT(norm(apply(inverse(stock_in_cell), p) - apply_inverse(stock_in_cell, p)), 1e-9);
    }
}

TEST(Pose, FramesAreChained) {
    const Pose piece_in_cell = stock_in_cell * piece_in_stock;
    for (const Vec3 p : points) {
        EXPECT_LT(norm(apply(piece_in_cell, p) - apply(stock_in_cell, apply(piece_in_stock, p))), 1e-9);
        EXPECT_LT(norm(rotate(piece_in_cell, p) - (apply(piece_in_cell, p) - apply(piece_in_cell, {}))), 1e-9);
    }
    const Pose nothing = piece_in_cell * inverse(piece_in_cell);
    for (const Vec3 p : points) EXPECT_LT(norm(apply(nothing, p) - p), 1e-9);
}

TEST(Pose, TheDefaultIsTheIdentity) {
    for (const Vec3 p : points) {
        EXPECT_EQ(apply(Pose{}, p), p);
        EXPECT_EQ(apply_inverse(Pose{}, p), p);
    }
    EXPECT_EQ(Pose{} * Pose{}, Pose{});
}

}  // namespace
}  // namespace qchopper
