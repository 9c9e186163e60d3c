// Where tools come to beside a tower: each step of holder and spindle limits.

#include "sim/replay/reach/reachable.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "sim/replay/scene.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

// A tower of 300 mm on the first corner of a plate.
TEST(ClosingOf, IsLimitedByHolderAndSpindleBesideATower) {
    Cell cell = read_cell(std::filesystem::path(QCHOPPER_SOURCE_DIR) / "cells" / "kr60-ha.toml");
    cell.machine->spindle.body_radius = 60;
    cell.machine->spindle.body_offset = 0;
    CuttingTool tool = cell.machine->tools[3];
    tool.stick_out = 100;
    tool.holder = {{20, 50}, {32, 50}};
    const TriangleMesh mesh =
        shapes::joined({shapes::box({0, 0, 0}, {150, 150, 2}), shapes::box({0, 0, 2}, {10, 10, 300})});
    ReplayScene scene;
    scene.cell = &cell;
    scene.orientations.push_back({{0, 0, 1}, 0, {}});
    scene.target = &mesh;
    const SurfaceMap map = closing_of(scene, 0, tool, {0.5}, {});
    const auto height_beside = [&](double mm) {
        const Vec3 p = apply_inverse(map.frame_in_setup, Vec3{10 + mm, 5, 0});
        return apply(map.frame_in_setup, Vec3{p.x, p.y, map.at(p.x, p.y)}).z;
    };
    EXPECT_NEAR(height_beside(6), 300 - 100, 0.1) << "the narrow step";
    EXPECT_NEAR(height_beside(40), 300 - 200, 0.1) << "the spindle";
    EXPECT_NEAR(height_beside(70), 2, 0.1);
}

}  // namespace
}  // namespace qchopper
