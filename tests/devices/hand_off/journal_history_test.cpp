// What rows mean for the next dispatcher.

#include "devices/hand_off/journal_history.h"

#include <gtest/gtest.h>

#include "devices/wire/codec.h"

namespace qchopper {
namespace {

using Is = JournalKind;

constexpr Uuid a{1};
constexpr Uuid b{2};

struct Rows {
    std::vector<JournalRow> rows;
    JournalEvent& add(JournalKind kind, const Uuid& job = a) {
        JournalRow row;
        row.number = static_cast<std::int64_t>(rows.size()) + 1;
        row.event.kind = kind;
        row.event.job_id = job;
        rows.push_back(row);
        return rows.back().event;
    }
    void command(CellCommand command, std::uint32_t seq, const Uuid& job = a) {
        JournalEvent& event = add(Is::command, job);
        event.command = command;
        event.owner = 5;
        event.seq = seq;
    }
    void claim(std::uint32_t epoch, std::uint32_t seq) {
        JournalEvent& event = add(Is::claim, {});
        event.epoch = epoch;
        event.owner = 5;
        event.secret = 6;
        event.seq = seq;
    }
    JournalHistory history() const { return history_of(rows); }
    const JournalJob& first() {
        kept = history();
        return kept.jobs.at(0);
    }
    JournalHistory kept;
};

TEST(JournalHistory, AJobIsOpenUntilItsEndIsCertain) {
    Rows rows;
    rows.add(Is::created);
    EXPECT_TRUE(rows.first().is_open());
    rows.command(CellCommand::store, 3);
    EXPECT_TRUE(rows.first().is_stored);
    rows.add(Is::start_intent);
    EXPECT_TRUE(rows.first().start_sent);
    rows.add(Is::closed).start_outcome = StartOutcome::unknown;
    EXPECT_TRUE(rows.first().is_open());
    rows.add(Is::resumed);
    rows.add(Is::started);
    EXPECT_TRUE(rows.first().is_started);
    rows.add(Is::closed).start_outcome = StartOutcome::started;
    EXPECT_TRUE(rows.first().is_open());  // it runs on
    JournalEvent& end = rows.add(Is::result);
    end.job_state = JobState::ended;
    end.job_result = JobResult::complete;
    EXPECT_FALSE(rows.first().is_open());
    EXPECT_TRUE(rows.first().is_complete());
}

TEST(JournalHistory, AJobThatWasNotStartedIsClosed) {
    Rows rows;
    rows.add(Is::created);
    rows.add(Is::start_intent);
    rows.add(Is::start_void);
    EXPECT_FALSE(rows.first().start_sent);
    rows.add(Is::closed).start_outcome = StartOutcome::not_started;
    EXPECT_FALSE(rows.first().is_open());
}

TEST(JournalHistory, TheOwnerGoesOnWhileItsLeaseMayLive) {
    Rows rows;
    rows.add(Is::created);
    rows.claim(7, 1);
    rows.command(CellCommand::query, 2);
    EXPECT_TRUE(rows.history().lease_may_live);
    EXPECT_EQ(rows.history().seq, 2U);
    EXPECT_EQ(rows.history().epoch, 7U);
    EXPECT_EQ(rows.history().owner, 5U);
    EXPECT_EQ(rows.history().secret, 6U);
    rows.command(CellCommand::release, 3);
    EXPECT_TRUE(rows.history().lease_may_live);  // RELEASE may not have arrived
    rows.add(Is::closed).start_outcome = StartOutcome::not_started;
    EXPECT_FALSE(rows.history().lease_may_live);
    EXPECT_EQ(past_of(rows.history(), nullptr).owner, 0U);
    EXPECT_EQ(past_of(rows.history(), nullptr, 7).owner, 0U) << "somebody else holds the cell";
    EXPECT_EQ(past_of(rows.history(), nullptr, 5).owner, 5U) << "RELEASE has not arrived";
    EXPECT_EQ(past_of(rows.history(), nullptr, 5).seq, 3U);
}

TEST(JournalHistory, AnAcceptedStoreSettlesWhatWasOpen) {
    Rows rows;
    rows.add(Is::identity, {}).store = {{1}, 0x0101, 3, 9, 4};
    rows.add(Is::created);
    rows.claim(9, 1);
    rows.add(Is::start_intent);
    rows.add(Is::created, b);
    rows.add(Is::store_lost, {}).store = {{2}, 0x0101, 1, 0, 0};
    EXPECT_TRUE(rows.history().store_is_lost);
    EXPECT_EQ(rows.history().store->boot_count, 3U);  // the one that was trusted
    rows.add(Is::store_accepted, {}).store = {{2}, 0x0101, 1, 0, 0};
    const JournalHistory history = rows.history();
    EXPECT_FALSE(history.store_is_lost);
    EXPECT_EQ(history.store->store_id, (Uuid{2}));
    EXPECT_EQ(history.epoch, 0U);
    for (const JournalJob& job : history.jobs) EXPECT_FALSE(job.is_open());
}

TEST(JournalHistory, TheLastStartOfAFileIsFound) {
    Sha256 file;
    file.bytes.fill(1);
    Rows rows;
    rows.add(Is::created, a).file_sha256 = file;
    EXPECT_EQ(rows.history().last_start_of(file), nullptr);
    rows.add(Is::start_intent, a);
    EXPECT_NE(rows.history().last_start_of(file), nullptr) << "START may have arrived";
    rows.add(Is::started, a);
    rows.add(Is::created, b).file_sha256 = file;
    const JournalHistory history = rows.history();
    ASSERT_NE(history.last_start_of(file), nullptr);
    EXPECT_EQ(history.last_start_of(file)->job_id, a);
    EXPECT_FALSE(history.last_start_of(file)->is_forgotten);
    EXPECT_EQ(history.last_start_of({}), nullptr);
    rows.add(Is::store_accepted, {}).store = {{2}, 0x0101, 1, 0, 0};
    EXPECT_TRUE(rows.history().last_start_of(file)->is_forgotten);
}

// Whatever the journal knows of them: it may have lost its last rows, and the cell cannot be asked any more.
TEST(JournalHistory, JobsThatWereOpenWhenAStoreWasAcceptedMayHaveStartedForGood) {
    for (const int kinds : {0, 1, 2}) {
        Rows rows;
        rows.add(Is::created).file_sha256.bytes.fill(1);
        if (kinds > 0) rows.add(Is::start_intent);
        if (kinds > 1) rows.add(Is::closed).start_outcome = StartOutcome::unknown;
        rows.add(Is::created, b).file_sha256.bytes.fill(2);
        rows.add(Is::closed, b).start_outcome = StartOutcome::not_started;
        rows.add(Is::store_accepted, {}).store = {{2}, 0x0101, 1, 0, 0};
        const JournalHistory history = rows.history();
        EXPECT_TRUE(history.jobs[0].may_have_started()) << kinds;
        EXPECT_EQ(history.last_start_of(history.jobs[0].file_sha256), &history.jobs[0]) << kinds;
        EXPECT_EQ(history.last_start_of(history.jobs[1].file_sha256), nullptr) << "it has not started";
    }
}

TEST(JournalHistory, AStartThatWasRefusedHasNotStarted) {
    Rows rows;
    rows.add(Is::created);
    EXPECT_FALSE(rows.first().may_have_started());
    rows.add(Is::start_intent);
    EXPECT_TRUE(rows.first().may_have_started());
    rows.add(Is::closed).start_outcome = StartOutcome::unknown;
    EXPECT_TRUE(rows.first().may_have_started());
    rows.add(Is::closed).start_outcome = StartOutcome::not_started;
    EXPECT_FALSE(rows.first().may_have_started());
}

TEST(Fault, F24_AMemoryOlderThanTheLeaseOfTheLastStartIsALostOne) {
    Rows rows;
    rows.add(Is::identity, {}).store = {{1}, 0x0101, 1, 0, 0};
    rows.claim(9, 1);
    EXPECT_EQ(rows.history().store->epoch_held, 0U) << "CLAIM may not have arrived";
    rows.add(Is::start_intent).epoch = 9;
    EXPECT_EQ(rows.history().store->epoch_held, 9U);
}

TEST(Fault, F24_TheNumberOfTheLastClaimIsKeptUntilAnotherMemoryIsAccepted) {
    Rows rows;
    rows.add(Is::created);
    rows.add(Is::identity, {}).store = {{1}, 0x0101, 3, 0, 0};
    rows.claim(9, 1);
    EXPECT_EQ(rows.history().grant, 0U);
    rows.add(Is::granted).grant = 4711;
    rows.claim(10, 2);
    rows.add(Is::start_intent).epoch = 9;
    rows.add(Is::identity, {}).store = {{1}, 0x0101, 4, 9, 0};
    const JournalHistory history = rows.history();
    EXPECT_EQ(history.grant, 4711U);
    EXPECT_EQ(history.jobs.front().start_boots, 3U) << "not that of after the restart";
    EXPECT_EQ(past_of(history, &history.jobs.front()).grant, 4711U);
    EXPECT_EQ(past_of(history, nullptr).grant, 4711U);
    rows.add(Is::store_accepted, {}).store = {{2}, 0x0101, 1, 0, 0};
    EXPECT_EQ(rows.history().grant, 0U);
}

TEST(JournalHistory, AJobHasTheTimesOfItsRows) {
    Rows rows;
    const auto at = [&](Is kind, std::uint64_t ms) -> JournalEvent& {
        rows.add(kind);
        rows.rows.back().unix_ms = ms;
        return rows.rows.back().event;
    };
    at(Is::created, 1000);
    EXPECT_EQ(rows.history().jobs[0].created_ms, 1000U);
    EXPECT_EQ(rows.history().jobs[0].started_ms, 0U);
    at(Is::started, 2000);
    at(Is::progress, 2500);
    at(Is::result, 3000).job_state = JobState::running;
    EXPECT_EQ(rows.history().jobs[0].started_ms, 2000U);
    EXPECT_EQ(rows.history().jobs[0].ended_ms, 0U) << "it runs";
    at(Is::result, 4000).job_state = JobState::ended;
    EXPECT_EQ(rows.history().jobs[0].ended_ms, 4000U);
}

TEST(JournalHistory, APartWaitsForTheCompleteEndOfThePartBefore) {
    WireTicket ticket;
    ticket.project_id = {3};
    ticket.piece_no = 2;
    ticket.part = 1;
    ticket.parts = 3;
    Rows rows;
    rows.add(Is::created).ticket = encode(ticket);
    EXPECT_EQ(why_part_must_wait(rows.history(), ticket), "");
    ticket.part = 2;
    EXPECT_NE(why_part_must_wait(rows.history(), ticket), "");
    JournalEvent& stopped = rows.add(Is::result);
    stopped.job_state = JobState::ended;
    stopped.job_result = JobResult::stopped;
    EXPECT_NE(why_part_must_wait(rows.history(), ticket), "");
    rows.rows.back().event.job_result = JobResult::complete;
    EXPECT_EQ(why_part_must_wait(rows.history(), ticket), "");
    ticket.part = 3;
    EXPECT_NE(why_part_must_wait(rows.history(), ticket), "") << "part 1 is not part 2";
    ticket.part = 2;
    ticket.piece_no = 3;
    EXPECT_NE(why_part_must_wait(rows.history(), ticket), "") << "of another piece";
}

TEST(JournalHistory, TheLastStartOfAPieceIsFoundWithRestartsAndWithout) {
    WireTicket ticket;
    ticket.project_id = {3};
    ticket.piece_no = 2;
    ticket.file_name = "B.qjob";
    Rows rows;
    rows.add(Is::created).ticket = encode(ticket);
    EXPECT_EQ(rows.history().last_start_at(ticket), nullptr) << "it was not started";
    rows.add(Is::started);
    WireTicket restart = ticket;
    restart.file_name = "B.r12.qjob";
    rows.add(Is::created, b).ticket = encode(restart);
    rows.add(Is::started, b);
    const JournalHistory history = rows.history();
    EXPECT_EQ(history.last_start_at(ticket), &history.jobs.at(1));
    EXPECT_EQ(history.last_start_at(ticket, false), &history.jobs.at(0));
    for (std::uint16_t WireTicket::*field : {&WireTicket::piece_no, &WireTicket::part, &WireTicket::parts}) {
        WireTicket other = ticket;
        ++(other.*field);
        EXPECT_EQ(history.last_start_at(other), nullptr);
    }
    WireTicket other = ticket;
    other.project_id = {4};
    EXPECT_EQ(history.last_start_at(other), nullptr) << "of another order";
}

TEST(JournalHistory, ARestartIsKnownByItsName) {
    WireTicket ticket;
    for (const char* name : {"B.r2.qjob", "B.p3.r120.qjob"}) {
        ticket.file_name = name;
        EXPECT_TRUE(ticket.is_restart()) << name;
    }
    for (const char* name : {"B.qjob", "B.p3.qjob", "B.r.qjob", "B.r2", "B.r2x.qjob", "B.r2.qjobs", "r2.qjob", ""}) {
        ticket.file_name = name;
        EXPECT_FALSE(ticket.is_restart()) << name;
    }
}

}  // namespace
}  // namespace qchopper
