#include "segment/regions/region_planes.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/units.h"
#include "segment/regions/labelling.h"
#include "tests/segment/regions/region_shapes.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

Labels above(const FaceGraph& graph, double z) {
    std::vector<std::uint32_t> of;
    for (const Vec3& p : graph.centroid) of.push_back(p.z > z ? 1 : 0);
    return numbered(of);
}

TEST(RegionPlanes, ABorderInAPlaneGivesThatPlaneOnce) {
    const TriangleMesh box = shapes::box({0, 0, 0}, {6, 6, 6}, 6);
    const FaceGraph graph = face_graph(box);
    const RegionPlanes found = region_planes(graph, above(graph, 2));
    ASSERT_EQ(found.planes.size(), 1U);
    EXPECT_NEAR(norm(found.planes[0].plane.normal - Vec3{0, 0, 1}), 0, 1e-9);
    EXPECT_NEAR(found.planes[0].plane.offset, 2, 1e-9);
    EXPECT_NEAR(found.planes[0].border_mm, 24, 1e-9);
    EXPECT_EQ(found.equal, 2U);  // the whole borders of both regions
    EXPECT_EQ(found.straight, 0U);
}

TEST(RegionPlanes, OutliersOfLessThanATenthDoNotTurnThePlane) {
    const TriangleMesh box = shapes::box({0, 0, 0}, {20, 20, 20}, 20);
    const FaceGraph graph = face_graph(box);
    Labels labels = above(graph, 8);
    for (std::size_t f = 0; f < graph.size(); ++f) {
        const Vec3 p = graph.centroid[f];  // a notch one square wide and two deep
        if (p.x > 19.5 && p.y > 9 && p.y < 10 && p.z < 10) labels.of[f] = p.z < 8 ? labels.of[f] : 0;
    }
    const RegionPlanes found = region_planes(graph, numbered(labels.of));
    ASSERT_EQ(found.planes.size(), 1U);
    EXPECT_NEAR(norm(found.planes[0].plane.normal - Vec3{0, 0, 1}), 0, 1e-9);
    EXPECT_NEAR(found.planes[0].plane.offset, 8, 1e-9);
}

TEST(RegionPlanes, ABorderOnALineHasNone) {
    const TriangleMesh square{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}, {}};
    const FaceGraph graph = face_graph(square);
    const RegionPlanes found = region_planes(graph, numbered({0, 1}));
    EXPECT_TRUE(found.planes.empty());
    EXPECT_EQ(found.straight, 3U);
}

TEST(RegionPlanes, OneRegionHasNone) {
    const TriangleMesh ball = shapes::ball({0, 0, 0}, 5);
    const FaceGraph graph = face_graph(ball);
    EXPECT_TRUE(region_planes(graph, numbered(std::vector<std::uint32_t>(graph.size(), 0))).planes.empty());
}

TEST(RegionPlanes, AreAtMostSixtyFourLongestFirst) {
    const TriangleMesh box = shapes::box({0, 0, 0}, {90, 9, 9}, 90);
    const FaceGraph graph = face_graph(box);
    std::vector<std::uint32_t> of;
    for (const Vec3& p : graph.centroid) of.push_back(static_cast<std::uint32_t>(p.x));
    const RegionPlanes found = region_planes(graph, numbered(of));
    EXPECT_EQ(found.planes.size(), max_region_planes);
    EXPECT_GT(found.beyond, 0U);
    for (std::size_t i = 1; i < found.planes.size(); ++i) {
        EXPECT_GE(found.planes[i - 1].border_mm, found.planes[i].border_mm);
    }
}

TEST(RegionPlanes, LieAtBothEndsOfTheBarOfADumbbell) {
    const region_shapes::Dumbbell dumbbell = region_shapes::dumbbell();
    const FaceGraph graph = face_graph(dumbbell.shape.mesh);
    RegionOptions three;
    three.regions = 3;
    for (const auto method : {shlafman_parts, katz_tal_parts}) {
        const RegionPlanes found = region_planes(graph, method(graph, three));
        for (const double end : {dumbbell.bar_from, dumbbell.bar_to}) {
            bool is_found = false;
            for (const BorderPlane& border : found.planes) {
                const Plane& plane = border.plane;
                const double along_axis = plane.offset / plane.normal.x;  // where it meets the axis of the bar
                is_found |=
                    plane.normal.x > std::cos(5 * degree) && std::abs(along_axis - end) < 0.02 * dumbbell.length;
            }
            EXPECT_TRUE(is_found) << end;
        }
    }
}

}  // namespace
}  // namespace qchopper
