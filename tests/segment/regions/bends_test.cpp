#include "segment/regions/engines/bends.h"

#include <gtest/gtest.h>

#include <numeric>

#include "tests/segment/regions/region_shapes.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

TEST(Bends, WithoutRoundsAreThoseOfTheEdges) {
    const region_shapes::Shape shape = region_shapes::two_boxes();
    const FaceGraph graph = face_graph(shape.mesh);
    const Bends bent = bends(graph, 0);
    for (std::size_t e = 0; e < graph.edges.size(); ++e) {
        EXPECT_NEAR(bent.turn[e], graph.edges[e].turn, 1e-9);
        if (graph.edges[e].turn > 0.1) {
            EXPECT_EQ(bent.is_concave[e] != 0, graph.edges[e].is_concave);
        }
    }
}

// In the middle of the sides, because smoothing also spreads the turns of the edges of the box.
TEST(Bends, OfNoiseAreLessThanHalfAfterSmoothing) {
    const TriangleMesh box = shapes::box({0, 0, 0}, {20, 20, 20}, 20);
    const TriangleMesh noisy = region_shapes::with_noise(box, 0.2, 3);
    const FaceGraph graph = face_graph(noisy);
    const Bends bent = bends(graph);
    double before = 0;
    double after = 0;
    for (std::size_t e = 0; e < graph.edges.size(); ++e) {
        const Vec3 at = noisy.points[graph.edges[e].point[0]];
        int inner = 0;
        for (int k = 0; k < 3; ++k) inner += at[k] > 5 && at[k] < 15 ? 1 : 0;
        if (inner < 2) continue;
        before += graph.edges[e].turn;
        after += bent.turn[e];
    }
    EXPECT_GT(before, 0);
    EXPECT_LT(after, 0.5 * before);
}

TEST(Bends, AConvexEdgeCostsLessThanAConcaveOne) {
    const region_shapes::Shape shape = region_shapes::two_boxes();
    const FaceGraph graph = face_graph(shape.mesh);
    const std::vector<double> distance = neighbour_distances(graph);
    double convex = 0;
    double convex_mm = 0;
    double concave = 0;
    double concave_mm = 0;
    for (std::size_t e = 0; e < graph.edges.size(); ++e) {
        const DualEdge& edge = graph.edges[e];
        if (edge.turn < 0.1) continue;
        (edge.is_concave ? concave : convex) += edge.length * distance[e];
        (edge.is_concave ? concave_mm : convex_mm) += edge.length;
    }
    EXPECT_LT(convex / convex_mm, 0.5 * concave / concave_mm);
}

}  // namespace
}  // namespace qchopper
