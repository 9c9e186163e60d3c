// A block that stands where the arm cannot follow the toolpath is placed once more.

#include <gtest/gtest.h>

#include <filesystem>

#include "app/jobs/piece_program.h"
#include "cam/cell/cell.h"
#include "segment/search/segmentation.h"
#include "tests/app/ball_cap.h"

namespace qchopper {
namespace {

TEST(PlacedAgain, WhereTheArmHoldsTheToolpath) {
    const Cell cell = read_cell(std::filesystem::path(QCHOPPER_SOURCE_DIR) / "cells" / "kr60-ha.toml");
    const Piece piece = uncut(ball_cap(), 0).pieces.front();
    Setups setups(cell);
    const PlacedSetup held = setups.placed(piece);
    ASSERT_TRUE(held.fits());
    PlacedSetup far = held;
    far.choice.setups.front().placement.x += 2500;  // beyond the arm, whatever the margins say
    const PiecePrograms programs = make_programs(piece, far, 1, cell, {}, {});
    ASSERT_EQ(programs.parts.size(), 1U) << programs.none_because;
    EXPECT_TRUE(programs.parts.front().proof.is_proven());
    ASSERT_TRUE(programs.place);
    EXPECT_NE(*programs.place, far.setup().placement);

    const PiecePrograms as_known = make_programs(piece, held, 1, cell, {}, {});
    EXPECT_FALSE(as_known.place);

    setups.set_places({{piece.name, *programs.place}});
    const PlacedSetup& again = setups.placed(piece);
    EXPECT_TRUE(again.fits());
    EXPECT_EQ(again.setup().placement, *programs.place);
    setups.set_places({{piece.name, far.setup().placement}});
    EXPECT_EQ(setups.placed(piece).setup().placement, held.setup().placement) << "a place that does not hold the setup";
    setups.set_places({});
    EXPECT_EQ(setups.placed(piece).setup(), held.setup());
}

}  // namespace
}  // namespace qchopper
