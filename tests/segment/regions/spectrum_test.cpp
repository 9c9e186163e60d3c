#include "segment/regions/engines/spectrum.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <numeric>

#include "base/parallel.h"
#include "segment/regions/engines/bends.h"
#include "segment/regions/engines/representatives.h"
#include "segment/simplify/simplify.h"
#include "tests/segment/regions/region_shapes.h"

namespace qchopper {
namespace {

// A shape of parts with few triangles.
struct Small {
    TriangleMesh mesh;
    FaceGraph graph;
    WeightedGraph weighted;
    std::vector<std::uint32_t> all;
    Small(TriangleMesh of, std::size_t faces) : mesh(std::move(of)) {
        SimplifyOptions fewer;
        fewer.max_faces = faces;
        simplify(mesh, fewer);
        graph = face_graph(mesh);
        weighted = weighted_faces(graph, neighbour_distances(graph));
        all.resize(graph.size());
        std::iota(all.begin(), all.end(), 0U);
    }
};

std::vector<double> eigenvalues_by_a_dense_solver(const WeightedGraph& graph) {
    const auto n = static_cast<Eigen::Index>(graph.size());
    Eigen::MatrixXd w(n, n);
    for (std::uint32_t e = 0; e < graph.size(); ++e) {
        const std::vector<double> cost = shortest_paths(graph, std::span(&e, 1)).cost;
        for (Eigen::Index i = 0; i < n; ++i) w(i, e) = cost[static_cast<std::size_t>(i)];
    }
    const double sigma = w.mean();
    w = (-w.array().square() / (2 * sigma * sigma)).exp();
    const Eigen::VectorXd root = w.rowwise().sum().cwiseSqrt().cwiseInverse();
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(root.asDiagonal() * w * root.asDiagonal());
    return {solver.eigenvalues().begin(), solver.eigenvalues().end()};
}

TEST(Spectrum, WithAllElementsAsSamplesIsThatOfADenseSolver) {
    const Small hand(region_shapes::hand().mesh, 500);
    const Spectrum spectrum = affinity_spectrum(hand.weighted, hand.all, 8);
    const std::vector<double> dense = eigenvalues_by_a_dense_solver(hand.weighted);
    ASSERT_EQ(spectrum.values.size(), 8U);
    EXPECT_NEAR(spectrum.values[0], 1, 1e-3);
    for (std::size_t k = 0; k < 8; ++k) EXPECT_NEAR(spectrum.values[k], dense[dense.size() - 1 - k], 1e-3) << k;
    for (std::size_t k = 0; k < 8; ++k) {
        double square = 0;
        for (std::size_t e = 0; e < hand.graph.size(); ++e) square += std::pow(spectrum.row(e)[k], 2);
        EXPECT_NEAR(square, 1, 1e-9);
    }
}

TEST(Spectrum, OfSamplesGivesTheSameGroups) {
    const Small dumbbell(region_shapes::dumbbell().shape.mesh, 1'000);
    const auto groups = [&](const std::vector<std::uint32_t>& samples) {
        return grouped_rows(affinity_spectrum(dumbbell.weighted, samples, 3), 3, dumbbell.graph.area);
    };
    const std::vector<std::uint32_t> samples = farthest_first(dumbbell.weighted, 0, 200).element;
    EXPECT_LE(samples.size(), 200U);
    EXPECT_GE(region_shapes::adjusted_rand_index(groups(samples), groups(dumbbell.all), dumbbell.graph.area), 0.95);
}

TEST(Spectrum, IsTheSameForAnyNumberOfThreads) {
    const Small dumbbell(region_shapes::dumbbell().shape.mesh, 300);
    const Spectrum many = affinity_spectrum(dumbbell.weighted, dumbbell.all, 3);
    const ThreadLimit one(1);
    const Spectrum alone = affinity_spectrum(dumbbell.weighted, dumbbell.all, 3);
    EXPECT_EQ(alone.values, many.values);
    EXPECT_EQ(alone.vectors, many.vectors);
}

}  // namespace
}  // namespace qchopper
