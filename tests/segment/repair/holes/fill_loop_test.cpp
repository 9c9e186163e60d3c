// Triangles over one loop of points.

#include "segment/repair/holes/fill_loop.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace qchopper {
namespace {

struct Ring {
    std::vector<Vec3> loop;
    std::vector<Vec3> beyond;  // flat, around it
};

Ring regular(std::size_t count) {
    Ring ring;
    for (std::size_t i = 0; i < count; ++i) {
        const double angle = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(count);
        const double half = angle + std::numbers::pi / static_cast<double>(count);
        ring.loop.push_back({std::cos(angle), std::sin(angle), 0});
        ring.beyond.push_back({2 * std::cos(half), 2 * std::sin(half), 0});
    }
    return ring;
}

Vec3 area_of(const std::vector<Vec3>& points, const std::vector<Triangle>& triangles) {
    Vec3 area;
    for (const Triangle& t : triangles) {
        area = area + 0.5 * cross(points[t[1]] - points[t[0]], points[t[2]] - points[t[0]]);
    }
    return area;
}

TEST(FillLoop, HasTwoTrianglesLessThanPointsOrientedAsTheLoopRuns) {
    for (const std::size_t count : {3U, 4U, 7U, 60U, 201U}) {
        const Ring ring = regular(count);
        const std::vector<Triangle> triangles = fill_loop(ring.loop, ring.beyond);
        ASSERT_EQ(triangles.size(), count - 2);
        const double sector = 2 * std::numbers::pi / static_cast<double>(count);
        EXPECT_NEAR(area_of(ring.loop, triangles).z, 0.5 * static_cast<double>(count) * std::sin(sector), 1e-9);
        for (const Triangle& t : triangles) EXPECT_TRUE(t[0] < t[1] && t[1] < t[2]);
    }
}

}  // namespace
}  // namespace qchopper
