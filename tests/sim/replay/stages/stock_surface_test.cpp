#include "sim/replay/stages/stock_surface.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>

#include "segment/mesh/measure.h"

namespace qchopper {
namespace {

const Box block{{-50, -30, -10}, {50, 30, 30}};
const Cutter ball{ToolShape::ball, 6, 6, 0, 1};

// Every side of a triangle is that of as many triangles the other way round.
void expect_closed(const TriangleMesh& mesh) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> sides;
    for (const Triangle& t : mesh.triangles) {
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t a = t[i];
            const std::uint32_t b = t[(i + 1) % 3];
            sides[{std::min(a, b), std::max(a, b)}] += a < b ? 1 : -1;
        }
    }
    for (const auto& [side, sum] : sides) ASSERT_EQ(sum, 0) << side.first << " " << side.second;
}

TEST(StockSurface, ThatOfAWholeBlockIsTheBlock) {
    const StockModel stock_model(block, {{0, 0, 1}}, 1);
    for (const double spacing : {1.0, 2.5, 7.0}) {
        const TriangleMesh mesh = stock_surface(stock_model, spacing);
        expect_closed(mesh);
        const Vec3 size = block.size();
        const double volume = size.x * size.y * size.z;
        EXPECT_LT(volume_mm3(mesh), volume);
        EXPECT_GT(volume_mm3(mesh), volume - 0.6 * spacing * spacing * 4 * (size.x + size.y + size.z))
            << "edges alone are cut off";
        const Box box = bounds(mesh);
        EXPECT_LE(norm(box.min - block.min), 0.01 * spacing * std::sqrt(3.0));
        EXPECT_LE(norm(box.max - block.max), 0.01 * spacing * std::sqrt(3.0));
    }
}

TEST(StockSurface, AGrooveIsWhereTheToolWas) {
    StockModel stock_model(block, {{0, 0, 1}}, 0.25);
    stock_model.cut(0, ball, 100, {-70, 0, 20}, {70, 0, 20});
    const TriangleMesh mesh = stock_surface(stock_model, 1);
    expect_closed(mesh);
    // Half a circle, and what is above it.
    const double section = 0.5 * std::numbers::pi * 36 + 12 * 4;
    const Vec3 size = block.size();
    EXPECT_NEAR(volume_mm3(mesh), size.x * (size.y * size.z - section), 0.02 * 100 * 60 * 10);
    for (const Vec3& p : mesh.points) {
        if (std::abs(p.x) > 45 || std::abs(p.y) > 5 || p.z < 10) continue;
        EXPECT_NEAR(std::hypot(p.y, p.z - 26), 6, 0.5) << p.y << " " << p.z;
    }
}

TEST(StockSurface, TheSpacingGivesAboutSoManyTriangles) {
    const StockModel stock_model(block, {{0, 0, 1}}, 1);
    for (const std::size_t triangles : {5'000U, 20'000U}) {
        const double spacing = surface_spacing(block, triangles, 0.1);
        const std::size_t made = stock_surface(stock_model, spacing).triangles.size();
        EXPECT_LE(made, triangles);
        EXPECT_GT(made, triangles / 2);
    }
    EXPECT_EQ(surface_spacing(block, 1'000'000, 1), 1);
}

}  // namespace
}  // namespace qchopper
