#include "segment/repair/split_non_manifold.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "segment/mesh/connectivity/edges.h"
#include "segment/mesh/connectivity/shells.h"
#include "segment/mesh/measure.h"
#include "segment/repair/weld.h"
#include "tests/reference/segment/mesh/non_manifold_vertices.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

// Manifold: no non-manifold edge, and no vertex left to split.
void expect_manifold(const TriangleMesh& mesh, const std::string& what) {
    const Edges found = edges(mesh);
    EXPECT_EQ(found.faults.non_manifold + found.faults.inconsistent, 0U) << what;
    EXPECT_EQ(count_non_manifold_vertices(mesh, found), 0U) << what;
}

void expect_a_second_split_changes_nothing(const TriangleMesh& mesh, const std::string& what) {
    TriangleMesh again = mesh;
    weld(again);
    split_non_manifold(again);
    EXPECT_EQ(again, mesh) << what;
}

TriangleMesh split(TriangleMesh mesh, SplitCounts* counts = nullptr) {
    weld(mesh);
    const SplitCounts found = split_non_manifold(mesh);
    if (counts != nullptr) *counts = found;
    expect_manifold(mesh, "");
    return mesh;
}

// A strip around z with so many half turns.
TriangleMesh strip(int half_turns, int n) {
    using std::numbers::pi;
    TriangleMesh mesh;
    for (int i = 0; i < n; ++i) {
        const double u = 2 * pi * i / n;
        const double v = pi * half_turns * i / n;
        for (const double side : {-1.0, 1.0}) {
            const double r = 10 + 2 * side * std::cos(v);
            mesh.points.push_back({r * std::cos(u), r * std::sin(u), 2 * side * std::sin(v)});
        }
    }
    for (int i = 0; i < n; ++i) {
        const auto a = static_cast<std::uint32_t>(2 * i);
        const bool is_last = i + 1 == n;
        const auto c = static_cast<std::uint32_t>(is_last ? half_turns % 2 : 2 * i + 2);
        const auto d = static_cast<std::uint32_t>(is_last ? 1 - half_turns % 2 : 2 * i + 3);
        mesh.triangles.push_back({a, a + 1, d});
        mesh.triangles.push_back({a, d, c});
    }
    return mesh;
}

TEST(SplitNonManifold, ClosedShapesStayAsTheyAre) {
    for (const shapes::Named& shape : shapes::all_closed()) {
        SplitCounts counts;
        EXPECT_EQ(split(shape.mesh, &counts), shape.mesh) << shape.name;
        EXPECT_EQ(counts.copies + counts.faces_reoriented + counts.edges_cut, 0U) << shape.name;
    }
}

TEST(SplitNonManifold, FacesThatDisagreeAreTurnedBack) {
    std::mt19937 random(7);
    for (const shapes::Named& shape : shapes::all_closed()) {
        TriangleMesh mesh = shape.mesh;
        std::size_t turned = 0;
        for (Triangle& t : mesh.triangles) {
            if (random() % 4 != 0) continue;
            std::swap(t[1], t[2]);
            ++turned;
        }
        SplitCounts counts;
        const TriangleMesh result = split(mesh, &counts);
        EXPECT_EQ(result.points, shape.mesh.points) << shape.name;
        EXPECT_TRUE(edges(result).faults.is_closed()) << shape.name;
        EXPECT_LE(counts.faces_reoriented, turned) << shape.name;
        const Shells before = shells(shape.mesh);
        const Shells after = shells(result);
        ASSERT_EQ(after.count(), before.count()) << shape.name;
        for (std::size_t s = 0; s < after.count(); ++s) {
            EXPECT_NEAR(std::abs(after.volume[s]) / std::abs(before.volume[s]), 1, 1e-9) << shape.name;
        }
    }
}

TEST(SplitNonManifold, SolidsThatTouchAlongAnEdgeAreSplitThere) {
    SplitCounts counts;
    const TriangleMesh mesh = split(
        shapes::joined({shapes::box({0, 0, 0}, {10, 10, 10}, 2), shapes::box({10, 10, 0}, {20, 20, 10}, 2)}), &counts);
    EXPECT_EQ(counts.edges_split, 2U);
    EXPECT_EQ(counts.copies, 3U);
    EXPECT_TRUE(edges(mesh).faults.is_closed());
    const Shells found = shells(mesh);
    ASSERT_EQ(found.count(), 2U);
    EXPECT_NEAR(found.volume[0], 1000, 1e-9);
    EXPECT_NEAR(found.volume[1], 1000, 1e-9);
    expect_a_second_split_changes_nothing(mesh, "touching boxes");
}

