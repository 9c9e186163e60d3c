// Stores that were lost, or replaced by an older copy, and what the cell knows of it; in time that is counted.

#include <gtest/gtest.h>

#include "sim/cell/panel.h"
#include "tests/sim/cell/cell_bench.h"

namespace qchopper {
namespace {

using bench::Bench;
using bench::job_a;

TEST(Fault, F24_AStoreThatIsLostHasAnotherId) {
    Bench bench;
    bench.to_running();
    const Identity before = identity_of(bench.cell);
    EXPECT_NE(before.store_id, Uuid{});
    bench.restart(PowerCut::Store::lost);
    const Identity after = identity_of(bench.cell);
    EXPECT_NE(after.store_id, before.store_id);
    EXPECT_EQ(after.boot_count, before.boot_count) << "which shows nothing";
    EXPECT_EQ(after.starts_total, 0U);
    EXPECT_EQ(bench.send(CellCommand::query, job_a), AckResult::unknown_job);
}

// A cell with marks outside of its store.
struct Marked : Bench {
    explicit Marked(SaveMarks begin = {}) : marks(begin) {
        hooks.read_marks = [this] { return marks; };
        hooks.write_marks = [this](const SaveMarks& what) {
            marks = what;
            return can_mark;
        };
        cell = boot({}, {}, 42, now, hooks);
        cell.store_free_kib = 1000000;
    }
    SaveMarks marks;
    bool can_mark = true;
};

TEST(Fault, F24_AnyOlderCopyOfAStoreWithMarksGetsAnotherId) {
    Marked bench;
    EXPECT_EQ(identity_of(bench.cell).checks_store, 1);
    bench.to_running();
    const Uuid id = bench.cell.memory.store_id;
    ASSERT_GE(bench.saved.size(), 3U);
    EXPECT_EQ(bench.saved.back().mark, bench.marks.last);
    for (const CellMemory& copy : bench.saved) {
        const bool is_last = copy == bench.saved.back();
        const CellState after =
            boot({}, copy, 43, bench.now,
                 CellHooks{{}, {}, {}, bench.hooks.read_marks, [](const SaveMarks&) { return true; }, {}});
        EXPECT_EQ(after.memory.store_id == id, is_last) << copy.epoch_held << " " << copy.starts_total;
    }
}

TEST(Fault, F24_APowerCutBetweenStoreAndMarksIsNoOlderCopy) {
    Marked bench;
    bench.claim();
    const Uuid id = bench.cell.memory.store_id;
    const CellMemory before = bench.cell.memory;
    arm(bench.cell, {Fault::power_cut, 2}, bench.now);  // after the write, before the marks
    bench.claim();
    ASSERT_TRUE(bench.cell.power.lost);
    EXPECT_NE(bench.marks.last, bench.marks.next);
    for (const CellMemory& stored : {before, bench.saved.back()}) {
        const CellState after = boot({}, stored, 43, bench.now, bench.hooks);
        EXPECT_EQ(after.memory.store_id, id);
        bench.marks = {before.mark, bench.saved[bench.saved.size() - 2].mark};
    }
}

TEST(Fault, F24_AStoreWhoseMarksAreGoneGetsAnotherIdAndAllOfItBackDoesNot) {
    Marked bench;
    bench.to_running();
    const Uuid id = bench.cell.memory.store_id;
    const CellMemory stored = bench.cell.memory;
    bench.marks = {};
    EXPECT_NE(boot({}, stored, 43, bench.now, bench.hooks).memory.store_id, id);
    const CellMemory old = memory_after(PowerCut::Store::all_back, stored);
    bench.marks = {old.mark, old.mark};
    EXPECT_EQ(boot({}, old, 43, bench.now, bench.hooks).memory.store_id, id);
}

TEST(Fault, F24_ACellThatCannotWriteItsMarksStartsNothing) {
    Marked bench;
    bench.to_prepared();
    bench.can_mark = false;
    EXPECT_EQ(bench.send(CellCommand::start, job_a, bench.cell.job.token), AckResult::store_io);
    EXPECT_EQ(bench.cell.memory.starts_total, 0U);
}

TEST(Fault, F24_QueryKnowsEachClaimByItsNumberAndAnOlderMemoryDoesNot) {
    Bench bench;
    bench.claim();
    const std::uint32_t epoch = bench.cell.memory.epoch_held;
    const std::uint32_t number = bench.cell.ack.detail;
    EXPECT_NE(number, 0U);
    bench.claim();
    EXPECT_NE(bench.cell.ack.detail, number);
    bench.restart();
    bench.send(CellCommand::query, job_a, 0, number);
    EXPECT_EQ(bench.cell.answer.grant_epoch, epoch);
    bench.send(CellCommand::query, job_a, 0, number + 1);
    EXPECT_EQ(bench.cell.answer.grant_epoch, 0U);
    bench.restart(PowerCut::Store::back);
    bench.seq = 0;
    bench.claim();
    EXPECT_EQ(bench.cell.memory.epoch_held, epoch) << "the same CLAIM again";
    bench.send(CellCommand::query, job_a, 0, number);
    EXPECT_EQ(bench.cell.answer.grant_epoch, 0U);
}

TEST(Fault, F24_AnOlderStoreWithoutMarksHasTheSameIdAndLowerNumbers) {
    Bench bench;
    bench.to_running();
    bench.restart();
    const Identity before = identity_of(bench.cell);
    bench.restart(PowerCut::Store::back);
    const Identity after = identity_of(bench.cell);
    EXPECT_EQ(after.store_id, before.store_id);
    EXPECT_LT(after.boot_count, before.boot_count);
    EXPECT_LT(after.epoch_held, before.epoch_held);
    EXPECT_LT(after.starts_total, before.starts_total);
}

TEST(Fault, F24_TheIdStaysAsLongAsTheStore) {
    Bench bench;
    const Identity first = identity_of(bench.cell);
    for (std::uint32_t n = 1; n < 5; ++n) {
        bench.restart();
        const Identity now = identity_of(bench.cell);
        EXPECT_EQ(now.store_id, first.store_id);
        EXPECT_EQ(now.store_created_ms, first.store_created_ms);
        EXPECT_EQ(now.boot_count, first.boot_count + n);
    }
}

}  // namespace
}  // namespace qchopper
