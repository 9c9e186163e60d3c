// Methods that seek charts, on shapes with flat sides: no region goes over a sharp edge, and each keeps its bound.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "segment/regions/engines/moments.h"
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
constexpr std::array methods{Method{"superfaces", superfaces}, Method{"garland", garland_clusters},
                             Method{"attene", attene_primitives}, Method{"sander", sander_charts}};

std::vector<Shape> shapes_with_sides() {
    return {region_shapes::cube_with_posts(), region_shapes::two_boxes(), region_shapes::cylinder()};
}

TEST(Charts, DoNotGoOverSharpEdges) {
    for (const Shape& shape : shapes_with_sides()) {
        const FaceGraph graph = face_graph(shape.mesh);
        for (const Method& method : methods) {
            const Labels labels = method.labels(graph, {});
            for (const DualEdge& edge : graph.edges) {
                if (edge.turn < 60 * degree) continue;
                ASSERT_NE(labels.of[edge.face[0]], labels.of[edge.face[1]]) << method.name << ", " << shape.name;
            }
        }
    }
}

TEST(Charts, AreTheFlatSidesWhereAllSidesAreFlat) {
    for (const Shape& shape : {region_shapes::cube_with_posts(), region_shapes::two_boxes()}) {
        const FaceGraph graph = face_graph(shape.mesh);
        for (const Method& method : methods) {
            EXPECT_GE(adjusted_rand_index(method.labels(graph, {}).of, region_shapes::flat_sides(graph), graph.area),
                      0.999)
                << method.name << ", " << shape.name;
        }
    }
}

TEST(Charts, OfTheYardstickAreTheFlatSides) {
    const Shape shape = region_shapes::cube_with_posts();
    const FaceGraph graph = face_graph(shape.mesh);
    const std::vector<std::uint32_t> sides = region_shapes::flat_sides(graph);
    RegionOptions as_many;
    as_many.regions = *std::ranges::max_element(sides) + 1;
    const Labels charts = variational_charts(graph, as_many);
    EXPECT_GE(adjusted_rand_index(charts.of, sides, graph.area), 0.85);
    EXPECT_EQ(variational_charts(graph, as_many), charts);
}

TEST(Charts, TheSideOfACylinderIsOnePrimitive) {
    const Shape cylinder = region_shapes::cylinder();
    const FaceGraph graph = face_graph(cylinder.mesh);
    EXPECT_GE(adjusted_rand_index(attene_primitives(graph, {}).of, cylinder.of, graph.area), 0.999);
}

TEST(Charts, SphereAndBarOfADumbbellArePrimitives) {
    const Shape dumbbell = region_shapes::dumbbell().shape;
    const FaceGraph graph = face_graph(dumbbell.mesh);
    EXPECT_GE(adjusted_rand_index(attene_primitives(graph, {}).of, dumbbell.of, graph.area), 0.85);
}

// Root of the mean squared distance from the least squares plane, and the largest one of a corner.
std::pair<double, double> distances_from_plane(const FaceGraph& graph, const Labels& labels, std::uint32_t region) {
    PointMoments moments;
    for (std::size_t f = 0; f < graph.size(); ++f) {
        if (labels.of[f] == region) moments.add_triangle(corners_of(*graph.mesh, f), graph.area[f]);
    }
    const PrincipalAxes axes = principal_axes(moments.covariance());
    double largest = 0;
    for (std::size_t f = 0; f < graph.size(); ++f) {
        if (labels.of[f] != region) continue;
        for (const Vec3& p : corners_of(*graph.mesh, f)) {
            largest = std::max(largest, std::abs(dot(p - moments.centre(), axes.direction[0])));
        }
    }
    return {std::sqrt(axes.square[0]), largest};
}