TEST(SplitNonManifold, ThreeSolidsAroundOneEdgeAreSplitThere) {
    // Wedges of 60 degrees with gaps of 60 degrees between them.
    TriangleMesh all;
    for (int i = 0; i < 3; ++i) {
        TriangleMesh wedge;
        const double a = 2 * std::numbers::pi * i / 3;
        const double b = a + std::numbers::pi / 3;
        for (const double z : {0.0, 5.0}) {
            wedge.points.push_back({0, 0, z});
            wedge.points.push_back({std::cos(a), std::sin(a), z});
            wedge.points.push_back({std::cos(b), std::sin(b), z});
        }
        wedge.triangles = {{0, 2, 1}, {3, 4, 5}, {0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}, {2, 0, 3}, {2, 3, 5}};
        all = shapes::joined({all, wedge});
    }
    const TriangleMesh mesh = split(all);
    EXPECT_TRUE(edges(mesh).faults.is_closed());
    EXPECT_EQ(shells(mesh).count(), 3U);
    for (const double volume : shells(mesh).volume) EXPECT_NEAR(volume, 5 * std::sqrt(3) / 4, 1e-12);
    expect_a_second_split_changes_nothing(mesh, "wedges");
}

TEST(SplitNonManifold, AFinIsSplitFromTheSolidThatItStandsOn) {
    for (const shapes::Named& shape : shapes::all_closed()) {
        TriangleMesh mesh = shape.mesh;
        const Triangle face = mesh.triangles.front();
        mesh.points.push_back(mesh.points[face[0]] + 2.0 * normalized(area_vector(mesh, 0)));
        mesh.triangles.push_back({face[0], face[1], static_cast<std::uint32_t>(mesh.points.size() - 1)});
        const TriangleMesh result = split(mesh);
        const Edges found = edges(result);
        EXPECT_EQ(found.faults.open, 3U) << shape.name;  // of the fin
        EXPECT_EQ(shells(result).count(), shells(shape.mesh).count() + 1) << shape.name;
        expect_a_second_split_changes_nothing(result, shape.name);
    }
}

TEST(SplitNonManifold, ASurfaceWithOneSideIsCutOpen) {
    for (const int turns : {1, 3}) {
        SplitCounts counts;
        const TriangleMesh mesh = split(strip(turns, 24), &counts);
        EXPECT_GE(counts.edges_cut, 1U);
        EXPECT_EQ(mesh.triangles.size(), 48U);
        EXPECT_EQ(shells(mesh).count(), 1U);
    }
    SplitCounts counts;
    split(strip(2, 24), &counts);
    EXPECT_EQ(counts.edges_cut, 0U);
}

TEST(SplitNonManifold, WhatMayNotBeTurnedIsCutOpen) {
    TriangleMesh mesh = shapes::box({0, 0, 0}, {10, 10, 10}, 3);
    std::swap(mesh.triangles[5][1], mesh.triangles[5][2]);
    const Vec3 normal = area_vector(mesh, 5);
    SplitOptions options;
    options.turn = false;
    EXPECT_EQ(split_non_manifold(mesh, options).edges_cut, 3U);
    expect_manifold(mesh, "");
    EXPECT_EQ(edges(mesh).faults.open, 6U);
    EXPECT_EQ(area_vector(mesh, 5), normal);
}

TEST(SplitNonManifold, ASoupIsSplitToo) {
    std::mt19937 random(3);
    for (int round = 0; round < 200; ++round) {
        TriangleMesh mesh;
        for (int i = 0; i < 6; ++i) {
            mesh.points.push_back({static_cast<double>(random() % 9), static_cast<double>(random() % 9), double(i)});
        }
        for (int i = 0; i < 12; ++i) {
            const Triangle t{static_cast<std::uint32_t>(random() % 6), static_cast<std::uint32_t>(random() % 6),
                             static_cast<std::uint32_t>(random() % 6)};
            if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) mesh.triangles.push_back(t);
        }
        weld(mesh);
        const std::size_t faces = mesh.triangles.size();
        split_non_manifold(mesh);
        expect_manifold(mesh, "round " + std::to_string(round));
        EXPECT_EQ(mesh.triangles.size(), faces);
    }
}

}  // namespace
}  // namespace qchopper
