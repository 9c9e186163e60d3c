#include "cam/job/sheet/touch_points.h"

#include <gtest/gtest.h>

#include "tests/cam/job/sawn_jobs.h"

namespace qchopper {
namespace {

using namespace test_pieces;
using PieceSetup = qchopper::Setup;  // gtest has a Setup of its own

PieceSetup with_faces(const std::vector<BlockFace>& faces) {
    PieceSetup setup;
    setup.spoil = 10;
    setup.block.size = {100, 80, 60};
    for (std::size_t f = 0; f < faces.size(); ++f) {
        setup.flush_caps.push_back({static_cast<std::int32_t>(f + 1), faces[f], 1000.0 - static_cast<double>(f)});
    }
    return setup;
}

TEST(TouchPoints, WithoutAGlueFaceAtTheSidesAreThreeCorners) {
    for (const std::vector<BlockFace>& faces : {std::vector<BlockFace>{}, {BlockFace::top}}) {
        const auto [first, second, third] = touch_points(with_faces(faces));
        EXPECT_EQ(first.at, (Vec3{-50, -40, 50}));
        EXPECT_EQ(second.at, (Vec3{50, -40, 50}));
        EXPECT_EQ(third.at, (Vec3{-50, 40, 50}));
        EXPECT_EQ(third.where, "corner of the block's top at -x, +y");
    }
}

TEST(TouchPoints, LieOnTheGlueFacesThatAreTouched) {
    const auto [first, second, third] = touch_points(with_faces({BlockFace::plus_y, BlockFace::minus_x}));
    EXPECT_EQ(first.at, (Vec3{-40, 40, 25}));
    EXPECT_EQ(second.at, (Vec3{40, 40, 25}));
    EXPECT_EQ(third.at, (Vec3{-50, 0, 25}));
    EXPECT_EQ(first.where, "glue face +y, at -x");
    EXPECT_EQ(second.where, "glue face +y, at +x");
    EXPECT_EQ(third.where, "glue face -x, at its middle");
}

TEST(TouchPoints, WithoutASecondGlueFaceTheThirdIsACornerOfTheFirst) {
    const auto of = [](BlockFace face) { return touch_points(with_faces({face}))[2]; };
    EXPECT_EQ(of(BlockFace::plus_x).at, (Vec3{50, -40, 50}));
    EXPECT_EQ(of(BlockFace::minus_x).at, (Vec3{-50, -40, 50}));
    EXPECT_EQ(of(BlockFace::plus_y).at, (Vec3{-50, 40, 50}));
    EXPECT_EQ(of(BlockFace::minus_y).at, (Vec3{-50, -40, 50}));
}

// Whatever faces there are: the first two give a direction, and the third does not lie on their line.
TEST(TouchPoints, GiveAFrameForEveryJob) {
    for (const JobInput& input : sawn_jobs().inputs) {
        const Box block = input.setup.block_box();
        const auto points = touch_points(input.setup);
        const Vec3 along = points[1].at - points[0].at;
        EXPECT_GT(norm(along), 20);
        EXPECT_TRUE(along.x == 0 || along.y == 0) << "parallel to a side";
        EXPECT_EQ(along.z, 0);
        for (const TouchPoint& point : points) {
            const bool is_on_x = point.at.x == block.min.x || point.at.x == block.max.x;
            const bool is_on_y = point.at.y == block.min.y || point.at.y == block.max.y;
            EXPECT_TRUE(is_on_x || is_on_y) << point.where;
            EXPECT_GT(point.at.z, 0) << "clamps hold the spoil layer";
        }
    }
}

}  // namespace
}  // namespace qchopper
