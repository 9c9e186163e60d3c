// A dispatch whose journal cannot be written, from the n-th event on; and a second dispatch of the same file.

#include <gtest/gtest.h>

#include "base/error.h"
#include "devices/hand_off/cell_control.h"
#include "devices/hand_off/journal_history.h"
#include "devices/journal/journal.h"
#include "devices/wire/codec.h"
#include "tests/sim/cell/cell_rig.h"

namespace qchopper {
namespace {

struct Cell {
    Cell() {
        cell.start();
        options.again = false;
    }
    JobOutcome dispatch(const DispatchOptions& with) const {
        const auto bus = rig::connect(cell);
        const rig::Job job = rig::make_job(100, 2);
        return dispatch_job(*bus, job.ticket, job.file, with, {});
    }
    rig::Folder folder;
    CellSim cell{rig::quick_cell(folder.path)};
    DispatchOptions options = rig::quick_dispatch(folder.path);
};

TEST(Fault, F27_AJournalThatFailsBeforeStartEndsWithoutAStartAndAfterItWithAReport) {
    int refused = 0;
    int followed = 0;
    for (int failing_at = 1; failing_at < 40; ++failing_at) {
        Cell rig;
        int events = 0;
        bool intent_is_kept = false;
        rig.options.journal = [&](const JournalEvent& event) {
            if (++events >= failing_at) throw InputError(InputFault::io, "the disk is full", "Free space.");
            intent_is_kept = intent_is_kept || event.kind == JournalKind::start_intent;
        };
        try {
            const JobOutcome outcome = rig.dispatch(rig.options);
            EXPECT_EQ(outcome.start_outcome, StartOutcome::started) << failing_at << outcome.why;
            EXPECT_TRUE(intent_is_kept) << failing_at;
            EXPECT_EQ(rig.cell.status().starts_total, 1U);
            ++followed;
            if (events < failing_at) break;  // no event was refused any more
        } catch (const InputError& error) {
            EXPECT_STREQ(error.what(), "the disk is full");
            EXPECT_FALSE(intent_is_kept) << failing_at;
            EXPECT_EQ(rig.cell.status().starts_total, 0U) << failing_at;
            EXPECT_FALSE(rig.cell.status().has(flag::lease_held)) << failing_at;
            EXPECT_NE(rig.cell.status().job_state, JobState::prepared) << failing_at;
            ++refused;
        }
    }
    EXPECT_GT(refused, 8);
    EXPECT_GT(followed, 4);
}

TEST(Fault, F35_TheSameFileDispatchedTwiceStartsOnceAlsoWithoutAJournal) {
    const Cell rig;
    EXPECT_TRUE(rig.dispatch(rig.options).is_complete());
    const JobOutcome second = rig.dispatch(rig.options);  // whose journal was lost: it has none
    EXPECT_EQ(second.start_outcome, StartOutcome::not_started);
    EXPECT_TRUE(second.milled_before);
    EXPECT_TRUE(second.milled_complete);
    EXPECT_EQ(second.to_do.key, "carve_again");
    EXPECT_EQ(rig.cell.status().starts_total, 1U);
    DispatchOptions again = rig.options;
    again.again = true;
    EXPECT_TRUE(rig.dispatch(again).is_complete());
    EXPECT_EQ(rig.cell.status().starts_total, 2U);
}

TEST(Fault, F35_TwoProcessesForOneCellAreOneWriter) {
    const rig::Folder folder;
    const Journal first(folder.path, {7, false, {}});
    try {
        const Journal second(folder.path, {7, false, {}});
        FAIL() << "two writers";
    } catch (const InputError& error) {
        EXPECT_EQ(error.fault, InputFault::busy);
    }
}

// A journal that holds the first rows of another one: its last ones were lost.
JournalHistory first_rows(const std::vector<JournalEvent>& events, std::size_t count) {
    std::vector<JournalRow> rows;
    for (std::size_t i = 0; i < count; ++i) rows.push_back({static_cast<std::int64_t>(i) + 1, 0, events[i]});
    return history_of(rows);
}

// The job has run to its end and was cleared; then the journal loses its last rows.
TEST(JournalDispatch, AJournalThatLostItsLastRowsIsNoReasonToSayNotStarted) {
    Cell rig;
    std::vector<JournalEvent> events;
    rig.options.journal = [&](const JournalEvent& event) { events.push_back(event); };
    const rig::Job job = rig::make_job(100, 2);
    const JobOutcome first = rig.dispatch(rig.options);
    ASSERT_TRUE(first.is_complete());
    ASSERT_EQ(rig.cell.status().job_state, JobState::none) << "it was cleared";
    rig.options.journal = {};
    int taken_up = 0;
    for (std::size_t kept = 1; kept < events.size(); ++kept) {
        const JournalHistory history = first_rows(events, kept);
        const auto bus = rig::connect(rig.cell);
        ASSERT_EQ(history.jobs.size(), 1U);
        if (history.jobs[0].is_open()) {
            DispatchOptions options = rig.options;
            options.past = past_of(history, &history.jobs[0], rig.cell.status().owner_held);
            const JobOutcome outcome = adopt_job(*bus, decode<WireTicket>(history.jobs[0].ticket).value, options, {});
            EXPECT_EQ(outcome.start_outcome, StartOutcome::started) << kept << " rows kept: " << outcome.why;
            EXPECT_EQ(outcome.starts, 1U) << kept;
            EXPECT_LT(outcome.took_s, 5) << kept << " rows kept: no wait for an acknowledgement that cannot come";
            ++taken_up;
        }
        rig.options.past = past_of(history, nullptr, rig.cell.status().owner_held);
        const JobOutcome again = rig.dispatch(rig.options);
        EXPECT_EQ(again.start_outcome, StartOutcome::not_started) << kept << again.why;
        EXPECT_TRUE(again.milled_before) << kept << again.why;
    }
    EXPECT_GT(taken_up, 12);
    EXPECT_EQ(rig.cell.status().starts_total, 1U);
}

TEST(JournalDispatch, ACommandWithALeaseWorksThoughTheJournalLostItsLastRows) {
    Cell rig;
    std::vector<JournalEvent> events;
    rig.options.journal = [&](const JournalEvent& event) { events.push_back(event); };
    ASSERT_TRUE(rig.dispatch(rig.options).is_complete());
    for (std::size_t kept = 1; kept < events.size(); ++kept) {
        const auto bus = rig::connect(rig.cell);
        ControlOrder order;
        order.command = CellCommand::reset;
        order.past = past_of(first_rows(events, kept), nullptr);
        const ControlEnd end = control_cell(*bus, rig.cell.status(), order, {});
        EXPECT_NE(end.kind, ControlEnd::Kind::unknown) << kept << " rows kept: " << end.why;
    }
}

TEST(JournalDispatch, AJournalKeepsWhatTheCellShowedForTheNextDispatch) {
    Cell rig;
    const rig::Folder state;
    const JournalCell cell{any_cell_id, true, "test"};
    {
        Journal journal(state.path, cell);
        rig.options.journal = [&](const JournalEvent& event) { journal.append(event); };
        EXPECT_TRUE(rig.dispatch(rig.options).is_complete());
    }
    const JournalHistory history = history_of(read_journal(state.path).rows);
    const Status status = rig.cell.status();
    ASSERT_TRUE(history.store.has_value());
    EXPECT_EQ(history.store->boot_count, status.boot_count);
    EXPECT_EQ(history.store->epoch_held, status.epoch_held);
    EXPECT_EQ(history.store->starts_total, 1U);
    ASSERT_EQ(history.jobs.size(), 1U);
    EXPECT_TRUE(history.jobs[0].is_complete());
    EXPECT_FALSE(history.jobs[0].is_open());
    EXPECT_FALSE(history.lease_may_live);
}

}  // namespace
}  // namespace qchopper
