#include "segment/structure/voxels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "segment/cut/cut.h"
#include "segment/mesh/connectivity/containment.h"
#include "segment/mesh/measure.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

TEST(Voxels, OfEveryShapeAreThoseWhoseCentresLieInside) {
    for (const auto& [name, mesh, solids] : shapes::all_closed()) {
        const Box box = bounds(mesh);
        const Vec3 s = box.size();
        const double size = std::max({s.x, s.y, s.z}) / 9.371;
        for (const Vec3 up : {Vec3{0, 0, 1}, Vec3{1, 2, -2}, Vec3{0, -3, 0}}) {
            const VoxelGrid grid = voxel_grid(mesh, up, size);
            std::vector<std::uint32_t> voxels = voxels_inside(mesh, grid);
            std::vector<std::uint32_t> wanted;
            for (std::uint32_t v = 0; v < grid.count[0] * grid.count[1] * grid.count[2]; ++v) {
                const Vec3 centre = grid.centre(v);
                const bool is_in = is_inside(mesh, centre);
                if (is_in) wanted.push_back(v);
                // A point on the surface may be either.
                for (const Vec3 step : {Vec3{0, 0, 1e-7}, Vec3{0, 0, -1e-7}, Vec3{1e-7, 1e-7, 0}}) {
                    if (is_inside(mesh, centre + step) == is_in) continue;
                    std::erase(wanted, v);
                    std::erase(voxels, v);
                }
            }
            EXPECT_EQ(voxels, wanted) << name;
        }
    }
}

TEST(Voxels, OfABarOfWholeVoxelsFillItWithoutARest) {
    const TriangleMesh bar = shapes::box({-3, 10, 7}, {1, 16, 27});
    const VoxelGrid grid = voxel_grid(bar, {0, 0, 2}, 2);
    EXPECT_EQ(static_cast<std::size_t>(grid.count[0]) * grid.count[1] * grid.count[2], 60U);
    EXPECT_EQ(grid.count[2], 10U);
    EXPECT_EQ(voxels_inside(bar, grid).size(), 60U);
    EXPECT_NEAR(grid.centre(0).z, 8, 1e-12) << "the third axis is the upright direction";
}

TEST(Voxels, OfTheHalvesOfACutAreThoseOfTheWhole) {
    const TriangleMesh torus = shapes::torus({1, 2, 3}, 20, 7);
    const VoxelGrid grid = voxel_grid(torus, {0.3, -0.2, 1}, 1.3);
    const auto halves = cut(torus, canonical({normalized({1, 0.4, 0.2}), 0.123}), 1);
    ASSERT_TRUE(halves);
    std::vector<std::uint32_t> both = voxels_inside(halves->above.mesh, grid);
    const std::vector<std::uint32_t> below = voxels_inside(halves->below.mesh, grid);
    EXPECT_GT(both.size(), 100U);
    EXPECT_GT(below.size(), 100U);
    both.insert(both.end(), below.begin(), below.end());
    std::sort(both.begin(), both.end());
    EXPECT_EQ(both, voxels_inside(torus, grid));
}

TEST(Voxels, BesideEachOtherAreThoseOneStepAway) {
    const TriangleMesh ball = shapes::ball({0, 0, 0}, 5);
    const VoxelGrid grid = voxel_grid(ball, {0, 0, 1}, 1);
    const std::vector<std::uint32_t> voxels = voxels_inside(ball, grid);
    const std::vector<VoxelNeighbours> beside = voxel_neighbours(grid, voxels);
    for (std::size_t i = 0; i < voxels.size(); ++i) {
        for (std::size_t side = 0; side < 6; ++side) {
            const int axis = static_cast<int>(side / 2);
            VoxelPlace at = grid.place(voxels[i]);
            Vec3 moved{static_cast<double>(at[0]), static_cast<double>(at[1]), static_cast<double>(at[2])};
            moved[axis] += side % 2 == 0 ? -1 : 1;
            std::uint32_t wanted = no_voxel;
            for (std::uint32_t j = 0; j < voxels.size(); ++j) {
                at = grid.place(voxels[j]);
                if (at[0] == moved.x && at[1] == moved.y && at[2] == moved.z) wanted = j;
            }
            EXPECT_EQ(beside[i][side], wanted);
        }
    }
}

TEST(Voxels, AreThickWhereABlockOfThreeFits) {
    const TriangleMesh handle = shapes::box({0, 0, 0}, {4, 4, 4});
    const TriangleMesh wall = shapes::box({3.5, 0, 0}, {10, 2, 4});
    const TriangleMesh both = shapes::joined({handle, wall});
    const VoxelGrid grid = voxel_grid(both, {0, 0, 1}, 1);
    const std::vector<std::uint32_t> voxels = voxels_inside(both, grid);
    const std::vector<std::uint8_t> thick = thick_voxels(grid, voxels);
    ASSERT_EQ(voxels.size(), 64U + 48U);
    for (std::size_t i = 0; i < voxels.size(); ++i) EXPECT_EQ(thick[i] != 0, grid.centre(voxels[i]).x < 4);
}

TEST(Voxels, OfTooLargeAGridAreRefused) {
    EXPECT_THROW(voxel_grid(shapes::box({0, 0, 0}, {10, 10, 10}), {0, 0, 1}, 0.001), InputError);
}

}  // namespace
}  // namespace qchopper
