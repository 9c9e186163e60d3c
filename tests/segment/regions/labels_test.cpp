#include "segment/regions/labels.h"

#include <gtest/gtest.h>

#include "segment/regions/borders.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

TEST(Labels, AreNumberedByTheirFirstTriangle) {
    const Labels labels = numbered({7, 7, 2, 9, 2});
    EXPECT_EQ(labels.of, (std::vector<std::uint32_t>{0, 0, 1, 2, 1}));
    EXPECT_EQ(labels.count, 3U);
    EXPECT_EQ(numbered({}).count, 0U);
}

TEST(Labels, PartsThatAreNotConnectedAreRegionsOfTheirOwn) {
    const TriangleMesh two = shapes::joined({shapes::box({0, 0, 0}, {1, 1, 1}), shapes::box({5, 0, 0}, {6, 1, 1})});
    const FaceGraph graph = face_graph(two);
    const Labels labels = connected(graph, numbered(std::vector<std::uint32_t>(graph.size(), 3)));
    EXPECT_EQ(labels.count, 2U);
    EXPECT_EQ(labels.of.front(), 0U);
    EXPECT_EQ(labels.of.back(), 1U);
}

TEST(Labels, ASmallRegionJoinsTheNeighbourOfItsLongestBorder) {
    const TriangleMesh box = shapes::box({0, 0, 0}, {4, 4, 4}, 4);
    const FaceGraph graph = face_graph(box);
    std::vector<std::uint32_t> of;
    for (std::size_t f = 0; f < graph.size(); ++f) of.push_back(graph.centroid[f].z > 2 ? 1 : 0);
    const Labels halves = numbered(of);
    of[nearest_face(graph, {4, 2.3, 3.5})] = 2;
    const Labels three = numbered(of);
    ASSERT_EQ(three.count, 3U);
    EXPECT_EQ(without_small(graph, three, 0.05), halves);
    EXPECT_EQ(without_small(graph, three, 0), three);
    EXPECT_EQ(without_small(graph, three, 1).count, 1U);
    const std::vector<double> areas = region_areas(graph, halves);
    EXPECT_NEAR(areas[0], 48, 1e-9);
    EXPECT_NEAR(areas[1], 48, 1e-9);
}

TEST(Labels, ASmallRegionWithoutANeighbourStays) {
    const TriangleMesh two = shapes::joined({shapes::box({0, 0, 0}, {1, 1, 1}), shapes::box({5, 0, 0}, {15, 10, 10})});
    const FaceGraph graph = face_graph(two);
    const Labels labels = connected(graph, numbered(std::vector<std::uint32_t>(graph.size(), 0)));
    EXPECT_EQ(without_small(graph, labels, 0.5).count, 2U);
}

TEST(RegionBorders, AreConnectedPartsByTheirRegions) {
    const TriangleMesh box = shapes::box({0, 0, 0}, {6, 2, 2}, 6);
    const FaceGraph graph = face_graph(box);
    std::vector<std::uint32_t> of;
    for (const Vec3& p : graph.centroid) of.push_back(p.x > 2 && p.x < 4 ? 1 : 0);  // a band around the middle
    const std::vector<RegionBorder> borders = region_borders(graph, of);
    ASSERT_EQ(borders.size(), 2U);
    for (const RegionBorder& border : borders) {
        EXPECT_EQ(border.region, (std::array<std::uint32_t, 2>{0, 1}));
        double length = 0;
        for (const std::uint32_t e : border.edges) length += graph.edges[e].length;
        EXPECT_NEAR(length, 8, 1e-9);
    }
    EXPECT_TRUE(region_borders(graph, std::vector<std::uint32_t>(graph.size(), 5)).empty());
}

}  // namespace
}  // namespace qchopper
