#include "segment/repair/repair.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>
#include <limits>
#include <random>

#include "base/error.h"
#include "segment/mesh/connectivity/edges.h"
#include "segment/mesh/measure.h"
#include "segment/repair/options.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

struct Damage {
    std::string name;
    std::function<TriangleMesh(TriangleMesh)> damage;
};

TriangleMesh unwelded(const TriangleMesh& mesh) {
    TriangleMesh soup;
    for (const Triangle& t : mesh.triangles) {
        for (const std::uint32_t v : t) soup.points.push_back(mesh.points[v]);
        const auto first = static_cast<std::uint32_t>(soup.points.size() - 3);
        soup.triangles.push_back({first, first + 1, first + 2});
    }
    return soup;
}

// What is done to every shape, and must be undone.
std::vector<Damage> damages() {
    return {{"nothing", [](TriangleMesh mesh) { return mesh; }},
            {"unwelded", unwelded},
            {"inside out", shapes::turned_inside_out},
            {"turned here and there",
             [](TriangleMesh mesh) {
                 std::mt19937 random(1);
                 for (Triangle& t : mesh.triangles) {
                     if (random() % 3 == 0) std::swap(t[0], t[1]);
                 }
                 return mesh;
             }},
            {"a face missing",
             [](TriangleMesh mesh) {
                 mesh.triangles.erase(mesh.triangles.begin() + static_cast<std::ptrdiff_t>(mesh.triangles.size() / 3));
                 return mesh;
             }},
            {"faces repeated both ways",
             [](TriangleMesh mesh) {
                 for (std::size_t t = 0; t < 4; ++t) {
                     const Triangle face = mesh.triangles[t];
                     mesh.triangles.push_back(t % 2 == 0 ? face : Triangle{face[0], face[2], face[1]});
                 }
                 return mesh;
             }},
            {"a small fin",
             [](TriangleMesh mesh) {
                 const Triangle face = mesh.triangles.front();
                 const Vec3 a = mesh.points[face[0]];
                 mesh.points.push_back(a + 1e-3 * normalized(area_vector(mesh, 0)));
                 mesh.triangles.push_back({face[0], face[1], static_cast<std::uint32_t>(mesh.points.size() - 1)});
                 return mesh;
             }},
            {"collapsed faces and unused points", [](TriangleMesh mesh) {
                 mesh.points.push_back({1, 2, 3});
                 mesh.triangles.push_back({0, 0, 1});
                 return mesh;
             }}};
}

TEST(Repair, EveryDamagedShapeBecomesTheSolidThatItWasAndTwiceIsOnce) {
    for (const shapes::Named& shape : shapes::all_closed()) {
        for (const Damage& damage : damages()) {
            SCOPED_TRACE(shape.name + ", " + damage.name);
            const Repaired once = repair(damage.damage(shape.mesh));
            EXPECT_TRUE(once.report.is_solid());
            EXPECT_TRUE(edges(once.mesh).faults.is_closed());
            EXPECT_NEAR(volume_mm3(once.mesh) / volume_mm3(shape.mesh), 1, 1e-9);
            EXPECT_EQ(once.mesh.triangles.size(), shape.mesh.triangles.size());
            const Repaired twice = repair(once.mesh);
            EXPECT_EQ(twice.mesh, once.mesh);
            EXPECT_EQ(twice.report.faces_gone + twice.report.faces_new, 0U);
        }
    }
}

TEST(Repair, WhatNoStepTouchesKeepsBitsAndOrder) {
    for (const shapes::Named& shape : shapes::all_closed()) {
        TriangleMesh open = shape.mesh;
        open.triangles.pop_back();
        const Repaired result = repair(open);
        ASSERT_EQ(result.mesh.triangles.size(), shape.mesh.triangles.size()) << shape.name;
        EXPECT_EQ(result.mesh.points, shape.mesh.points) << shape.name;
        EXPECT_TRUE(std::equal(open.triangles.begin(), open.triangles.end(), result.mesh.triangles.begin()))
            << shape.name;
        EXPECT_EQ(result.report.faces_gone, 0U);
        EXPECT_EQ(result.report.faces_new, 1U);
        EXPECT_TRUE(result.mesh.cap_of.empty());
    }
}

TEST(Repair, StepsComeInTheirOrderWithWordsAndCounts) {
    const std::vector<RepairStep> all = steps(repair(shapes::ball({0, 0, 0}, 10)).report);
    std::vector<std::string> names;
    for (const RepairStep& step : all) {
        names.push_back(step.name);
        EXPECT_EQ(step.count, 0U) << step.name;
    }
    EXPECT_EQ(names, (std::vector<std::string>{"weld", "snap_borders", "faces", "split", "orient", "stitch",
                                               "degenerate", "fill", "orient_outward", "fragments", "resolve",
                                               "pen_grooves", "alpha_wrap"}));
}

