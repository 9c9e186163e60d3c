#include "sim/replay/reach/target_surface.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <random>

namespace qchopper {
namespace {

// Each triangle in four, by the middles of its sides.
TriangleMesh divided(const TriangleMesh& mesh) {
    TriangleMesh fine{mesh.points, {}, {}, {}};
    for (const Triangle& t : mesh.triangles) {
        std::array<std::uint32_t, 3> middle{};
        for (std::size_t k = 0; k < 3; ++k) {
            middle[k] = static_cast<std::uint32_t>(fine.points.size());
            fine.points.push_back(0.5 * (mesh.points[t[k]] + mesh.points[t[(k + 1) % 3]]));
        }
        for (std::size_t k = 0; k < 3; ++k) fine.triangles.push_back({t[k], middle[k], middle[(k + 2) % 3]});
        fine.triangles.push_back({middle[0], middle[1], middle[2]});
    }
    return fine;
}

// Of wide triangles the cells of a row that are between the sides are looked for, of narrow ones all are tried.
TEST(TargetSurface, IsTheSameForWideTrianglesAndForTheirParts) {
    const Cell cell = read_cell(std::filesystem::path(QCHOPPER_SOURCE_DIR) / "cells" / "kr60-ha.toml");
    std::mt19937 random(4);
    std::uniform_real_distribution<double> at(0, 80);
    for (int round = 0; round < 12; ++round) {
        TriangleMesh mesh;
        for (int i = 0; i < 6; ++i) mesh.points.push_back({at(random), at(random), 0.2 * at(random)});
        mesh.points[4].y = mesh.points[3].y + (round % 2 == 0 ? 0 : 1e-5);  // a side along the rows
        mesh.triangles = {{0, 1, 2}, {3, 4, 5}};
        TriangleMesh parts = mesh;
        for (int i = 0; i < 5; ++i) parts = divided(parts);
        mesh.points = parts.points;  // which count in the cells that hold them
        ReplayScene scene;
        scene.cell = &cell;
        scene.orientations.push_back({{0, 0, 1}, 0, {}});
        scene.target = &mesh;
        const SurfaceMap wide = target_surface(scene, 0, 0.5, 3);
        scene.target = &parts;
        const SurfaceMap narrow = target_surface(scene, 0, 0.5, 3);
        ASSERT_EQ(wide.columns, narrow.columns);
        std::size_t wrong = 0;
        for (std::size_t i = 0; i < wide.height.size(); ++i) {
            wrong += std::abs(wide.height[i] - narrow.height[i]) < 0.001F ? 0 : 1;
        }
        EXPECT_EQ(wrong, 0U) << round;
    }
}

}  // namespace
}  // namespace qchopper
