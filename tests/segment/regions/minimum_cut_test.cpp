#include "segment/regions/engines/minimum_cut.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

#include "segment/regions/face_graph.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

double weight_of(const std::vector<CutEdge>& edges, const std::vector<bool>& side) {
    double sum = 0;
    for (const CutEdge& edge : edges) sum += side[edge.a] != side[edge.b] ? edge.capacity : 0;
    return sum;
}

// Of all divisions of the twelve triangles of a cube.
TEST(MinimumCut, IsThatOfAllDivisionsOfTwelveTriangles) {
    const TriangleMesh cube = shapes::box({0, 0, 0}, {1, 1, 1});
    const FaceGraph graph = face_graph(cube);
    constexpr std::uint32_t faces = 12;
    ASSERT_EQ(graph.size(), faces);
    std::mt19937 random(1);
    std::uniform_real_distribution<double> capacity(0.1, 1);
    for (int round = 0; round < 20; ++round) {
        std::vector<CutEdge> edges;
        for (const DualEdge& edge : graph.edges) edges.push_back({edge.face[0], edge.face[1], capacity(random)});
        const std::vector<std::uint32_t> sources{0};
        const std::vector<std::uint32_t> sinks{static_cast<std::uint32_t>(1 + round % 11)};
        double least = std::numeric_limits<double>::infinity();
        for (std::uint32_t bits = 0; bits < 1U << faces; ++bits) {
            std::vector<bool> side;
            for (std::uint32_t f = 0; f < faces; ++f) side.push_back(((bits >> f) & 1U) != 0);
            if (side[sources[0]] && !side[sinks[0]]) least = std::min(least, weight_of(edges, side));
        }
        const MinimumCut cut = minimum_cut(faces, edges, sources, sinks);
        EXPECT_NEAR(cut.weight, least, 1e-12);
        EXPECT_NEAR(weight_of(edges, cut.is_with_sources), least, 1e-12);
        EXPECT_TRUE(cut.is_with_sources[sources[0]]);
        EXPECT_FALSE(cut.is_with_sources[sinks[0]]);
    }
}

TEST(MinimumCut, IsNothingWithoutSinks) {
    const std::vector<CutEdge> edges{{0, 1, 2}};
    const std::vector<std::uint32_t> sources{0};
    EXPECT_EQ(minimum_cut(2, edges, sources, {}).weight, 0);
}

}  // namespace
}  // namespace qchopper