TEST(Repair, StepsCanBeLeftOut) {
    const TriangleMesh ball = shapes::ball({0, 0, 0}, 10);
    RepairOptions options;
    options.orient_outward = false;
    EXPECT_LT(repair(shapes::turned_inside_out(ball), options).report.volume, 0);
    options = {};
    options.fill.fill = Fill::none;
    TriangleMesh open = ball;
    open.triangles.pop_back();
    const Repaired left = repair(open, options);
    EXPECT_EQ(left.report.left_open.size(), 1U);
    EXPECT_EQ(left.report.open_edges, 3U);
    EXPECT_FALSE(left.report.is_solid());
    options = {};
    options.split = false;
    TriangleMesh turned = ball;
    std::swap(turned.triangles[7][0], turned.triangles[7][1]);
    EXPECT_EQ(repair(turned, options).report.open_edges, 3U);
    options = {};
    options.drop_repeated = false;
    TriangleMesh repeated = ball;
    repeated.triangles.push_back(ball.triangles[0]);
    EXPECT_EQ(repair(repeated, options).report.repeated, 0U);
}

TEST(Repair, DropsFragmentsOnlyWhenAsked) {
    const TriangleMesh mesh = shapes::joined({shapes::ball({0, 0, 0}, 10), shapes::ball({20, 0, 0}, 0.01)});
    EXPECT_EQ(repair(mesh).mesh, mesh);
    EXPECT_EQ(repair(mesh).report.fragments, 1U);
    RepairOptions options;
    options.drop_fragments = true;
    EXPECT_EQ(repair(mesh, options).mesh, shapes::ball({0, 0, 0}, 10));
}

TEST(Repair, LargeHolesAreFairedAndSmallOnesFilledFlat) {
    TriangleMesh ball = shapes::ball({0, 0, 0}, 10, 24);
    std::erase_if(ball.triangles, [&](const Triangle& t) {
        return std::all_of(t.begin(), t.end(), [&](std::uint32_t v) { return ball.points[v].z > 7; });
    });
    const Repaired fair = repair(ball);
    EXPECT_EQ(fair.report.holes_faired, 1U);
    EXPECT_GT(fair.report.points_added, 0U);
    EXPECT_NEAR(fair.report.volume, 4150, 60);  // the whole ball is back, nearly
    EXPECT_EQ(repair(fair.mesh).mesh, fair.mesh);
    RepairOptions options;
    options.fill.fill = Fill::flat;
    const Repaired flat = repair(ball, options);
    EXPECT_EQ(flat.report.holes_faired + flat.report.points_added, 0U);
    EXPECT_LT(flat.report.volume, 4000);
    TriangleMesh small = shapes::ball({0, 0, 0}, 10, 24);
    small.triangles.erase(small.triangles.begin() + 500, small.triangles.begin() + 502);
    EXPECT_EQ(repair(small).report.holes_faired, 0U);
    options.fill.fill = Fill::fair;
    EXPECT_EQ(repair(small, options).report.holes_faired, 1U);
}

TEST(Repair, MeasuresTheDistanceInMillimetres) {
    TriangleMesh ball = shapes::ball({0, 0, 0}, 10, 12);
    std::erase_if(ball.triangles, [&](const Triangle& t) {
        return std::all_of(t.begin(), t.end(), [&](std::uint32_t v) { return ball.points[v].z > 8; });
    });
    RepairOptions options;
    options.fill.fill = Fill::flat;
    options.measure_deviation = true;
    const double in_mm = repair(ball, options).report.deviation->largest().mm;
    EXPECT_GT(in_mm, 0.1);
    options.mm_per_unit = 1000;
    EXPECT_NEAR(repair(ball, options).report.deviation->largest().mm / in_mm, 1000, 20);
    EXPECT_EQ(repair(shapes::ball({0, 0, 0}, 10), options).report.deviation->largest().triangles, 0U);
}

// An open component coincides with what fills it flat: its distance is certain only after millions of points.
TEST(Repair, OfWhatIsRefusedNoDistanceIsMeasured) {
    TriangleMesh open_component;
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 5; ++column) open_component.points.push_back({double(row), double(column), 0});
    }
    for (const std::uint32_t a : {0U, 1U, 2U, 3U, 5U, 6U, 7U, 8U}) {
        open_component.triangles.push_back({a, a + 5, a + 6});
        open_component.triangles.push_back({a, a + 6, a + 1});
    }
    RepairOptions options;
    options.measure_deviation = true;
    const Repaired refused = repair(open_component, options);
    EXPECT_EQ(refused.report.open_components_left, 1U);
    EXPECT_FALSE(refused.report.deviation.has_value());
    options.fill.fill = Fill::none;
    EXPECT_TRUE(repair(open_component, options).report.deviation.has_value())
        << "what may stay open is written, and measured";
}

