#include "sim/replay/stock/cutter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <vector>

namespace qchopper {
namespace {

CuttingTool tool_of(ToolShape shape, double diameter, double corner_radius, double tip_angle_deg) {
    CuttingTool tool;
    tool.shape = shape;
    tool.diameter = diameter;
    tool.corner_radius = corner_radius;
    tool.tip_angle = tip_angle_deg * std::numbers::pi / 180;
    return tool;
}

struct NamedCutter {
    std::string name;
    Cutter cutter;
};

std::vector<NamedCutter> all_cutters() {
    return {{"ball", cutter_of(tool_of(ToolShape::ball, 12, 6, 0))},
            {"flat", cutter_of(tool_of(ToolShape::flat, 20, 0, 0))},
            {"bull", cutter_of(tool_of(ToolShape::bull, 20, 3, 0))},
            {"cone with a sharp tip", cutter_of(tool_of(ToolShape::cone, 16, 0, 60))},
            {"slim cone with a rounded tip", cutter_of(tool_of(ToolShape::cone, 12, 2, 14))},
            {"wide cone with a rounded tip", cutter_of(tool_of(ToolShape::cone, 30, 5, 120))},
            {"cone that is nearly a ball", cutter_of(tool_of(ToolShape::cone, 10, 4.9, 20))},
            {"drill", cutter_of(tool_of(ToolShape::drill, 8, 0, 118))}};
}

// Of many points of the surface below the full radius, leant by `angle` about y.
double lowest_sampled(const Cutter& cutter, double angle) {
    double lowest = 0;
    constexpr int rings = 1500;
    constexpr int around = 36;
    for (int i = 0; i <= rings; ++i) {
        const double r = cutter.radius * i / rings;
        const double z = profile_height(cutter, r);
        for (int k = 0; k < around; ++k) {
            const double x = r * std::cos(2 * std::numbers::pi * k / around);
            lowest = std::min(lowest, z * std::cos(angle) - x * std::sin(angle));
        }
    }
    return lowest;
}

TEST(Cutter, ItsLowestPointIsThatOfItsSurfaceHoweverItLeans) {
    for (const auto& [name, cutter] : all_cutters()) {
        for (const double degrees : {0.0, 0.5, 7.0, 20.0, 30.0, 45.0, 60.0, 75.0, 83.0, 90.0}) {
            const double angle = degrees * std::numbers::pi / 180;
            const double lowest = lowest_point(cutter, std::cos(angle));
            const double sampled = lowest_sampled(cutter, angle);
            EXPECT_LE(lowest, sampled + 1e-9) << name << " " << degrees;
            EXPECT_NEAR(lowest, sampled, 1e-4) << name << " " << degrees;
        }
    }
}

// Leant by less than the flank's angle to the floor it stands on the ball of its tip, by more on its rim.
TEST(SweptCutter, PointsOfARowHaveTheHeightsThatTheyHaveAlone) {
    std::mt19937 random(8);
    const auto number = [&](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random);
    };
    const std::vector<Cutter> cutters{
        {ToolShape::ball, 3, 3, 0, 1}, {ToolShape::flat, 20, 0, 0, 1}, {ToolShape::bull, 6, 2, 0, 1}};
    int over = 0;
    for (int i = 0; i < 3000; ++i) {
        const Cutter& cutter = cutters[static_cast<std::size_t>(i) % cutters.size()];
        const double steep = i % 5 == 0 ? 0 : number(-6, 6);
        const Vec3 move = i % 11 == 0 ? Vec3{0, 0, steep} : Vec3{number(-9, 9), i % 7 == 0 ? 0 : number(-9, 9), steep};
        const SweptCutter swept(cutter, move);
        const double y = number(-1.2 * cutter.radius, 1.2 * cutter.radius);
        const double x_min = number(-1.5 * cutter.radius, cutter.radius);
        SweptCutter::Row x;
        SweptCutter::Row z;
        for (std::size_t k = 0; k < x.size(); ++k) x[k] = x_min + 0.25 * static_cast<double>(k);
        swept.heights(x, y, z);
        for (std::size_t k = 0; k < x.size(); ++k) {
            EXPECT_EQ(z[k], swept.height(x[k], y).z) << i << " " << k;
            over += std::isinf(z[k]) ? 0 : 1;
        }
    }
    EXPECT_GT(over, 5000);
}

TEST(Cutter, ARoundedConeRestsOnItsTipAndThenOnItsRim) {
    const Cutter cone = cutter_of(tool_of(ToolShape::cone, 12, 2, 14));
    const double flank = (90 - 7) * std::numbers::pi / 180;
    const double before = flank - 0.01;
    const double after = flank + 0.01;
    EXPECT_DOUBLE_EQ(lowest_point(cone, std::cos(before)), 2 * (std::cos(before) - 1));
    EXPECT_LT(lowest_point(cone, std::cos(after)), 2 * (std::cos(after) - 1) - 0.1);
}

}  // namespace
}  // namespace qchopper
