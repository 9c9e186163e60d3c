#include "segment/mesh/order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "tests/shapes.h"

namespace qchopper {
namespace {

// The coordinates of all triangles, independent of the numbering.
std::vector<std::array<std::array<double, 3>, 3>> soup(const TriangleMesh& mesh) {
    std::vector<std::array<std::array<double, 3>, 3>> result;
    for (const Triangle& t : mesh.triangles) {
        std::array<std::array<double, 3>, 3> corners;
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3 p = mesh.points[t[k]];
            corners[k] = {p.x, p.y, p.z};
        }
        std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
        result.push_back(corners);
    }
    std::sort(result.begin(), result.end());
    return result;
}

TEST(Order, OnlyTheNumbersChange) {
    for (const auto& [name, mesh, solids] : shapes::all_closed()) {
        const TriangleMesh ordered = in_memory_order(mesh);
        EXPECT_EQ(soup(ordered), soup(mesh)) << name;
        EXPECT_EQ(ordered.points.size(), mesh.points.size()) << name;
    }
}

TEST(Order, PointsComeInTheOrderOfTheTriangles) {
    for (const auto& [name, mesh, solids] : shapes::all_closed()) {
        std::uint32_t used = 0;
        for (const Triangle& t : in_memory_order(mesh).triangles) {
            for (const std::uint32_t v : t) {
                EXPECT_LE(v, used) << name;
                used = std::max(used, v + 1);
            }
        }
    }
}

// Neighbours in memory are neighbours in space: a step from one triangle to the next is short on average.
TEST(Order, StepsAreShortHoweverTheInputIsShuffled) {
    const TriangleMesh mesh = shapes::ball({0, 0, 0}, 10, 40);
    TriangleMesh shuffled = mesh;
    std::shuffle(shuffled.triangles.begin(), shuffled.triangles.end(), std::mt19937(7));
    const auto mean_step = [](const TriangleMesh& m) {
        double sum = 0;
        for (std::size_t t = 1; t < m.triangles.size(); ++t) {
            sum += norm(m.points[m.triangles[t][0]] - m.points[m.triangles[t - 1][0]]);
        }
        return sum / static_cast<double>(m.triangles.size());
    };
    EXPECT_LT(mean_step(in_memory_order(shuffled)), 0.15 * mean_step(shuffled));
}

TEST(Order, CapsStayWithTheirTriangles) {
    TriangleMesh mesh = shapes::box({0, 0, 0}, {1, 1, 1}, 3);
    const auto is_top = [](const TriangleMesh& m, const Triangle& t) {
        return m.points[t[0]].z + m.points[t[1]].z + m.points[t[2]].z == 3;
    };
    for (const Triangle& t : mesh.triangles) mesh.cap_of.push_back(is_top(mesh, t) ? 4 : no_cap);
    const TriangleMesh ordered = in_memory_order(mesh);
    for (std::size_t t = 0; t < ordered.triangles.size(); ++t) {
        EXPECT_EQ(ordered.cap_of[t], is_top(ordered, ordered.triangles[t]) ? 4 : no_cap);
    }
    EXPECT_EQ(in_memory_order({}), TriangleMesh{});
}

}  // namespace
}  // namespace qchopper
