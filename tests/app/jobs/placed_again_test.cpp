// A block that stands where the arm cannot follow the toolpath is placed once more.

#include <gtest/gtest.h>

#include <filesystem>

#include "app/jobs/piece_jobs.h"
#include "app/jobs/piece_program.h"
#include "cam/cell/cell.h"
#include "segment/search/segmentation.h"
#include "tests/app/ball_cap.h"
#include "tests/folder.h"

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
    const PiecePrograms programs = make_programs(piece, far, {1}, cell, {}, {});
    ASSERT_EQ(programs.parts.size(), 1U) << programs.none_because;
    EXPECT_TRUE(programs.parts.front().proof.is_proven());
    ASSERT_TRUE(programs.place);
    EXPECT_NE(*programs.place, far.setup().placement);

    const PiecePrograms as_known = make_programs(piece, held, {1}, cell, {}, {});
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

// Else the next run, which keeps the program, would have the block elsewhere.
TEST(PlacedAgain, APlaceStaysOnRecordWhenTheJobIsWrittenAgain) {
    const Folder folder;
    const std::filesystem::path ready = std::filesystem::path(QCHOPPER_SOURCE_DIR) / "cells" / "kr60-ha.toml";
    std::filesystem::copy_file(ready, folder.path / "cell.toml");
    std::filesystem::create_directory(folder.path / "jobs");
    const Segmentation segmentation = uncut(ball_cap(), 0);
    const Piece& piece = segmentation.pieces.front();
    Project project;
    project.has_programs = false;
    Setups setups(read_cell(ready));
    const auto write = [&] {
        write_job(folder.path, project, segmentation, 0, setups, {}, "1.0", {});
        return project.jobs.at(0).place;
    };
    EXPECT_FALSE(write()) << "it stands where its poses have it";
    const BlockPlacement place = setups.placed(piece).setup().placement;
    project.jobs.at(0).place = place;
    EXPECT_EQ(write(), place);
    EXPECT_EQ(write(), place);
    project.jobs.at(0).place->x += 2500;
    EXPECT_FALSE(write()) << "the setup stands elsewhere";
}

}  // namespace
}  // namespace qchopper
