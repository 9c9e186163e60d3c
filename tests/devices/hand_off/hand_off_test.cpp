// The hand-off against a cell of values: the order of its commands, acknowledgements, journal, heartbeats.

#include "devices/hand_off/hand_off.h"

#include "tests/devices/hand_off/scripted_cell.h"

namespace qchopper {
namespace {

using namespace scripted;

TEST(HandOff, TheCommandsComeInTheOrderOfTheProtocol) {
    ScriptedCell cell;
    end_the_job(cell);
    EXPECT_EQ(cell.order(),
              "CLAIM QUERY QUERY_FILE Reset STORE VERIFY PREPARE Start QUERY CLEAR_RESULT Reset RELEASE ");
    EXPECT_EQ(cell.state.start_outcome, StartOutcome::started);
    ASSERT_TRUE(cell.state.result.has_value());
    EXPECT_EQ(cell.state.result->starts, 1U);
    for (const Command& command : cell.commands) EXPECT_EQ(command.owner, 77U);
    for (std::size_t i = 1; i < cell.commands.size(); ++i) EXPECT_GT(cell.commands[i].seq, cell.commands[i - 1].seq);
}

TEST(HandOff, BeforeEveryCommandThereIsAnEventForTheJournal) {
    ScriptedCell cell;
    int commands = 0;
    while (cell.state.step != HandOffStep::run && cell.step()) {
        if (cell.action.kind != Kind::write_command) continue;
        ++commands;
        const JournalEvent& event = cell.events.back();
        const CellCommand command = cell.action.command.command;
        EXPECT_EQ(event.kind, command == CellCommand::claim   ? JournalKind::claim
                              : command == CellCommand::start ? JournalKind::start_intent
                                                              : JournalKind::command);
        EXPECT_EQ(event.seq, cell.action.command.seq);
        EXPECT_EQ(event.epoch, cell.action.command.epoch);
        EXPECT_EQ(event.owner, 77U);
        EXPECT_EQ(event.job_id, job);
        EXPECT_EQ(event.token, cell.action.command.token);
    }
    EXPECT_EQ(commands, 8);
}

TEST(HandOff, TheJournalTellsTheWholeStory) {
    ScriptedCell cell;
    end_the_job(cell);
    std::string kinds;
    for (const JournalEvent& event : cell.events) kinds += std::string(name(event.kind)) + " ";
    EXPECT_EQ(kinds,
              "IDENTITY CLAIM COMMAND GRANTED COMMAND COMMAND COMMAND COMMAND COMMAND START_INTENT STARTED PROGRESS "
              "COMMAND RESULT COMMAND COMMAND COMMAND IDENTITY CLOSED ");
    EXPECT_EQ(cell.events.back().start_outcome, StartOutcome::started);
    EXPECT_EQ(cell.events[cell.events.size() - 2].store.starts_total, 1U);
}

TEST(HandOff, AnOwnRefusalOfStartIsNotStarted) {
    ScriptedCell cell;
    cell.grant = [](const Command& c) {
        return c.command == CellCommand::start ? AckResult::safety_open : AckResult::ok;
    };
    cell.run();
    EXPECT_EQ(cell.state.start_outcome, StartOutcome::not_started);
    EXPECT_EQ(cell.state.refusal, AckResult::safety_open);
    EXPECT_EQ(cell.order(), "CLAIM QUERY QUERY_FILE Reset STORE VERIFY PREPARE Start CANCEL RELEASE ");
}

TEST(HandOff, TheAcknowledgementOfSomebodyElseIsNotTakenForOurs) {
    ScriptedCell cell;
    bool foreign = false;
    cell.grant = [&](const Command& c) {
        if (c.command != CellCommand::store || foreign) return AckResult::ok;
        foreign = true;
        cell.status.ack_owner = 12345;
        cell.status.ack_seq = c.seq;
        cell.status.ack_result = AckResult::ok;
        return AckResult::none;
    };
    end_the_job(cell);
    EXPECT_EQ(cell.count(CellCommand::store), 2);
    EXPECT_EQ(cell.state.start_outcome, StartOutcome::started);
}

TEST(HandOff, ACommandThatIsNotAcknowledgedIsSentAgainAsTheVerySameFrame) {
    ScriptedCell cell;
    int unanswered = 2;
    cell.grant = [&](const Command& c) {
        return c.command == CellCommand::start && unanswered-- > 0 ? AckResult::none : AckResult::ok;
    };
    end_the_job(cell);
    EXPECT_EQ(cell.count(CellCommand::start), 3);
    const auto first = std::find_if(cell.commands.begin(), cell.commands.end(),
                                    [](const Command& c) { return c.command == CellCommand::start; });
    EXPECT_EQ(first[0], first[1]);
    EXPECT_EQ(first[0], first[2]);
}

TEST(HandOff, HeartbeatsGoOutEveryHalfSecondOnceTheCellIsClaimed) {
    ScriptedCell cell;
    double last = -1;
    double worst = 0;
    std::uint16_t counter = 0;
    while (cell.now_s < 200 && cell.step()) {
        if (cell.action.kind != Kind::heartbeat) continue;
        if (last > 0) worst = std::max(worst, cell.now_s - last);
        EXPECT_NE(cell.action.heartbeat.counter, counter);
        counter = cell.action.heartbeat.counter;
        EXPECT_EQ(cell.action.heartbeat.owner, 77U);
        EXPECT_EQ(cell.action.heartbeat.epoch, cell.status.epoch_held);
        last = cell.now_s;
    }
    EXPECT_EQ(cell.state.step, HandOffStep::run);
    EXPECT_GT(last, 199);
    EXPECT_LT(worst, 0.6);
}

TEST(HandOff, TheResultOfAnotherJobIsNotAskedForWithoutEnd) {
    ScriptedCell before;
    before.change_result = [](ResultRecord& result) { result.job_id = other_job; };
    before.run();
    EXPECT_EQ(before.state.start_outcome, StartOutcome::not_started);
    EXPECT_NE(before.state.why.find(to_text(other_job)), std::string::npos) << before.state.why;
    EXPECT_LE(before.count(CellCommand::query), 12);
    expect_leaves_with(before, "QUERY RELEASE ");

    ScriptedCell after;
    after.run_to(HandOffStep::run);
    after.change_result = before.change_result;
    end_the_job(after);
    EXPECT_EQ(after.state.start_outcome, StartOutcome::started);  // STATUS has shown that
    EXPECT_FALSE(after.state.result.has_value());
    EXPECT_LE(after.count(CellCommand::query), 14);
}

TEST(HandOff, AQueryOvertakenByThatOfAnotherClientIsAskedAgain) {
    ScriptedCell cell;
    int overtaken = 0;
    cell.change_result = [&](ResultRecord& result) {
        if (++overtaken % 4 != 0) result.query_owner = 4711;
    };
    end_the_job(cell);
    EXPECT_EQ(cell.state.start_outcome, StartOutcome::started);
    EXPECT_EQ(cell.count(CellCommand::query), 8);
    EXPECT_EQ(cell.count(CellCommand::start), 1);
}

TEST(HandOff, WhatStandsInTheWayIsClearedOrNamed) {
    ScriptedCell cell;
    cell.status.job_id = other_job;
    cell.status.job_state = JobState::stored;
    cell.grant = [&](const Command& c) {
        if (c.command == CellCommand::cancel) {
            EXPECT_EQ(c.job_id, other_job);
            cell.status.job_id = {};
            cell.status.job_state = JobState::none;
        }
        return AckResult::ok;
    };
    end_the_job(cell);
    EXPECT_EQ(cell.count(CellCommand::cancel), 1);
    EXPECT_EQ(cell.state.start_outcome, StartOutcome::started);

    ScriptedCell busy;
    busy.status.job_id = other_job;
    busy.status.job_state = JobState::running;
    busy.status.state = PackState::execute;
    busy.run();
    EXPECT_EQ(busy.state.fault, DeviceFault::busy);
    EXPECT_EQ(busy.order(), "CLAIM QUERY QUERY_FILE RELEASE ");
}

}  // namespace
}  // namespace qchopper
