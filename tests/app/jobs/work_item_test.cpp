// Items are read as they were written, to the bit, and nothing else is read.

#include "app/jobs/work_item.h"

#include <gtest/gtest.h>

#include "app/jobs/piece_jobs.h"
#include "app/jobs/setups.h"
#include "base/error.h"
#include "base/files/temporary_folder.h"
#include "cam/cell/job_tools.h"
#include "cam/job/manifest.h"
#include "segment/search/segmentation.h"
#include "tests/app/ball_cap.h"

namespace qchopper {
namespace {

constexpr const char* build = "0.1.0+abc";

struct Item : ::testing::TestWithParam<const char*> {
    TemporaryFolder folder{"qchopper-item-"};
    std::filesystem::path file = folder.path() / "A.qitem";

    WorkItem made() const {
        const Bytes text =
            read_file(std::filesystem::path(QCHOPPER_SOURCE_DIR) / "cells" / (std::string(GetParam()) + ".toml"));
        const Cell cell = parse_cell(std::string(text.begin(), text.end()), "cell.toml");
        JobInput job;
        job.piece = uncut(ball_cap(), 0).pieces.front();
        job.program_version = build;
        job.piece_no = 3;
        job.piece_count = 7;
        Setups setups(cell);
        const PlacedSetup& placed = setups.placed(job.piece);
        job.setup = placed.setup();
        job.cell = with_tools(cell, job.setup.tools);
        job.stock_fit = placed.stock_fit;
        job.machine_reachability = placed.machine_reachability;
        job.alternatives.assign(placed.choice.setups.begin() + 1, placed.choice.setups.end());
        job.states = placed.choice.states;
        job.warnings = {"scaled by 2 on request"};
        return work_item(job, placed, text, FineTools::all, "0123.programs");
    }

    std::string refusal() const {
        try {
            item_from(read_file(file), file, build);
        } catch (const InputError& error) {
            EXPECT_EQ(error.fault, InputFault::mesh);
            return error.what();
        }
        return {};
    }
};

TEST_P(Item, IsReadAsItWasWritten) {
    const WorkItem item = made();
    write_file(file, to_bytes(item));
    const WorkItem read = item_from(read_file(file), file, build);
    EXPECT_EQ(read.job.setup, item.job.setup);
    EXPECT_EQ(read.job.piece.name, item.job.piece.name);
    EXPECT_EQ(*read.job.piece.mesh, *item.job.piece.mesh);
    EXPECT_EQ(read.job.piece.half_spaces, item.job.piece.half_spaces);
    EXPECT_EQ(read.job.cell.machine, item.job.cell.machine) << "with the tools of the setup alone";
    EXPECT_EQ(read.job.cell.stock, item.job.cell.stock);
    EXPECT_EQ(read.cell_file, item.cell_file);
    EXPECT_EQ(read.fine, FineTools::all);
    EXPECT_EQ(read.result, "0123.programs");
    EXPECT_EQ(read.effort, item.effort);
    EXPECT_EQ(to_manifest(read.job, {}), to_manifest(item.job, {}));
    const MachineReachability& arm = read.piece_setup.machine_reachability;
    EXPECT_FALSE(arm.regions.empty());
    EXPECT_FALSE(arm.margins.empty());
    EXPECT_EQ(arm, item.piece_setup.machine_reachability);
    EXPECT_EQ(arm.placement, item.job.setup.placement);
    EXPECT_GT(read.piece_setup.choice.setups.size(), 1U);
    EXPECT_EQ(read.piece_setup.choice.setups, item.piece_setup.choice.setups);
    EXPECT_EQ(read.piece_setup.choice.states, item.piece_setup.choice.states);
    EXPECT_EQ(read.piece_setup.choice.states.size(), read.job.piece.mesh->triangles.size());
    EXPECT_EQ(read.piece_setup.stock_fit, item.piece_setup.stock_fit);
    EXPECT_TRUE(read.piece_setup.fits());
    EXPECT_EQ(to_bytes(read), to_bytes(item));
}

TEST_P(Item, WithOneByteChangedOrCutShortIsRefused) {
    write_file(file, to_bytes(made()));
    const Bytes whole = read_file(file);
    for (std::size_t at = 0; at < whole.size(); at += 1 + whole.size() / 50) {
        Bytes changed = whole;
        changed[at] ^= 0x10;
        write_file(file, changed);
        EXPECT_NE(refusal(), "") << at;
        write_file(file, Bytes(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(at)));
        EXPECT_NE(refusal(), "") << at;
    }
}

TEST_P(Item, OfAnotherBuildIsRefusedWithBothNames) {
    write_file(file, to_bytes(made()));
    try {
        item_from(read_file(file), file, "0.1.0+def");
        FAIL();
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("by build 0.1.0+abc, and this is 0.1.0+def"), std::string::npos)
            << error.what();
    }
}

INSTANTIATE_TEST_SUITE_P(Cells, Item, ::testing::Values("kr60-ha", "kr120-r2500-pro-rotary"), [](const auto& cell) {
    return std::string(cell.param).substr(0, 4) == "kr60" ? "Fixed" : "Rotary";
});

}  // namespace
}  // namespace qchopper
