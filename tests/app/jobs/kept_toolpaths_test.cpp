// A toolpath that is kept is read as it was, and leads to the program that would be made without it.

#include "app/jobs/kept_toolpaths.h"

#include <gtest/gtest.h>

#include "base/files/file.h"
#include "base/files/temporary_folder.h"
#include "cam/cell/job_tools.h"
#include "segment/search/segmentation.h"
#include "tests/app/ball_cap.h"

namespace qchopper {
namespace {

struct KeptToolpath : ::testing::Test {
    TemporaryFolder folder{"qchopper-toolpath-"};
    Cell cell = read_cell(std::filesystem::path(QCHOPPER_SOURCE_DIR) / "cells" / "kr60-ha.toml");
    Piece piece = uncut(ball_cap(), 0).pieces.front();
    Setups setups{cell};
    JobInput job;

    void SetUp() override {
        job.piece = piece;
        job.setup = setups.placed(piece).setup();
        job.cell = with_tools(cell, job.setup.tools);
        job.stock_fit = setups.placed(piece).stock_fit;
        job.machine_reachability = setups.placed(piece).machine_reachability;
    }
    std::filesystem::path file_of(const JobInput& input) const {
        return toolpath_file(folder.path(), {input, Sha256{}, FineTools::worthwhile});
    }
};

TEST_F(KeptToolpath, IsReadAsItWasAndLeadsToTheSameProgram) {
    const FollowedToolpath made = follow_toolpath(piece, setups.placed(piece), cell, {});
    ASSERT_EQ(made.none_because, "");
    ASSERT_FALSE(made.removed.empty());
    const std::filesystem::path file = file_of(job);
    keep_toolpath(file, made);
    const std::optional<FollowedToolpath> kept = kept_toolpath(file);
    ASSERT_TRUE(kept);
    EXPECT_EQ(kept->toolpath, made.toolpath);
    EXPECT_EQ(kept->place, made.place);
    ASSERT_EQ(kept->removed.size(), made.removed.size());
    for (std::size_t i = 0; i < made.removed.size(); ++i) {
        EXPECT_EQ(kept->removed[i].orientation, made.removed[i].orientation);
        EXPECT_EQ(kept->removed[i].down_to.height, made.removed[i].down_to.height);
        EXPECT_EQ(kept->removed[i].down_to.cell, made.removed[i].down_to.cell);
        EXPECT_EQ(kept->removed[i].down_to.columns, made.removed[i].down_to.columns);
        EXPECT_EQ(kept->removed[i].down_to.piece_in_field, made.removed[i].down_to.piece_in_field);
    }
    const auto programs = [&](std::optional<FollowedToolpath> followed) {
        return programs_bytes({job, Sha256{}}, make_programs(piece, setups.placed(piece), {1}, cell, {}, {},
                                                             FineTools::worthwhile, std::move(followed)));
    };
    EXPECT_EQ(programs(kept), programs({}));
    Bytes bytes = read_file(file);
    bytes[bytes.size() / 2] ^= 1U;
    write_file(file, bytes);
    EXPECT_FALSE(kept_toolpath(file)) << "damaged";
}

TEST_F(KeptToolpath, SaysWhyThereIsNone) {
    FollowedToolpath none;
    none.none_because = "no arm posture reaches it";
    none.is_machine_refusing = true;
    none.place = BlockPlacement{1, 2, 3, {4, 5}};
    keep_toolpath(file_of(job), none);
    const std::optional<FollowedToolpath> kept = kept_toolpath(file_of(job));
    ASSERT_TRUE(kept);
    EXPECT_EQ(kept->none_because, none.none_because);
    EXPECT_TRUE(kept->is_machine_refusing);
    EXPECT_EQ(kept->place, none.place);
    const PiecePrograms programs =
        make_programs(piece, setups.placed(piece), {1}, cell, {}, {}, FineTools::worthwhile, kept);
    EXPECT_TRUE(programs.parts.empty());
    EXPECT_EQ(programs.none_because, none.none_because);
    EXPECT_TRUE(programs.is_machine_refusing);
}

TEST_F(KeptToolpath, IsThatOfTheSetupWhateverTheHoles) {
    const std::filesystem::path file = file_of(job);
    JobInput other = job;
    other.caps.emplace_back();
    other.piece_no = 12;
    other.piece_count = 20;
    EXPECT_EQ(file_of(other), file);
    other.setup.spoil += 1;
    EXPECT_NE(file_of(other), file);
}

}  // namespace
}  // namespace qchopper