TEST(Charts, KeepTheToleranceAroundABall) {
    const TriangleMesh ball = shapes::ball({0, 0, 0}, 10, 24);
    const FaceGraph graph = face_graph(ball);
    for (const double tolerance : {0.2, 0.8}) {
        RegionOptions options;
        options.tolerance = tolerance;
        const Labels near = superfaces(graph, options);
        const Labels mean = garland_clusters(graph, options);
        for (std::uint32_t r = 0; r < near.count; ++r) {
            EXPECT_LE(distances_from_plane(graph, near, r).second, tolerance * (1 + 1e-9));
        }
        for (std::uint32_t r = 0; r < mean.count; ++r) {
            EXPECT_LE(distances_from_plane(graph, mean, r).first, tolerance * (1 + 1e-9));
        }
        EXPECT_GT(near.count, 6U);
        EXPECT_LT(near.count, graph.size() / 4);
        EXPECT_LT(mean.count, graph.size() / 4);
    }
}

TEST(Charts, OfABallTurnByAtMostTheirLimit) {
    const TriangleMesh ball = shapes::ball({0, 0, 0}, 10, 24);
    const FaceGraph graph = face_graph(ball);
    const Labels labels = sander_charts(graph, {});
    std::vector<Vec3> normal(labels.count);
    for (std::size_t f = 0; f < graph.size(); ++f) {
        normal[labels.of[f]] = normal[labels.of[f]] + graph.area[f] * graph.normal[f];
    }
    for (std::size_t f = 0; f < graph.size(); ++f) {
        EXPECT_GE(dot(normalized(normal[labels.of[f]]), graph.normal[f]), std::cos(max_chart_turn) - 1e-9);
    }
    EXPECT_LT(labels.count, 60U);
}

TEST(Charts, TilesKeepTheirThreeConditions) {
    std::vector<TriangleMesh> meshes;
    for (const Shape& shape : shapes_with_sides()) meshes.push_back(shape.mesh);
    meshes.push_back(shapes::torus({0, 0, 0}, 10, 3));
    meshes.push_back(shapes::joined({shapes::ball({0, 0, 0}, 5), shapes::torus({30, 0, 0}, 10, 3)}));
    for (const TriangleMesh& mesh : meshes) {
        const FaceGraph graph = face_graph(mesh);
        const Labels labels = eck_tiles(graph, {});
        EXPECT_EQ(tile_faults(graph, labels), TileFaults{});
        EXPECT_EQ(connected(graph, labels), labels);
        EXPECT_LT(labels.count, graph.size() / 4);
    }
}

TEST(Charts, BrokenConditionsOfTilesAreCounted) {
    const TriangleMesh torus = shapes::torus({0, 0, 0}, 10, 3);
    const FaceGraph graph = face_graph(torus);
    EXPECT_EQ(tile_faults(graph, numbered(std::vector<std::uint32_t>(graph.size(), 0))), (TileFaults{1, 0, 0}));
    std::vector<std::uint32_t> halves;
    for (const Vec3& p : graph.centroid) halves.push_back(p.x > 0 ? 1 : 0);
    EXPECT_EQ(tile_faults(graph, numbered(halves)), (TileFaults{2, 1, 0}));
    std::vector<std::uint32_t> alone(graph.size());
    for (std::uint32_t f = 0; f < alone.size(); ++f) alone[f] = f;
    EXPECT_EQ(tile_faults(graph, numbered(alone)).crowded_points, torus.points.size());
}

TEST(Charts, AreTheSameAfterARigidMotionAndInAnotherOrder) {
    const TriangleMesh mesh = region_shapes::two_boxes().mesh;
    std::vector<std::uint32_t> order;
    const TriangleMesh other =
        region_shapes::in_other_order(shapes::moved(shapes::rotated(mesh, {1, 2, -1}, 0.7), {31, -7, 12}), 5, order);
    const FaceGraph graph = face_graph(mesh);
    const FaceGraph moved = face_graph(other);
    for (const Method& method : methods) {
        const Labels before = method.labels(graph, {});
        std::vector<std::uint32_t> there;
        for (const std::uint32_t t : order) there.push_back(before.of[t]);
        EXPECT_GE(adjusted_rand_index(method.labels(moved, {}).of, there, moved.area), 0.99) << method.name;
    }
}

}  // namespace
}  // namespace qchopper
