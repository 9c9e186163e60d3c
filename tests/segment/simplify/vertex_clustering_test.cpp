#include "segment/simplify/vertex_clustering.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <map>
#include <set>

#include "base/parallel.h"
#include "segment/mesh/measure.h"
#include "tests/bumpy_torus.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

using Cell = std::array<long, 3>;

Cell cell_of(Vec3 p, Vec3 least, double size) {
    const Vec3 scaled = (1 / size) * (p - least);
    return {std::lround(std::floor(scaled.x)), std::lround(std::floor(scaled.y)), std::lround(std::floor(scaled.z))};
}

// Corner by corner, with ordered maps and nothing else: slow, and from the header alone.
TriangleMesh clustered_plainly(const TriangleMesh& mesh, double size) {
    const Vec3 least = bounds(mesh).min;
    std::map<Cell, std::vector<Vec3>> points;
    std::vector<Cell> order;
    for (const Vec3& p : mesh.points) {
        const Cell cell = cell_of(p, least, size);
        if (points[cell].empty()) order.push_back(cell);
        points[cell].push_back(p);
    }
    std::vector<std::array<Cell, 3>> faces;
    std::vector<std::int32_t> caps;
    std::set<std::array<Cell, 3>> seen;
    std::set<Cell> used;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        std::array<Cell, 3> corners;
        for (std::size_t k = 0; k < 3; ++k) corners[k] = cell_of(corners_of(mesh, t)[k], least, size);
        if (std::set<Cell>(corners.begin(), corners.end()).size() < 3) continue;
        bool is_seen = false;
        for (std::size_t k = 0; k < 3; ++k) {
            is_seen = is_seen || seen.count({corners[k], corners[(k + 1) % 3], corners[(k + 2) % 3]}) > 0;
        }
        if (is_seen) continue;
        seen.insert(corners);
        used.insert(corners.begin(), corners.end());
        faces.push_back(corners);
        caps.push_back(cap_of(mesh, t));
    }
    TriangleMesh result;
    std::map<Cell, std::uint32_t> number;
    for (const Cell& cell : order) {
        if (used.count(cell) == 0) continue;
        number[cell] = static_cast<std::uint32_t>(result.points.size());
        Vec3 sum;
        for (const Vec3& p : points[cell]) sum = sum + p;
        result.points.push_back(1.0 / static_cast<double>(points[cell].size()) * sum);
    }
    for (const auto& face : faces) result.triangles.push_back({number[face[0]], number[face[1]], number[face[2]]});
    if (!mesh.cap_of.empty()) result.cap_of = caps;
    return result;
}

TEST(VertexClustering, EveryShapeIsWhatThePlainWayMakes) {
    std::vector<shapes::Named> all = shapes::all_closed();
    all.push_back({"bumpy torus", bumpy_torus(40)});
    for (shapes::Named& shape : all) {
        for (std::size_t t = 0; t < shape.mesh.triangles.size(); ++t) {
            shape.mesh.cap_of.push_back(t % 7 == 0 ? 3 : no_cap);
        }
        const double size = norm(bounds(shape.mesh).size());
        for (const double share : {0.003, 0.04, 0.17, 2.0}) {
            const ClusteredMesh result = cluster_vertices(shape.mesh, share * size);
            EXPECT_EQ(result.mesh, clustered_plainly(shape.mesh, share * size)) << shape.name << " " << share;
            EXPECT_LE(result.largest_shift, share * size * std::sqrt(3.0)) << shape.name;
        }
    }
}

TEST(VertexClustering, TheStatedShiftIsThatOfThePoints) {
    const TriangleMesh mesh = bumpy_torus(40);
    const double size = 0.05 * norm(bounds(mesh).size());
    std::map<Cell, std::vector<Vec3>> cells;
    for (const Vec3& p : mesh.points) cells[cell_of(p, bounds(mesh).min, size)].push_back(p);
    double largest = 0;
    for (const auto& [cell, points] : cells) {
        Vec3 sum;
        for (const Vec3& p : points) sum = sum + p;
        for (const Vec3& p : points) {
            largest = std::max(largest, norm(p - 1.0 / static_cast<double>(points.size()) * sum));
        }
    }
    EXPECT_NEAR(cluster_vertices(mesh, size).largest_shift, largest, 1e-9 * largest);
}

TEST(VertexClustering, AboutSoManyFacesAreLeft) {
    const TriangleMesh mesh = bumpy_torus(175);
    for (const std::size_t faces : {2'000, 6'000, 12'000}) {
        const ClusteredMesh result = cluster_to(faces, mesh);
        const auto left = static_cast<double>(result.mesh.triangles.size());
        EXPECT_GT(left, 0.8 * static_cast<double>(faces));
        EXPECT_LT(left, 1.2 * static_cast<double>(faces));
        EXPECT_EQ(result.mesh, cluster_vertices(mesh, result.cell).mesh);
    }
}

TEST(VertexClustering, AMeshWithFewEnoughFacesStays) {
    for (const shapes::Named& shape : shapes::all_closed()) {
        const ClusteredMesh result = cluster_to(shape.mesh.triangles.size(), shape.mesh);
        EXPECT_EQ(result.mesh, shape.mesh) << shape.name;
        EXPECT_EQ(result.cell, 0);
        EXPECT_EQ(result.largest_shift, 0);
    }
}

// What no closed scan is: faces without area, points far apart, none but one place.
TEST(VertexClustering, AwkwardMeshesAreTakenToo) {
    TriangleMesh soup;
    for (std::uint32_t i = 0; i < 900; ++i) soup.points.push_back({1e12 * std::sin(i), std::cos(7.0 * i), 0});
    for (std::uint32_t i = 0; i + 2 < 900; ++i) soup.triangles.push_back({i, i + 1, i + 2});
    EXPECT_LE(cluster_to(100, soup).mesh.triangles.size(), soup.triangles.size());
    TriangleMesh place{std::vector<Vec3>(9, {1, 2, 3}), std::vector<Triangle>(40, {0, 1, 2}), {}};
    EXPECT_TRUE(cluster_to(10, place).mesh.triangles.empty());
    EXPECT_TRUE(cluster_to(10, {}).mesh.triangles.empty());
    TriangleMesh tiny = shapes::ball({0, 0, 0}, 1e-300, 16);
    cluster_to(50, tiny);
}

TEST(VertexClustering, AnyNumberOfThreadsGivesTheSameBytes) {
    const TriangleMesh mesh = bumpy_torus(100);
    const ClusteredMesh expected = cluster_to(3'000, mesh);
    for (const std::size_t threads : {1, 2}) {
        const ThreadLimit limit(threads);
        EXPECT_EQ(cluster_to(3'000, mesh).mesh, expected.mesh);
    }
}

TEST(VertexClustering, ItIsCancelled) {
    const std::atomic<bool> cancelled{true};
    Context context;
    context.cancelled = &cancelled;
    EXPECT_THROW(cluster_to(100, bumpy_torus(40), context), Cancelled);
}

}  // namespace
}  // namespace qchopper
