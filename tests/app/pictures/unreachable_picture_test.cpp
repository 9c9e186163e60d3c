#include "app/pictures/unreachable_picture.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "app/engine/outputs.h"
#include "cam/job/sheet/setup_picture.h"
#include "segment/picture/exploded.h"
#include "segment/search/segmentation.h"
#include "tests/cam/setup/pieces.h"
#include "tests/folder.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

// A box whose triangles all have one state, but the first one, which has another.
Bytes drawn(SurfaceState state, SurfaceState first) {
    const std::vector<Piece> pieces = uncut(shapes::box({0, 0, 0}, {40, 40, 40}, 2), 0).pieces;
    std::vector<SurfaceState> states(pieces[0].mesh->triangles.size(), state);
    states[0] = first;
    const Vec3 shift{};
    const MilledPiece carved{states, {}};
    return draw_unreachable(pieces, std::span(&shift, 1), std::span(&carved, 1), false);
}

TEST(UnreachablePicture, EveryStateHasAColourOfItsOwn) {
    const std::vector<SurfaceState> all{SurfaceState::reached, SurfaceState::too_narrow, SurfaceState::steep,
                                        SurfaceState::holder,  SurfaceState::hidden,     SurfaceState::ignored};
    std::vector<Bytes> pictures;
    for (const SurfaceState state : all) {
        pictures.push_back(drawn(state, state));
        for (std::size_t i = 0; i + 1 < pictures.size(); ++i) EXPECT_NE(pictures[i], pictures.back());
    }
    EXPECT_EQ(pictures[0], drawn(SurfaceState::reached, SurfaceState::reached)) << "same input, same bytes";
}

TEST(UnreachablePicture, TheLegendNamesWhatOccurs) {
    // One triangle of 48: without the legend's entry of the holder the pictures would hardly differ.
    EXPECT_NE(drawn(SurfaceState::reached, SurfaceState::holder), drawn(SurfaceState::reached, SurfaceState::reached));
}

TEST(UnreachablePicture, APieceOfUnknownStatesIsDrawnAsReached) {
    const std::vector<Piece> pieces = uncut(shapes::box({0, 0, 0}, {40, 40, 40}, 2), 0).pieces;
    const Vec3 shift{};
    const MilledPiece carved{};
    EXPECT_EQ(draw_unreachable(pieces, std::span(&shift, 1), std::span(&carved, 1), false),
              drawn(SurfaceState::reached, SurfaceState::reached));
}

// A cell with a wall at which the tool cannot lean: jobs are made with other directions than the best setup has.
TEST(UnreachablePicture, OfAProjectIsThatOfTheSetupsThatJobsAreMadeOf) {
    Cell cell = read_cell(std::filesystem::path(QCHOPPER_SOURCE_DIR) / "cells" / "kr60-ha.toml");
    cell.machine->obstacles.push_back({"wall", {{1400, -500, 0}, {1500, 500, 1100}}});
    const Piece ball = test_pieces::uncut(shapes::ball({0, 0, 0}, 80, 24));
    const std::vector<Piece> pieces{cut_piece(ball, {{0, 0, 1}, -56.3}, 1)->pieces.at(0)};
    Setups setups(std::move(cell));
    setups.set_orders({{pieces[0].name, 1, {}}});
    const std::vector<SurfaceState> best = setups.mapped(pieces[0]).choice.states;
    const std::vector<SurfaceState> held = setups.placed(pieces[0]).choice.states;
    ASSERT_NE(best, held);
    const Folder folder;
    std::filesystem::create_directories(folder.path / "pictures");
    write_pictures(folder.path, pieces, setups, {});
    const std::vector<Vec3> shifts = exploded_shifts(pieces);
    const auto drawn_by = [&](const std::vector<SurfaceState>& states) {
        const MilledPiece carved{states, 1};
        return draw_unreachable(pieces, shifts, std::span(&carved, 1), false);
    };
    const Bytes picture = read_file(folder.path / "pictures" / "unreachable.png");
    EXPECT_TRUE(picture == drawn_by(held));
    EXPECT_FALSE(picture == drawn_by(best));
}

TEST(UnreachablePicture, WhatIsTooNarrowIsPaleUnlessItCounts) {
    const auto luma = [](Rgb c) { return 0.21 * c.r + 0.72 * c.g + 0.07 * c.b; };
    const double narrow = luma(surface_colour(SurfaceState::too_narrow, false));
    for (const SurfaceState state : {SurfaceState::holder, SurfaceState::hidden}) {
        EXPECT_GT(narrow, luma(surface_colour(state, false)) + 80) << "what counts is seen beside it";
    }
    EXPECT_LT(luma(surface_colour(SurfaceState::too_narrow, true)), narrow - 80);
}

}  // namespace
}  // namespace qchopper
