#include "segment/structure/stress.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/error.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

// Foam: 0.1 g/cm3.
StructureOptions foam(double voxel_mm) {
    StructureOptions o;
    o.up = {0, 0, 1};
    o.density_kg_per_m3 = 100;
    o.strength_mpa = 0.5;
    o.voxel_mm = voxel_mm;
    return o;
}

// The mean of the vertical stress of the voxels whose centres are at this height.
double mean_at(const StressedModel& m, double z) {
    double sum = 0;
    int count = 0;
    for (std::size_t i = 0; i < m.voxels.size(); ++i) {
        if (std::abs(m.grid.centre(m.voxels[i]).z - z) > 1e-6) continue;
        sum += m.stress[i].zz;
        ++count;
    }
    return sum / count;
}

TEST(Stress, OfABarIsTheWeightAboveAndTheForceOnTop) {
    const TriangleMesh bar = shapes::box({0, 0, 0}, {50, 40, 200});
    StructureOptions o = foam(10);
    const double per_mm = 100 * 9.80665 * 1e-9;  // MPa per mm of height
    const StressedModel weight = stress_of(bar, o, {});
    EXPECT_EQ(weight.voxels.size(), 400U);
    EXPECT_NEAR(mean_at(weight, 55) / (-145 * per_mm), 1, 1e-3);
    o.force_n = 30;
    EXPECT_NEAR(mean_at(stress_of(bar, o, {}), 55) / (-145 * per_mm - 30.0 / 2000), 1, 1e-3);
    o.has_own_weight = false;
    EXPECT_NEAR(mean_at(stress_of(bar, o, {}), 55) / (-30.0 / 2000), 1, 1e-3);
}

TEST(Stress, TurnsWithTheModel) {
    const double angle = 0.7;
    const TriangleMesh bar = shapes::box({0, 0, 0}, {30, 30, 120});
    StructureOptions o = foam(10);
    const StressedModel upright = stress_of(bar, o, {});
    o.up = {0, -std::sin(angle), std::cos(angle)};
    const StressedModel turned = stress_of(shapes::rotated(bar, {1, 0, 0}, angle), o, {});
    ASSERT_EQ(turned.voxels.size(), upright.voxels.size());
    double along_upright = 0;
    double along_turned = 0;
    for (std::size_t i = 0; i < upright.stress.size(); ++i) {
        along_upright += dot({0, 0, 1}, traction(upright.stress[i], {0, 0, 1}));
        along_turned += dot(o.up, traction(turned.stress[i], o.up));
    }
    EXPECT_NEAR(along_turned / along_upright, 1, 1e-5);
}

TEST(Stress, OfAnArmThatSticksOutIsTensionAboveAndCompressionBelow) {
    const TriangleMesh post = shapes::box({0, 0, 0}, {40, 40, 200});
    const TriangleMesh arm = shapes::box({39, 0, 160}, {200, 40, 200});
    const StressedModel m = stress_of(shapes::joined({post, arm}), foam(10), {});
    for (std::size_t i = 0; i < m.voxels.size(); ++i) {
        const Vec3 c = m.grid.centre(m.voxels[i]);
        if (c.x < 60 || c.x > 150) continue;
        EXPECT_EQ(m.stress[i].xx > 0, c.z > 180);
    }
    EXPECT_GT(m.report.largest_tension_mpa, 0);
    EXPECT_EQ(m.report.largest_tension_at.x, 5) << "the back of the post, which carries the moment";
    EXPECT_EQ(m.report.thin_voxels, 0U);
    EXPECT_EQ(m.report.hinges, 0U);
}

