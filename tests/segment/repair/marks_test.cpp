#include "segment/repair/marks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "segment/error.h"
#include "segment/mesh/edges.h"
#include "segment/sample/draw_marks.h"
#include "segment/sample/sample.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

struct Marked {
    TriangleMesh clean;
    TriangleMesh mesh;
    DrawnMarks drawn;
};

Marked marked(TriangleMesh clean, int marks) {
    Marked m{clean, std::move(clean), {}};
    DrawOptions options;
    options.marks = marks;
    m.drawn = draw_marks(m.mesh, options);
    return m;
}

Marked marked_sample(Specimen specimen) {
    SampleOptions options;
    options.faces = 200'000;
    return marked(sample(specimen, options), 6);
}

// What a person at the scanner knows of the pen: about how wide, and never half as deep again.
MarkOptions options_for(const DrawnMarks& drawn) {
    MarkOptions options;
    options.most_width = 1.25 * drawn.width;
    options.most_depth = 1.5 * drawn.depth;
    return options;
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

// Of all points that were drawn inwards, the share of the depth that is gone, and the share that nothing stands for any
// more: neither depth that is left nor points that are lifted too far or sideways.
struct Removed {
    double depth = 0;
    double error = 0;
};

Removed removed(const Marked& m, const TriangleMesh& smoothed) {
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

void expect_only_marks_moved(const Marked& m, const TriangleMesh& smoothed) {
    EXPECT_EQ(smoothed.triangles, m.mesh.triangles);
    for (std::size_t i = 0; i < smoothed.points.size(); ++i) {
        if (smoothed.points[i] == m.mesh.points[i]) continue;
        ASSERT_LE(distance_to(m.drawn.lines, m.clean.points[i]), 3 * m.drawn.width) << "point " << i;
    }
}

void expect_marks_lifted(const Marked& m, double least_depth, double least_error) {
    TriangleMesh smoothed = m.mesh;
    const MarkReport report = smooth_marks(smoothed, options_for(m.drawn));
    const Removed gone = removed(m, smoothed);
    EXPECT_GE(gone.depth, least_depth);
    EXPECT_GE(gone.error, least_error);
    EXPECT_GT(report.marks, 0U);
    EXPECT_GT(report.area_mm2, 0);
    EXPECT_LE(report.most_depth, 1.5 * m.drawn.depth);
    EXPECT_GE(report.most_depth, 0.8 * m.drawn.depth);
    EXPECT_LE(report.mean_depth, report.most_depth);
    EXPECT_TRUE(edges(smoothed).faults.is_closed());
    expect_only_marks_moved(m, smoothed);
    TriangleMesh clean = m.clean;
    EXPECT_EQ(smooth_marks(clean, options_for(m.drawn)).points_moved, 0U);
    EXPECT_EQ(clean, m.clean) << "without marks nothing moves";
}

TEST(Marks, OfABallAreLifted) {
    expect_marks_lifted(marked(shapes::ball({0, 0, 0}, 200, 250), 4), 0.95, 0.95);
}

TEST(Marks, OfAVertebraAreLiftedAndTheBoneIsLeftAlone) {
    expect_marks_lifted(marked_sample(Specimen::vertebra), 0.8, 0.75);
}

TEST(Marks, OfAFemurAreLiftedAndTheBoneIsLeftAlone) {
    expect_marks_lifted(marked_sample(Specimen::femur), 0.8, 0.8);
}

TEST(Marks, OfASkullAreLiftedAndTheBoneIsLeftAlone) {
    expect_marks_lifted(marked_sample(Specimen::skull), 0.8, 0.75);
}

TEST(Marks, ShapesWithoutMarksKeepEveryBit) {
    for (const shapes::Named& shape : shapes::all_closed()) {
        TriangleMesh mesh = shape.mesh;
        MarkOptions options;
        options.most_width = 3;
        smooth_marks(mesh, options);
        EXPECT_EQ(mesh, shape.mesh) << shape.name;
    }
}

TEST(Marks, OfTrianglesLargerThanALineNothingIsSaid) {
    TriangleMesh ball = shapes::ball({0, 0, 0}, 200, 20);
    const TriangleMesh before = ball;
    EXPECT_TRUE(smooth_marks(ball).is_too_coarse);
    EXPECT_EQ(ball, before);
}

TEST(Marks, ANoiseIsNoMark) {
    TriangleMesh ball = shapes::ball({0, 0, 0}, 200, 250);
    std::uint32_t state = 1;
    for (Vec3& p : ball.points) {
        state = state * 1664525 + 1013904223;
        p = (1 + 2e-6 * (static_cast<double>(state >> 16) / 65536 - 0.5)) * p;
    }
    const TriangleMesh before = ball;
    MarkOptions options;
    options.most_width = 12;
    smooth_marks(ball, options);
    EXPECT_EQ(ball, before);
}

TEST(Marks, MeasuresThatMakeNoSenseAreRefused) {
    TriangleMesh ball = shapes::ball({0, 0, 0}, 20);
    for (const double width : {0.0, -1.0, double(NAN), double(INFINITY)}) {
        MarkOptions options;
        options.most_width = width;
        EXPECT_THROW(smooth_marks(ball, options), InputError);
    }
}

}  // namespace
}  // namespace qchopper
