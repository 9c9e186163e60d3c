#include "cam/setup/undercut.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/cam/setup/pieces.h"

namespace qchopper {
namespace {

using namespace test_pieces;

TEST(Undercut, OnAClosedPieceUpIsDownAndBase) {
    int bases = 0;
    for (const Piece& piece : cut_shapes()) {
        for (const HalfSpace& half_space : piece.half_spaces) {
            const Facing sums = facing(*piece.mesh, half_space.up(), half_space.cut);
            EXPECT_NEAR(sums.up, sums.down + sums.base, 1e-9 * area_mm2(*piece.mesh)) << piece.name;
            if (sums.base <= 0) continue;
            ++bases;
            EXPECT_LT(sums.undercut(), 0.5);
        }
        const Facing without = facing(*piece.mesh, {0, 0, 1}, std::nullopt);
        EXPECT_NEAR(without.undercut(), 0.5, 1e-9) << "with the base counted the share is always one half";
    }
    EXPECT_GT(bases, 20);
}

TEST(Undercut, CapsThatAreSawnAreLeftOut) {
    TriangleMesh box = shapes::box({0, 0, 0}, {10, 20, 30});
    box.cap_of.assign(box.triangles.size(), no_cap);
    for (std::size_t t = 0; t < box.triangles.size(); ++t) {
        const Vec3 out = area_vector(box, t);
        if (out.z > 0) box.cap_of[t] = 7;
        if (out.z < 0) box.cap_of[t] = 3;
    }
    const std::vector<std::int32_t> sawn{7};
    EXPECT_DOUBLE_EQ(facing(box, {0, 0, 1}, 3).up, 200);
    EXPECT_DOUBLE_EQ(facing(box, {0, 0, 1}, 3, sawn).up, 0);
    EXPECT_DOUBLE_EQ(facing(box, {0, 0, 1}, {}, sawn).down, 200);
    EXPECT_DOUBLE_EQ(facing(box, {0, 0, -1}, {}, sawn).down, 0) << "an overhang that the saw makes";
    EXPECT_EQ(facing(box, {0, 0, -1}, {}, sawn).triangles_down, 0U);
}

TEST(Undercut, ByCountEveryTriangleIsWorthTheSame) {
    const TriangleMesh box = shapes::box({0, 0, 0}, {1, 2, 3});
    const Facing all = facing(box, {0, 0, 1}, std::nullopt);
    EXPECT_EQ(all.triangles_down, 2U);
    EXPECT_EQ(all.triangles_up, box.triangles.size() - 2);
    EXPECT_DOUBLE_EQ(all.undercut_by_count(), 2.0 / static_cast<double>(box.triangles.size()));
    EXPECT_DOUBLE_EQ(Facing{}.undercut_by_count(), 0.5);
}

}  // namespace
}  // namespace qchopper