TEST(Stress, WhatFloatsIsReportedAndHasNone) {
    const TriangleMesh post = shapes::box({0, 0, 0}, {40, 40, 100});
    const TriangleMesh far = shapes::box({80, 0, 60}, {110, 30, 90});
    const TriangleMesh hinged = shapes::box({40, 40, 50}, {60, 60, 70});  // they share an upright edge
    const StressedModel m = stress_of(shapes::joined({post, far, hinged}), foam(10), {});
    ASSERT_EQ(m.report.floating.size(), 2U);
    EXPECT_EQ(m.report.floating[0].voxels, 27U);
    EXPECT_FALSE(m.report.floating[0].is_hinged);
    EXPECT_LT(norm(m.report.floating[0].centre - Vec3{95, 15, 75}), 1e-9);
    EXPECT_EQ(m.report.floating[1].voxels, 8U);
    EXPECT_TRUE(m.report.floating[1].is_hinged);
    EXPECT_EQ(m.report.standing_voxels, 160U);
    for (std::size_t i = 0; i < m.voxels.size(); ++i) {
        const Vec3 c = m.grid.centre(m.voxels[i]);
        EXPECT_EQ(m.stress[i] == Stress{}, c.x > 40);
    }
}

TEST(Stress, TwoFeetOnTheGroundBothStand) {
    const TriangleMesh a = shapes::box({0, 0, 0}, {40, 40, 100});
    const TriangleMesh b = shapes::box({80, 0, 0}, {120, 40, 60});
    const StressedModel m = stress_of(shapes::joined({a, b}), foam(10), {});
    EXPECT_TRUE(m.report.floating.empty());
    EXPECT_EQ(m.report.standing_voxels, 160U + 96U);
}

TEST(Stress, VoxelsThatStandAndMeetByAnEdgeOnlyAreHinges) {
    // An arch of boxes: foot, side, and a second side that meets the first one along an upright edge only above.
    const TriangleMesh foot = shapes::box({0, 0, 0}, {40, 40, 20});
    const TriangleMesh a = shapes::box({0, 0, 19}, {20, 20, 60});
    const TriangleMesh b = shapes::box({20, 20, 19}, {40, 40, 60});
    const StressedModel m = stress_of(shapes::joined({foot, a, b}), foam(10), {});
    EXPECT_TRUE(m.report.floating.empty());
    EXPECT_EQ(m.report.hinges, 4U) << "at heights 30, 40, 50 and 60: at 20 the foot joins them";
}

TEST(Stress, WallsUnderThreeVoxelsAreCounted) {
    const StressedModel m = stress_of(shapes::box({0, 0, 0}, {20, 60, 80}), foam(10), {});
    EXPECT_EQ(m.report.thin_voxels, m.report.standing_voxels);
    EXPECT_EQ(stress_of(shapes::box({0, 0, 0}, {30, 60, 80}), foam(10), {}).report.thin_voxels, 0U);
}

TEST(Stress, TheVoxelsAreAsFineAsTheUnknownsAllow) {
    StructureOptions o = foam(0);
    for (const std::size_t unknowns : {2'000U, 20'000U}) {
        o.unknowns = unknowns;
        const StressedModel m = stress_of(shapes::torus({0, 0, 0}, 300, 80), o, {});
        EXPECT_LE(m.report.unknowns, unknowns);
        EXPECT_GE(m.report.unknowns, unknowns * 3 / 4) << "some are held";
        EXPECT_LE(m.report.residual, structure_residual);
        EXPECT_GT(m.report.iterations, 10U);
    }
}

TEST(Stress, OptionsOutOfRangeAreRefused) {
    const TriangleMesh bar = shapes::box({0, 0, 0}, {30, 30, 30});
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const auto refuses = [&](auto change) {
        StructureOptions o = foam(10);
        change(o);
        EXPECT_THROW(stress_of(bar, o, {}), InputError);
    };
    refuses([](StructureOptions& o) { o.up = {}; });
    refuses([&](StructureOptions& o) { o.up = {nan, 0, 1}; });
    refuses([](StructureOptions& o) { o.density_kg_per_m3 = 0; });
    refuses([&](StructureOptions& o) { o.strength_mpa = nan; });
    refuses([](StructureOptions& o) { o.force_n = -1; });
    refuses([](StructureOptions& o) { o.has_own_weight = false; });
    refuses([](StructureOptions& o) { o.poisson_ratio = 0.5; });
    refuses([](StructureOptions& o) { o.voxel_mm = -1; });
    refuses([](StructureOptions& o) { o.voxel_mm = 1e-4; });
    refuses([](StructureOptions& o) { o.voxel_mm = 200; });  // no centre lies inside
}

}  // namespace
}  // namespace qchopper
