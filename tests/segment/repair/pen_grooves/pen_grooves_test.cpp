#include "segment/repair/pen_grooves/pen_grooves.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <random>
#include <utility>

#include "base/error.h"
#include "segment/io/read_mesh.h"
#include "segment/mesh/connectivity/edges.h"
#include "segment/mesh/measure.h"
#include "segment/repair/weld.h"
#include "segment/sample/draw_pen_grooves.h"
#include "segment/sample/sample.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

struct Grooved {
    TriangleMesh clean;
    TriangleMesh mesh;
    DrawnPenGrooves drawn;
};

Grooved grooved(TriangleMesh clean, int pen_grooves) {
    Grooved m{clean, std::move(clean), {}};
    DrawOptions options;
    options.pen_grooves = pen_grooves;
    m.drawn = draw_pen_grooves(m.mesh, options);
    return m;
}

Grooved grooved_sample(Specimen specimen) {
    SampleOptions options;
    options.faces = 200'000;
    return grooved(sample(specimen, options), 6);
}

// What the operator of the scanner can estimate of the pen: the width within 25 %, the depth within 50 %.
PenGrooveOptions options_for(const DrawnPenGrooves& drawn) {
    PenGrooveOptions options;
    options.max_width = 1.25 * drawn.width;
    options.max_depth = 1.5 * drawn.depth;
    return options;
}

// Every triangle in four, at the middles of its edges.
TriangleMesh subdivided(const TriangleMesh& mesh) {
    TriangleMesh result;
    result.points = mesh.points;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middle_of;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
        const auto [at, is_new] =
            middle_of.insert({std::minmax(a, b), static_cast<std::uint32_t>(result.points.size())});
        if (is_new) result.points.push_back(0.5 * (mesh.points[a] + mesh.points[b]));
        return at->second;
    };
    for (const auto& [a, b, c] : mesh.triangles) {
        const std::uint32_t ab = middle(a, b);
        const std::uint32_t bc = middle(b, c);
        const std::uint32_t ca = middle(c, a);
        for (const Triangle& t : {Triangle{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}}) {
            result.triangles.push_back(t);
        }
    }
    return result;
}

double distance_to(const std::vector<std::vector<Vec3>>& lines, Vec3 p) {
    double best = INFINITY;
    for (const auto& line : lines) {
        for (std::size_t i = 0; i + 1 < line.size(); ++i) {
            const Vec3 along = line[i + 1] - line[i];
            const double at = std::clamp(dot(p - line[i], along) / std::max(dot(along, along), 1e-300), 0.0, 1.0);
            best = std::min(best, norm(p - line[i] - at * along));
        }
    }
    return best;
}

// Of all points that were drawn inwards, the share of the depth that is removed, and the share of the distance from the
// clean surface that is removed: points lifted too far or sideways count as not removed.
struct Removed {
    double depth = 0;
    double error = 0;
};

Removed removed(const Grooved& m, const TriangleMesh& smoothed) {
    double before = 0;
    double depth_left = 0;
    double error_left = 0;
    for (std::size_t i = 0; i < m.mesh.points.size(); ++i) {
        const Vec3 up = m.clean.points[i] - m.mesh.points[i];
        const double depth = norm(up);
        if (depth == 0) continue;
        const Vec3 missing = m.clean.points[i] - smoothed.points[i];
        before += depth;
        depth_left += std::max(0.0, dot(missing, up) / depth);
        error_left += norm(missing);
    }
    return before > 0 ? Removed{1 - depth_left / before, 1 - error_left / before} : Removed{};
}

void expect_only_pen_grooves_moved(const Grooved& m, const TriangleMesh& smoothed) {
    EXPECT_EQ(smoothed.triangles, m.mesh.triangles);
    for (std::size_t i = 0; i < smoothed.points.size(); ++i) {
        if (smoothed.points[i] == m.mesh.points[i]) continue;
        ASSERT_LE(distance_to(m.drawn.lines, m.clean.points[i]), 3 * m.drawn.width) << "point " << i;
    }
}

void expect_pen_grooves_lifted(const Grooved& m, double min_depth, double min_error) {
    TriangleMesh smoothed = m.mesh;
    const PenGrooveReport report = smooth_pen_grooves(smoothed, options_for(m.drawn));
    const Removed gone = removed(m, smoothed);
    EXPECT_GE(gone.depth, min_depth);
    EXPECT_GE(gone.error, min_error);
    EXPECT_GT(report.count, 0U);
    EXPECT_GT(report.area_mm2, 0);
    EXPECT_LE(report.max_depth, 1.5 * m.drawn.depth);
    EXPECT_GE(report.max_depth, 0.8 * m.drawn.depth);
    EXPECT_LE(report.mean_depth, report.max_depth);
    EXPECT_TRUE(edges(smoothed).faults.is_closed());
    expect_only_pen_grooves_moved(m, smoothed);
    TriangleMesh clean = m.clean;
    EXPECT_EQ(smooth_pen_grooves(clean, options_for(m.drawn)).points_moved, 0U);
    EXPECT_EQ(clean, m.clean) << "without pen grooves nothing moves";
}

TEST(PenGrooves, OfABallAreLifted) {
    expect_pen_grooves_lifted(grooved(shapes::ball({0, 0, 0}, 200, 250), 4), 0.95, 0.95);
}

TEST(PenGrooves, OfAVertebraAreLiftedAndTheBoneIsLeftAlone) {
    expect_pen_grooves_lifted(grooved_sample(Specimen::vertebra), 0.8, 0.75);
}

