#include "segment/objectives/sweep/clusters.h"

#include <gtest/gtest.h>

#include <random>
#include <set>

#include "segment/mesh/connectivity/shells.h"
#include "segment/mesh/order.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

std::vector<TriangleSums> sums_of(const TriangleMesh& mesh) {
    std::vector<TriangleSums> sums;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const Vec3 area = area_vector(mesh, t);
        sums.push_back({area, dot(mesh.points[mesh.triangles[t][0]], area) / 3});
    }
    return sums;
}

TEST(Clusters, CoverEveryTriangleOnceAndListTheirPoints) {
    for (const auto& [name, mesh, solids] : shapes::all_closed()) {
        const Clusters found = clusters(mesh, sums_of(mesh), {});
        ASSERT_GT(found.count(), 0U) << name;
        EXPECT_EQ(found.cluster.front().first_triangle, 0U) << name;
        EXPECT_EQ(found.cluster.back().first_triangle, mesh.triangles.size()) << name;
        for (std::size_t c = 0; c < found.count(); ++c) {
            const std::uint32_t first = found.cluster[c].first_triangle;
            const std::uint32_t end = found.cluster[c + 1].first_triangle;
            ASSERT_GT(end, first) << name;
            EXPECT_LE(end - first, triangles_per_cluster) << name;
            std::set<std::uint32_t> points;
            for (std::uint32_t t = first; t < end; ++t)
                points.insert(mesh.triangles[t].begin(), mesh.triangles[t].end());
            const std::vector<std::uint32_t> listed(found.point.begin() + found.cluster[c].first_point,
                                                    found.point.begin() + found.cluster[c + 1].first_point);
            EXPECT_EQ(listed.size(), points.size()) << name;
            EXPECT_EQ(std::set<std::uint32_t>(listed.begin(), listed.end()), points) << name;
        }
    }
}

// Slabs rely on it: all points of a cluster that lie in one slab get one label.
TEST(Clusters, AreConnected) {
    for (const auto& [name, mesh, solids] : shapes::all_closed()) {
        const Clusters found = clusters(mesh, sums_of(mesh), {});
        for (std::size_t c = 0; c < found.count(); ++c) {
            TriangleMesh alone;
            alone.points = mesh.points;
            alone.triangles.assign(mesh.triangles.begin() + found.cluster[c].first_triangle,
                                   mesh.triangles.begin() + found.cluster[c + 1].first_triangle);
            EXPECT_EQ(shells(alone).count(), 1U) << name << " " << c;
        }
    }
}

TEST(Clusters, NeighboursAreEarlierAndOnACommonEdge) {
    for (const auto& [name, mesh, solids] : shapes::all_closed()) {
        std::vector<std::set<std::uint32_t>> beside(mesh.points.size());
        for (const Triangle& t : mesh.triangles) {
            for (const std::uint32_t v : t) beside[v].insert(t.begin(), t.end());
        }
        const Clusters found = clusters(mesh, sums_of(mesh), {});
        for (std::uint32_t v = 0; v < mesh.points.size(); ++v) {
            for (const std::uint32_t n : found.neighbour[v]) {
                EXPECT_TRUE(n == v || (n < v && beside[v].contains(n))) << name;
            }
        }
    }
}

// Where the cone allows it for a normal, all triangles face up or all face down, and their sum equals the cluster's.
TEST(Clusters, ConesShowWhenAllTrianglesFaceOneSide) {
    std::mt19937 random(5);
    std::normal_distribution<double> some;
    std::size_t sure = 0;
    std::size_t checked = 0;
    for (const auto& [name, shape, solids] : shapes::all_closed()) {
        const TriangleMesh mesh = in_memory_order(shape);
        const std::vector<TriangleSums> sums = sums_of(mesh);
        const Clusters found = clusters(mesh, sums, {});
        for (int i = 0; i < 20; ++i) {
            const Vec3 normal = normalized({some(random), some(random), some(random)});
            for (std::size_t c = 0; c < found.count(); ++c) {
                const Cluster& cluster = found.cluster[c];
                ++checked;
                if (std::abs(dot(cluster.axis, normal)) <= cluster.cone) continue;
                ++sure;
                double up = 0;
                double down = 0;
                for (std::uint32_t t = cluster.first_triangle; t < found.cluster[c + 1].first_triangle; ++t) {
                    const double along = dot(sums[t].area, normal);
                    (along > 0 ? up : down) += along;
                }
                EXPECT_TRUE(up == 0 || down == 0) << name;
                EXPECT_NEAR(up + down, dot(cluster.weighted_normal, normal), 1e-9 * norm(cluster.weighted_normal))
                    << name;
            }
        }
    }
    EXPECT_GT(sure, checked / 10);  // otherwise they would be of no use
}

}  // namespace
}  // namespace qchopper
