#include "segment/regions/methods.h"

#include <gtest/gtest.h>

#include <set>

#include "base/parallel.h"
#include "segment/mesh/measure.h"
#include "tests/segment/regions/region_shapes.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

TEST(RegionMethods, HaveNamesThatDiffer) {
    std::set<std::string_view> names;
    for (const RegionMethod& method : region_methods()) {
        EXPECT_TRUE(names.insert(method.name).second) << method.name;
        EXPECT_EQ(region_method(method.name), &method);
        EXPECT_NE(names_of_region_methods().find(method.name), std::string::npos);
        EXPECT_GE(method.faces, 20'000U);
    }
    EXPECT_EQ(region_method("voronoi"), nullptr);
}

TEST(RegionMethods, LabelACopyWithFewerTriangles) {
    const region_shapes::Shape hand = region_shapes::hand();
    RegionMethod method = *region_method("shlafman");
    method.faces = 3'000;
    RegionOptions six;
    six.regions = hand.regions;
    const ScanRegions regions = scan_regions(hand.mesh, method, six);
    EXPECT_LE(regions.copy.triangles.size(), 3'000U);
    EXPECT_EQ(regions.labels.of.size(), regions.copy.triangles.size());
    const FaceGraph graph = face_graph(hand.mesh);
    const Labels labels = on_scan(regions, hand.mesh);
    EXPECT_GE(region_shapes::adjusted_rand_index(labels.of, hand.of, graph.area), 0.9);
    const ThreadLimit one(1);
    EXPECT_EQ(on_scan(scan_regions(hand.mesh, method, six), hand.mesh), labels);
}

TEST(RegionMethods, ASmallScanIsItsOwnCopy) {
    const region_shapes::Shape boxes = region_shapes::two_boxes();
    const ScanRegions regions = scan_regions(boxes.mesh, *region_method("garland"));
    EXPECT_EQ(regions.copy, boxes.mesh);
    EXPECT_EQ(on_scan(regions, boxes.mesh), regions.labels);
}

TEST(RegionMethods, DivideTheLargestSolidAndTheOthersAreOfTheNearestRegion) {
    const region_shapes::Shape boxes = region_shapes::two_boxes();
    const Box box = bounds(boxes.mesh);
    const Vec3 beside = box.max + Vec3{1, 1, 1};
    const TriangleMesh two = shapes::joined({shapes::box(beside, beside + Vec3{0.1, 0.1, 0.1}), boxes.mesh});
    const ScanRegions alone = scan_regions(boxes.mesh, *region_method("garland"));
    const ScanRegions regions = scan_regions(two, *region_method("garland"));
    EXPECT_EQ(regions.labels, alone.labels);
    EXPECT_EQ(regions.copy.triangles.size(), boxes.mesh.triangles.size());
    EXPECT_EQ(on_scan(regions, two).count, alone.labels.count);
}

TEST(RegionMethods, StopWhenTheyAreCancelled) {
    const std::atomic<bool> cancelled = true;
    Context context;
    context.cancelled = &cancelled;
    const region_shapes::Shape boxes = region_shapes::two_boxes();
    EXPECT_THROW(scan_regions(boxes.mesh, *region_method("garland"), {}, context), Cancelled);
}

}  // namespace
}  // namespace qchopper