TEST(PenGrooves, OfAFemurAreLiftedAndTheBoneIsLeftAlone) {
    expect_pen_grooves_lifted(grooved_sample(Specimen::femur), 0.8, 0.8);
}

TEST(PenGrooves, OfASkullAreLiftedAndTheBoneIsLeftAlone) {
    expect_pen_grooves_lifted(grooved_sample(Specimen::skull), 0.8, 0.75);
}

// As large as a bone, with triangles small enough for a line of a pen.
TriangleMesh fine(const TriangleMesh& shape) {
    constexpr double diagonal = 120;
    constexpr double longest = 2;
    TriangleMesh mesh = shape;
    const Box box = bounds(shape);
    for (Vec3& p : mesh.points) p = (diagonal / norm(box.size())) * (p - box.centre());
    for (bool is_any = true; is_any;) {
        is_any = false;
        for (const Triangle& t : mesh.triangles) {
            for (std::size_t k = 0; k < 3; ++k) {
                is_any = is_any || norm(mesh.points[t[(k + 1) % 3]] - mesh.points[t[k]]) > longest;
            }
        }
        if (is_any) mesh = subdivided(mesh);
    }
    return mesh;
}

TEST(PenGrooves, ShapesWithoutPenGroovesKeepEveryBit) {
    std::vector<shapes::Named> all = shapes::all_closed();
    for (shapes::Named& shape : all) {
        // Facets as wide as a line, with a crease on both sides, lie below a smooth surface as a line does
        // (docs/user/repair.md): so these balls are round.
        if (shape.name != "two balls") continue;
        shape.mesh = shapes::joined({shapes::ball({0, 0, 0}, 10, 60), shapes::ball({0, 0, 30}, 12, 60)});
    }
    for (const shapes::Named& shape : all) {
        const TriangleMesh before = fine(shape.mesh);
        TriangleMesh mesh = before;
        const PenGrooveReport report = smooth_pen_grooves(mesh);
        EXPECT_FALSE(report.is_too_coarse) << shape.name;
        EXPECT_EQ(report.count, 0U) << shape.name << ", up to " << report.max_depth << " mm";
        EXPECT_TRUE(mesh == before) << shape.name;
    }
}

TEST(PenGrooves, OnTrianglesLargerThanALineNothingIsSearched) {
    TriangleMesh ball = shapes::ball({0, 0, 0}, 200, 20);
    const TriangleMesh before = ball;
    EXPECT_TRUE(smooth_pen_grooves(ball).is_too_coarse);
    EXPECT_EQ(ball, before);
}

// From below the least depth of a pen groove on an even surface to ten times as much.
TEST(PenGrooves, ANoiseIsNoPenGroove) {
    const TriangleMesh ball = shapes::ball({0, 0, 0}, 40, 100);
    for (const double sigma_mm : {0.002, 0.02, 0.05, 0.1, 0.2}) {
        std::mt19937 random(1);
        std::normal_distribution<double> noise(0, sigma_mm);
        TriangleMesh noisy = ball;
        for (Vec3& p : noisy.points) p = (1 + noise(random) / 40) * p;
        const TriangleMesh before = noisy;
        const PenGrooveReport report = smooth_pen_grooves(noisy);
        EXPECT_FALSE(report.is_too_coarse);
        EXPECT_EQ(report.count, 0U) << sigma_mm;
        EXPECT_TRUE(noisy == before) << sigma_mm;
    }
}

// A line in the same noise is still found where it is deep enough.
TEST(PenGrooves, ALineInANoiseIsAPenGroove) {
    for (const double sigma_mm : {0.002, 0.02}) {
        Grooved m = grooved(shapes::ball({0, 0, 0}, 60, 150), 2);
        std::mt19937 random(1);
        std::normal_distribution<double> noise(0, sigma_mm);
        for (std::size_t i = 0; i < m.mesh.points.size(); ++i) {
            const double by = noise(random) / 60;
            m.mesh.points[i] = (1 + by) * m.mesh.points[i];
            m.clean.points[i] = (1 + by) * m.clean.points[i];
        }
        TriangleMesh smoothed = m.mesh;
        EXPECT_GT(smooth_pen_grooves(smoothed).count, 0U) << sigma_mm;
        EXPECT_GE(removed(m, smoothed).depth, 0.7) << sigma_mm;
    }
}

TEST(PenGrooves, OfARealScanWithoutInkTheDefaultsLiftNothing) {
    const std::filesystem::path path = std::filesystem::path(QCHOPPER_MESHES) / "bunny_bun_zipper.ply";
    if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not here";
    TriangleMesh mesh = read_mesh(path).mesh;
    weld(mesh);
    for (Vec3& p : mesh.points) p = 1000 * p;  // the file is in metres
    const TriangleMesh before = mesh;
    const PenGrooveReport report = smooth_pen_grooves(mesh);
    EXPECT_FALSE(report.is_too_coarse);
    EXPECT_EQ(report.count, 0U) << report.max_depth;
    EXPECT_TRUE(mesh == before);
}

TEST(PenGrooves, MeasuresThatMakeNoSenseAreRefused) {
    TriangleMesh ball = shapes::ball({0, 0, 0}, 20);
    for (const double width : {0.0, -1.0, double(NAN), double(INFINITY)}) {
        PenGrooveOptions options;
        options.max_width = width;
        EXPECT_THROW(smooth_pen_grooves(ball, options), InputError);
    }
}

}  // namespace
}  // namespace qchopper
