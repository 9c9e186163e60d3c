// A job of an earlier dispatcher taken up; another dispatcher that takes the cell over; requests of other programs.

#include "devices/hand_off.h"

#include "tests/devices/scripted_cell.h"

namespace qchopper {
namespace {

using namespace scripted;

HandOffPlan adopting(bool may_have_arrived) {
    HandOffPlan plan = a_plan();
    plan.adopts = true;
    plan.options.past.epoch = 5;
    plan.options.past.seq = 50;
    plan.options.past.is_stored = true;
    plan.options.past.start_may_have_arrived = may_have_arrived;
    return plan;
}

void hold(ScriptedCell& cell, JobState state) {
    cell.status.job_id = job;
    cell.status.job_state = state;
    cell.status.state = state == JobState::running ? PackState::execute : PackState::idle;
    cell.status.epoch_held = 5;
}

TEST(HandOffAdopt, AJobThatWasNotStartedIsCancelled) {
    for (const JobState state : {JobState::stored, JobState::prepared}) {
        ScriptedCell cell(adopting(true));
        hold(cell, state);
        cell.run();
        EXPECT_EQ(cell.order(), "CLAIM QUERY CANCEL RELEASE ");
        EXPECT_EQ(cell.commands[0].epoch, 6U);
        EXPECT_EQ(cell.commands[0].seq, 51U);
        EXPECT_EQ(cell.state.verdict, StartVerdict::not_started);
        EXPECT_TRUE(std::any_of(cell.events.begin(), cell.events.end(),
                                [](const JournalEvent& event) { return event.kind == JournalKind::start_void; }));
    }
}

TEST(HandOffAdopt, ARunningJobIsFollowedToItsEnd) {
    ScriptedCell cell(adopting(true));
    hold(cell, JobState::running);
    end_the_job(cell);
    EXPECT_EQ(cell.state.verdict, StartVerdict::started);
    EXPECT_EQ(cell.count(CellCommand::start), 0);
    ASSERT_TRUE(cell.state.result.has_value());
    EXPECT_EQ(cell.state.result->result, JobResult::complete);
}

TEST(HandOffAdopt, WithoutAnAnswerItStaysUnknown) {
    for (const bool may_have_arrived : {true, false}) {
        ScriptedCell cell(adopting(may_have_arrived));
        cell.lose = [](const HandOffAction& action) { return action.kind != Kind::wait; };
        cell.run();
        EXPECT_EQ(cell.state.verdict, may_have_arrived ? StartVerdict::unknown : StartVerdict::not_started);
        EXPECT_EQ(cell.events.back().verdict, cell.state.verdict);
    }
}

TEST(Fault, F34_ATakeoverWhileStartIsUnderWayIsAnsweredByQuery) {
    for (const bool has_arrived : {true, false}) {
        ScriptedCell cell;
        bool is_taken = false;
        lose_first_start(cell, [&](const Command& start) {
            if (has_arrived) cell.execute(start);
            if (!has_arrived) cell.status.job_state = JobState::stored;
            cell.status.owner_held = 0xABCD;
            is_taken = true;
        });
        cell.grant = [&](const Command& c) {
            return is_taken && c.command == CellCommand::claim ? AckResult::lease_busy : AckResult::ok;
        };
        while (!(is_taken && cell.state.step == HandOffStep::run) && cell.step()) {
        }
        if (has_arrived) {
            EXPECT_EQ(cell.state.step, HandOffStep::run);
            EXPECT_TRUE(cell.state.is_started);
            cell.status.job_state = JobState::ended;
            cell.result.result = JobResult::complete;
        }
        cell.run();
        EXPECT_EQ(cell.state.verdict, has_arrived ? StartVerdict::started : StartVerdict::not_started);
        EXPECT_EQ(cell.count(CellCommand::start), has_arrived ? 1 : 0);
        EXPECT_EQ(cell.count(CellCommand::clear_result), 0);  // no lease
    }
}

TEST(Fault, F33_ABusyLeaseNamesItsOwner) {
    ScriptedCell cell;
    cell.status.owner_held = 0xABCD;
    cell.grant = [](const Command&) { return AckResult::lease_busy; };
    cell.run();
    EXPECT_EQ(cell.state.fault, DeviceFault::busy);
    EXPECT_NE(cell.state.why.find("0x0000ABCD"), std::string::npos) << cell.state.why;
    EXPECT_NE(cell.state.why.find("LEASE_BUSY"), std::string::npos) << cell.state.why;
}

TEST(HandOffRequest, UnholdIsPassedOnWhileTheJobRuns) {
    for (const AckResult answer : {AckResult::ok, AckResult::no_consent, AckResult::none}) {
        ScriptedCell cell;
        cell.run_to(HandOffStep::run);
        cell.step();
        cell.grant = [&](const Command& c) { return c.command == CellCommand::unhold ? answer : AckResult::ok; };
        cell.request = CellCommand::unhold;
        while (cell.request_answer.empty() && cell.step()) {
        }
        EXPECT_NE(cell.request_answer.find(answer == AckResult::ok           ? "OK"
                                           : answer == AckResult::no_consent ? "NO_CONSENT"
                                                                             : "ask the cell"),
                  std::string::npos)
            << cell.request_answer;
        EXPECT_GE(cell.count(CellCommand::unhold), 1);
        EXPECT_EQ(cell.state.step, HandOffStep::run);  // the job is followed as before
        cell.grant = nullptr;
        end_the_job(cell);
        EXPECT_EQ(cell.state.verdict, StartVerdict::started);
    }
}

TEST(HandOffRequest, AtOtherStepsAndUnderLocalControlItIsRefused) {
    ScriptedCell early;
    early.run_to(HandOffStep::prepare);
    early.request = CellCommand::unhold;
    while (early.request_answer.empty() && early.step()) {
    }
    EXPECT_NE(early.request_answer.find("refused"), std::string::npos);
    EXPECT_EQ(early.count(CellCommand::unhold), 0);

    ScriptedCell local;
    local.run_to(HandOffStep::run);
    local.status.flags |= flag::local_control;
    for (int n = 0; n < 5; ++n) local.step();
    local.request = CellCommand::unhold;
    while (local.request_answer.empty() && local.step()) {
    }
    EXPECT_NE(local.request_answer.find("LOCAL_CONTROL"), std::string::npos) << local.request_answer;
    EXPECT_EQ(local.count(CellCommand::unhold), 0);
}

}  // namespace
}  // namespace qchopper
