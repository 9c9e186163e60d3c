#include "sim/cell/store.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "base/files/file.h"
#include "tests/sim/cell/cell_rig.h"

namespace qchopper {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kib = 1024;

Uuid id_of(std::uint8_t n) {
    return Uuid{n};
}

// Copies of 100 KiB of jobs 1, 2 and 3; 2 ended first, then 1; 3 was cancelled and so never ran.
CellMemory fill(const Store& store) {
    CellMemory memory;
    for (std::uint8_t n = 1; n <= 3; ++n) write_file(store.job(id_of(n)), Bytes(100 * kib, n));
    memory.jobs[id_of(1)] = {JobState::ended, JobResult::complete, 1, 1, 1, 10, 2000};
    memory.jobs[id_of(2)] = {JobState::aborted, JobResult::stopped, 1, 1, 1, 10, 1000};
    memory.jobs[id_of(3)].state = JobState::cancelled;
    return memory;
}

std::string kept(const Store& store) {
    std::string names;
    for (std::uint8_t n = 1; n <= 3; ++n) names += fs::exists(store.job(id_of(n))) ? std::to_string(n) : "";
    return names;
}

TEST(Copies, OfFinishedJobsAreRemovedTheOldestFirst) {
    const rig::Folder folder;
    const Store store(folder.path / "store", 400 * kib);
    const CellMemory memory = fill(store);
    EXPECT_EQ(store.free_kib(), 100U);
    store.remove_old_copies(memory, 100 * kib);
    EXPECT_EQ(kept(store), "123") << "there was enough space";
    store.remove_old_copies(memory, 101 * kib);
    EXPECT_EQ(kept(store), "12") << "what never ran goes first";
    store.remove_old_copies(memory, 300 * kib);
    EXPECT_EQ(kept(store), "1") << "2 ended before 1";
    store.remove_old_copies(memory, 500 * kib);
    EXPECT_EQ(kept(store), "");
    EXPECT_EQ(store.free_kib(), 400U) << "more than the store has is not there";
}

TEST(Copies, WhatAKilledCellWasWritingIsRemoved) {
    const rig::Folder folder;
    const fs::path place = folder.path / "store";
    fs::create_directories(place / "jobs");
    for (const char* name : {"memory.json.tmp.4711", "jobs/x.qjob.tmp.4711", "jobs/x.qjob"}) {
        write_file(place / name, std::string_view("half"));
    }
    const Store store(place, 400 * kib);
    EXPECT_FALSE(fs::exists(place / "memory.json.tmp.4711"));
    EXPECT_FALSE(fs::exists(place / "jobs/x.qjob.tmp.4711"));
    EXPECT_TRUE(fs::exists(place / "jobs/x.qjob"));
}

TEST(Copies, ASmallStoreRunsJobAfterJobAndRefusesOneThatNeverFits) {
    const rig::Folder folder;
    fs::create_directory(folder.path / "drop");
    CellSimOptions options = rig::quick_cell(folder.path / "drop");
    options.store_folder = folder.path / "store";
    options.max_store_bytes = 30 * kib;
    CellSim cell(options);
    cell.start();
    const auto run = [&](std::size_t bytes) {
        const rig::Job job = rig::make_job(bytes, 1);
        const auto bus = rig::connect(cell);
        return dispatch_job(*bus, job.ticket, job.file, rig::quick_dispatch(folder.path / "drop"), {});
    };
    for (int i = 0; i < 4; ++i) EXPECT_TRUE(run(20 * kib).is_complete()) << i;
    const JobOutcome outcome = run(40 * kib);
    EXPECT_EQ(outcome.start_outcome, StartOutcome::not_started);
    EXPECT_EQ(outcome.refusal, AckResult::store_full);
    EXPECT_EQ(cell.status().starts_total, 4U) << "the ids stay though the copies go";
}

}  // namespace
}  // namespace qchopper