TEST(Repair, LengthsAreMillimetres) {
    const TriangleMesh box = shapes::box({0, 0, 0}, {1, 1, 1}, 2);
    TriangleMesh torn = unwelded(box);
    for (std::size_t v = 0; v < 12; ++v) torn.points[v].x += 1e-4;
    RepairOptions options;
    options.snap_borders_mm = 0.2;
    options.mm_per_unit = 1000;  // the gap is 0.1 mm
    EXPECT_GT(repair(torn, options).report.borders_snapped, 0U);
    options.snap_borders_mm = 0.05;
    EXPECT_EQ(repair(torn, options).report.borders_snapped, 0U);
    for (const double wrong : {-1.0, std::numeric_limits<double>::infinity(), std::nan("")}) {
        options.snap_borders_mm = wrong;
        EXPECT_THROW(repair(torn, options), InputError);
    }
}

TEST(Repair, ResolvesOnlyWhenAskedAndStaysASolid) {
    TriangleMesh ball = shapes::ball({0, 0, 0}, 10, 24);
    ball.points[200] = ball.points[201] + 0.6 * (ball.points[201] - ball.points[200]);  // over its neighbour
    EXPECT_FALSE(repair(ball).report.resolved.has_value());
    EXPECT_EQ(repair(ball).mesh, ball);
    RepairOptions options;
    options.resolve_self_intersections = true;
    const Repaired result = repair(ball, options);
    ASSERT_TRUE(result.report.resolved.has_value());
    EXPECT_GT(result.report.resolved->pairs, 0U);
    EXPECT_LE(result.report.resolved->left, result.report.resolved->pairs);
    EXPECT_TRUE(result.report.is_solid());
    EXPECT_EQ(repair(result.mesh, options).mesh, result.mesh);
}

TEST(Repair, FindsPenGroovesOnlyWhenAsked) {
    const TriangleMesh ball = shapes::ball({0, 0, 0}, 40, 96);
    EXPECT_FALSE(repair(ball).report.pen_grooves.has_value());
    RepairOptions options;
    options.smooth_pen_grooves = true;
    const Repaired result = repair(ball, options);
    ASSERT_TRUE(result.report.pen_grooves.has_value());
    EXPECT_EQ(result.report.pen_grooves->count, 0U);
    EXPECT_EQ(result.mesh, ball);
}

TEST(Repair, WrapsOnlyWhenAskedAndMeasuresTheDistance) {
    TriangleMesh soup = unwelded(shapes::ball({0, 0, 0}, 10, 12));
    std::mt19937 random(2);
    std::uniform_real_distribution<double> noise(-0.2, 0.2);
    for (Vec3& p : soup.points) p = p + Vec3{noise(random), noise(random), noise(random)};
    EXPECT_FALSE(repair(soup).report.is_solid());
    RepairOptions options;
    options.alpha_wrap_mm = 2;
    options.measure_deviation = true;
    const Repaired wrapped = repair(soup, options);
    EXPECT_TRUE(wrapped.report.is_solid());
    EXPECT_EQ(wrapped.report.faces_gone, wrapped.report.faces_in);
    EXPECT_GT(wrapped.report.deviation->largest().mm, 0);
    EXPECT_LT(wrapped.report.deviation->largest().mm, 2);
    EXPECT_NEAR(wrapped.report.volume, 4189, 400);
}

TEST(Repair, NothingIsNoSolid) {
    EXPECT_FALSE(repair({}).report.is_solid());
    TriangleMesh lines = shapes::box({0, 0, 0}, {1, 1, 1});
    lines.triangles = {{0, 1, 0}, {1, 1, 1}};
    EXPECT_TRUE(repair(lines).mesh.triangles.empty());
}

TEST(Repair, StopsWhenAsked) {
    const std::atomic<bool> stop = true;
    Context context;
    context.cancelled = &stop;
    EXPECT_THROW(repair(shapes::ball({0, 0, 0}, 1), {}, context), Cancelled);
}

TEST(Repair, FillsHaveNames) {
    for (const Fill fill : {Fill::by_size, Fill::flat, Fill::fair, Fill::none}) {
        EXPECT_EQ(fill_named(name_of(fill)), fill);
    }
    EXPECT_EQ(fill_named("putty"), std::nullopt);
}

}  // namespace
}  // namespace qchopper
