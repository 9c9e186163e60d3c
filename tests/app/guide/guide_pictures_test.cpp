#include "app/guide/guide_pictures.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <set>

#include "base/parallel.h"
#include "tests/app/guide/cut_box.h"

namespace qchopper {
namespace {

// Pixels whose red, green and blue stand to each other as those of a colour, whatever the light.
std::size_t count_like(const Pixels& pixels, Rgb colour) {
    const auto hue = [](Rgb c) {
        const double sum = c.r + c.g + c.b + 1;
        return Vec3{c.r / sum, c.g / sum, c.b / sum};
    };
    return static_cast<std::size_t>(std::count_if(pixels.rows.begin(), pixels.rows.end(), [&](Rgb c) {
        return c.r + c.g + c.b > 120 && norm(hue(c) - hue(colour)) < 0.05;
    }));
}

TEST(GuidePictures, EveryStepIsSeenFromAboveAndFromWhereItsGlueFacesShow) {
    std::mt19937 random(5);
    std::normal_distribution<double> normal;
    for (int i = 0; i < 200; ++i) {
        const Vec3 move = normalized({normal(random), normal(random), normal(random)});
        const Vec3 view = view_of_step(move);
        EXPECT_NEAR(norm(view), 1, 1e-12);
        EXPECT_LT(view.z, 0) << "from above";
        const bool comes_from_below = move.z > 0.8;  // then no view from above sees the faces of what stands
        EXPECT_TRUE(comes_from_below || dot(view, move) > 0.1) << move.x << " " << move.y << " " << move.z;
        EXPECT_LT(std::abs(dot(view, move)), 0.95) << "the move is seen from the side";
    }
}

TEST(GuidePictures, AStepShowsWhatMovesWhatStandsAndTheGlueFaces) {
    const CutBox box;
    const auto& steps = box.joints.assembly.steps;
    ASSERT_EQ(steps.size(), 2U);
    for (const AssemblyStep& step : steps) {
        const Pixels pixels = draw_step(box.pieces(), box.joints, step, {});
        EXPECT_GT(count_like(pixels, standing_colour), 2000U);
        for (const std::size_t p : step.moved) EXPECT_GT(count_like(pixels, piece_colour(p)), 2000U) << p;
        AssemblyStep without_joints = step;
        without_joints.joints.clear();
        const Pixels unglued = draw_step(box.pieces(), box.joints, without_joints, {});
        std::size_t marked = 0;
        for (std::size_t i = 0; i < pixels.rows.size(); ++i) {
            const int redder = int{pixels.rows[i].r} - pixels.rows[i].b - (int{unglued.rows[i].r} - unglued.rows[i].b);
            marked += redder > 40 ? 1 : 0;
        }
        EXPECT_GT(marked, 2000U) << "glue faces are orange";
    }
}

TEST(GuidePictures, APieceThatComesLaterIsNotThereYet) {
    const CutBox box;
    const AssemblyStep& first = box.joints.assembly.steps[0];
    ASSERT_EQ(first.moved.size() + first.standing.size(), 2U);
    std::vector<Piece> others = box.pieces();
    for (std::size_t p = 0; p < others.size(); ++p) {
        if (p == first.moved[0] || p == first.standing[0]) continue;
        others[p].mesh = std::make_shared<const TriangleMesh>(shapes::ball({900, 0, 0}, 300));
    }
    EXPECT_EQ(draw_step(others, box.joints, first, {}).rows, draw_step(box.pieces(), box.joints, first, {}).rows);
}

TEST(GuidePictures, OnOneOfBothSidesOfAPieceEveryNeighbourIsNamed) {
    const CutBox box;
    for (std::size_t p = 0; p < box.pieces().size(); ++p) {
        std::set<std::size_t> seen;
        for (const GuideSide side : {GuideSide::front, GuideSide::back}) {
            const DrawnPiece drawn = draw_piece(box.pieces(), p, box.joints, side, {});
            EXPECT_GT(count_like(drawn.pixels, piece_colour(p)), 2000U);
            seen.insert(drawn.seen.begin(), drawn.seen.end());
        }
        std::set<std::size_t> joined;
        for (std::size_t j = 0; j < box.joints.joints.size(); ++j) {
            if (box.joints.joints[j].below == p || box.joints.joints[j].above == p) joined.insert(j);
        }
        EXPECT_EQ(seen, joined) << box.pieces()[p].name;
    }
}

TEST(GuidePictures, AreTheSameForAnyNumberOfThreads) {
    const CutBox box;
    const auto all = [&] {
        return std::vector{draw_apart(box.pieces(), GuideSide::back, {}).rows,
                           draw_step(box.pieces(), box.joints, box.joints.assembly.steps[0], {}).rows,
                           draw_piece(box.pieces(), 1, box.joints, GuideSide::front, {}).pixels.rows};
    };
    const auto many = all();
    const ThreadLimit one(1);
    EXPECT_EQ(all(), many);
}

}  // namespace
}  // namespace qchopper
