// Methods that seek parts, on shapes of which the parts are known: agreement by the adjusted Rand index, weighted by
// area, because the plain one is high for regions of one triangle each.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <functional>
#include <string>

#include "base/parallel.h"
#include "segment/regions/labelling.h"
#include "tests/segment/regions/region_shapes.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

using region_shapes::adjusted_rand_index;
using region_shapes::Shape;

struct Method {
    const char* name;
    Labels (*labels)(const FaceGraph&, const RegionOptions&);
};
constexpr std::array with_number{Method{"shlafman", shlafman_parts}, Method{"katz-tal", katz_tal_parts},
                                 Method{"liu-zhang", liu_zhang_parts}, Method{"shuffler", shuffler_parts}};

std::vector<Method> all_methods() {
    std::vector<Method> all(with_number.begin(), with_number.end());
    all.push_back({"zhou-huang", zhou_huang_parts});
    return all;
}

// Made once.
const std::vector<Shape>& shapes_with_parts() {
    static const std::vector<Shape> made{region_shapes::dumbbell().shape, region_shapes::chain_of_balls(),
                                         region_shapes::hand(), region_shapes::cube_with_posts()};
    return made;
}

RegionOptions number_of(const Shape& shape) {
    RegionOptions options;
    options.regions = shape.regions;
    return options;
}

double agreement(const Method& method, const Shape& shape, const TriangleMesh& mesh) {
    const FaceGraph graph = face_graph(mesh);
    return adjusted_rand_index(method.labels(graph, number_of(shape)).of, shape.of, graph.area);
}

TEST(Parts, AreFoundWithTheirNumberGiven) {
    for (const Shape& shape : shapes_with_parts()) {
        for (const Method& method : with_number) {
            EXPECT_GE(agreement(method, shape, shape.mesh), 0.9) << method.name << ", " << shape.name;
        }
    }
}

TEST(Parts, AreFoundInNoiseOfAFifthOfTheMeanEdge) {
    for (const Shape& shape : shapes_with_parts()) {
        for (const Method& method : with_number) {
            const TriangleMesh noisy = region_shapes::with_noise(shape.mesh, 0.2, 1);
            EXPECT_GE(agreement(method, shape, noisy), 0.8) << method.name << ", " << shape.name;
        }
    }
}

// Which depends on thickness alone, so that balls of a chain and posts of one cube are no parts of it.
TEST(Parts, OfTheYardstickAreThoseOfTwoThicknesses) {
    const Shape& dumbbell = shapes_with_parts()[0];
    const Method method{"shape-diameter", shape_diameter_parts};
    EXPECT_GE(agreement(method, dumbbell, dumbbell.mesh), 0.9);
    EXPECT_GE(agreement(method, dumbbell, region_shapes::with_noise(dumbbell.mesh, 0.2, 1)), 0.8);
}

// What has no saddle of the distance from an end is one region for Zhou and Huang: the dumbbell and the chain.
TEST(Parts, ThatBranchAreFoundByCriticalPoints) {
    const Method method{"zhou-huang", zhou_huang_parts};
    for (const Shape& shape : shapes_with_parts()) {
        const bool branches = shape.name == "hand" || shape.name == "cube with posts";
        const TriangleMesh noisy = region_shapes::with_noise(shape.mesh, 0.2, 1);
        if (branches) {
            EXPECT_GE(agreement(method, shape, shape.mesh), 0.9) << shape.name;
            EXPECT_GE(agreement(method, shape, noisy), 0.8) << shape.name;
        } else {
            EXPECT_EQ(zhou_huang_parts(face_graph(shape.mesh), {}).count, 1U) << shape.name;
        }
    }
}

TEST(Parts, TheirNumberIsFoundWhereOneGapIsLargest) {
    const Shape& hand = shapes_with_parts()[2];
    const FaceGraph graph = face_graph(hand.mesh);
    for (const auto method : {shlafman_parts, katz_tal_parts, liu_zhang_parts}) {
        EXPECT_GE(adjusted_rand_index(method(graph, {}).of, hand.of, graph.area), 0.9);
    }
}

TEST(Parts, AreTheSameAfterARigidMotionAndInAnotherOrder) {
    for (const Shape& shape : {shapes_with_parts()[0], shapes_with_parts()[2]}) {
        std::vector<std::uint32_t> order;
        const TriangleMesh other = region_shapes::in_other_order(
            shapes::moved(shapes::rotated(shape.mesh, {1, 2, -1}, 0.7), {31, -7, 12}), 5, order);
        const FaceGraph graph = face_graph(shape.mesh);
        const FaceGraph moved = face_graph(other);
        for (const Method& method : all_methods()) {
            const Labels before = method.labels(graph, number_of(shape));
            std::vector<std::uint32_t> there;
            for (const std::uint32_t t : order) there.push_back(before.of[t]);
            const Labels after = method.labels(moved, number_of(shape));
            // Which triangles stand for a patch of Shuffler follows from the last bits of heights that are nearly
            // equal.
            const double least = std::string(method.name) == "shuffler" ? 0.98 : 0.99;
            EXPECT_GE(adjusted_rand_index(after.of, there, moved.area), least) << method.name << ", " << shape.name;
        }
    }
}

TEST(Parts, AreTheSameForAnyNumberOfThreads) {
    const Shape& shape = shapes_with_parts()[3];
    const FaceGraph graph = face_graph(shape.mesh);
    for (const Method& method : with_number) {
        const Labels many = method.labels(graph, number_of(shape));
        const ThreadLimit one(1);
        EXPECT_EQ(method.labels(graph, number_of(shape)), many) << method.name;
    }
}

TEST(Parts, OfABallAreOneRegionByCriticalPoints) {
    const TriangleMesh ball = shapes::ball({0, 0, 0}, 5, 20);
    EXPECT_EQ(zhou_huang_parts(face_graph(ball), {}).count, 1U);
}

TEST(Parts, OfOneTriangleAreThatTriangle) {
    const TriangleMesh one{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}, {}};
    const FaceGraph graph = face_graph(one);
    for (const auto method :
         {shlafman_parts, katz_tal_parts, zhou_huang_parts, liu_zhang_parts, shuffler_parts, superfaces,
          garland_clusters, attene_primitives, sander_charts, eck_tiles, shape_diameter_parts, variational_charts}) {
        EXPECT_EQ(method(graph, {}), (Labels{{0}, 1}));
    }
}

// No region goes over to another solid.
TEST(Parts, OfSeveralSolidsAreApart) {
    const TriangleMesh two = shapes::joined({shapes::ball({0, 0, 0}, 5), shapes::ball({20, 0, 0}, 3)});
    const FaceGraph graph = face_graph(two);
    for (const auto method :
         {shlafman_parts, katz_tal_parts, zhou_huang_parts, liu_zhang_parts, shuffler_parts, superfaces,
          garland_clusters, attene_primitives, sander_charts, eck_tiles, shape_diameter_parts, variational_charts}) {
        const Labels labels = method(graph, {});
        EXPECT_EQ(connected(graph, labels), labels);
        EXPECT_GE(labels.count, 2U);
    }
}

}  // namespace
}  // namespace qchopper
