#include "segment/objectives/symmetry_plane.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/parallel.h"
#include "segment/access/surface_samples.h"
#include "segment/cut/cut.h"
#include "segment/mesh/measure.h"
#include "segment/sample/sample.h"
#include "tests/reference/segment/objectives/symmetry_score.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

double degrees(Vec3 a, Vec3 b) {
    return std::acos(std::min(1.0, std::abs(dot(a, b)))) * 180 / std::numbers::pi;
}

// Symmetric about x = 0.
TriangleMesh vertebra() {
    SampleOptions options;
    options.faces = 20'000;
    return sample(Specimen::vertebra, options);
}

const Vec3 turn_axis = normalized({1, 2, 3});

Vec3 turned(Vec3 p, double angle) {
    return std::cos(angle) * p + std::sin(angle) * cross(turn_axis, p) +
           (1 - std::cos(angle)) * dot(turn_axis, p) * turn_axis;
}

TriangleMesh turned(TriangleMesh mesh, double angle) {
    for (Vec3& p : mesh.points) p = turned(p, angle);
    return mesh;
}

TEST(SymmetryPlane, OfATurnedSymmetricSpecimenIsRightToAFifthOfADegree) {
    for (const double angle : {0.4, 2.3}) {
        const TriangleMesh scan = shapes::moved(turned(vertebra(), angle), {30, -20, 70});
        const std::optional<SymmetryPlane> found = symmetry_plane(scan);
        ASSERT_TRUE(found);
        const Vec3 normal = turned({1, 0, 0}, angle);
        EXPECT_LT(degrees(found->plane.normal, normal), 0.2) << angle;
        EXPECT_NEAR(dot(found->plane.normal, Vec3{30, -20, 70}), found->plane.offset, 0.5) << angle;
        EXPECT_EQ(canonical(found->plane), found->plane);
        EXPECT_TRUE(found->is_symmetric()) << found->ratio();
    }
}

TEST(SymmetryPlane, WithATenthOfTheSpecimenMissingIsRightToADegree) {
    const TriangleMesh whole = vertebra();
    const Box box = bounds(whole);
    for (const Vec3 side : {normalized({1, 0.3, 0.2}), normalized({-1, -0.5, 0.4})}) {
        // Cut off a tenth of the volume on one side.
        double low = -norm(box.size());
        double high = -low;
        for (int i = 0; i < 40; ++i) {
            const double middle = (low + high) / 2;
            const auto halves = cut(whole, {side, middle}, 1);
            const double off = halves ? volume_mm3(halves->above.mesh) : middle < 0 ? volume_mm3(whole) : 0;
            (off > 0.1 * volume_mm3(whole) ? low : high) = middle;
        }
        const auto halves = cut(whole, {side, high}, 1);
        ASSERT_TRUE(halves);
        EXPECT_NEAR(volume_mm3(halves->below.mesh), 0.9 * volume_mm3(whole), 0.01 * volume_mm3(whole));
        const std::optional<SymmetryPlane> found = symmetry_plane(turned(halves->below.mesh, 0.7));
        ASSERT_TRUE(found);
        EXPECT_LT(degrees(found->plane.normal, turned({1, 0, 0}, 0.7)), 1);
    }
}

TEST(SymmetryPlane, TellsWhatIsNotSymmetric) {
    SampleOptions of_sample;
    of_sample.faces = 10'000;
    SymmetryOptions options;
    options.points = 4'000;
    const std::optional<SymmetryPlane> found = symmetry_plane(sample(Specimen::femur, of_sample), options);
    ASSERT_TRUE(found);
    EXPECT_FALSE(found->is_symmetric()) << found->ratio();
    EXPECT_FALSE(symmetry_plane(TriangleMesh{}));
}

TEST(SymmetryPlane, ScoreIsThatOfTheReference) {
    const TriangleMesh scan = vertebra();
    SymmetryOptions options;
    options.points = 1'200;
    const std::optional<SymmetryPlane> found = symmetry_plane(scan, options);
    ASSERT_TRUE(found);
    const SampledSurface surface{&scan, {}};
    std::vector<Vec3> points;
    for (const SurfaceSample& s : surface_samples({&surface, 1}, options.points).sample) points.push_back(s.point);
    EXPECT_NEAR(found->score_mm, symmetry_score(points, found->plane), 1e-9 * found->score_mm);
    EXPECT_NEAR(found->spacing_mm, std::sqrt(area_mm2(scan) / 1'200), 1e-9);
    // No plane through the centroid with another direction scores better.
    for (const Vec3 other : {Vec3{0, 1, 0}, Vec3{0, 0, 1}, normalized({1, 0.2, 0})}) {
        EXPECT_LT(found->score_mm, symmetry_score(points, {other, 0}));
    }
    EXPECT_EQ(symmetry_score(points, {{0, 0, 1}, 1e6}), std::numeric_limits<double>::infinity());
}

TEST(SymmetryPlane, SmallSolidsBesideTheLargestTakeNoPart) {
    const TriangleMesh scan = vertebra();
    SymmetryOptions options;
    options.points = 1'000;
    const SymmetryPlane alone = *symmetry_plane(scan, options);
    const TriangleMesh debris = shapes::joined({scan, shapes::ball({900, 300, 200}, 3, 6)});
    EXPECT_EQ(symmetry_plane(debris, options), alone);
}

TEST(SymmetryPlane, IsTheSameToTheLastBitForAnyNumberOfThreads) {
    const TriangleMesh scan = vertebra();
    const auto with = [&](std::size_t threads) {
        const ThreadLimit limit(threads);
        SymmetryOptions options;
        options.points = 1'000;
        return symmetry_plane(scan, options);
    };
    EXPECT_EQ(with(2), with(1));
    EXPECT_EQ(with(3), with(1));
}

TEST(SymmetryPlane, MirrorImagesOfPlanesHoldTheMirrorImagesOfTheirPoints) {
    const Plane mirror = canonical({normalized({1, 2, -0.5}), 7});
    for (const Plane& plane : {canonical({{0, 0, 1}, 12}), canonical({normalized({3, 1, 1}), -40}), mirror}) {
        const Plane image = reflected(plane, mirror);
        EXPECT_EQ(canonical(image), image);
        for (const Vec3 p : {Vec3{1, 2, 3}, Vec3{-40, 5, 60}}) {
            const Vec3 on = p - (height(plane.normal, p) - plane.offset) * plane.normal;
            EXPECT_NEAR(height(image.normal, reflected(on, mirror)), image.offset, 1e-10);
            EXPECT_LT(norm(reflected(reflected(p, mirror), mirror) - p), 1e-12 * norm(p));
        }
        EXPECT_LT(norm(reflected(image, mirror).normal - plane.normal), 1e-14);
    }
}

}  // namespace
}  // namespace qchopper
