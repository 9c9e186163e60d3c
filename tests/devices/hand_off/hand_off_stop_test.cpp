// A stop on request, at every step, of a cell in every condition.

#include "devices/hand_off/hand_off.h"

#include "tests/devices/hand_off/scripted_cell.h"

namespace qchopper {
namespace {

using namespace scripted;

TEST(Fault, F58_AStopOnRequestAtAnyMomentBeforeStartIsConfirmedAndNothingIsStarted) {
    for (int at = 0; at < 200; ++at) {
        ScriptedCell cell;
        for (int n = 0; n < at && cell.state.step < HandOffStep::start; ++n) cell.step();
        if (cell.state.step >= HandOffStep::start) {
            EXPECT_GT(at, 10);
            return;
        }
        cell.cancelled = true;
        cell.input.cancelled = true;
        const bool was_stored = cell.count(CellCommand::store) > 0 || cell.action.kind == Kind::write_command;
        cell.run();
        EXPECT_EQ(cell.count(CellCommand::start), 0) << at;
        EXPECT_EQ(cell.state.start_outcome, StartOutcome::not_started) << at;
        EXPECT_TRUE(cell.state.cancelled);
        if (cell.count(CellCommand::store) > 0) {
            EXPECT_TRUE(was_stored);
            EXPECT_EQ(cell.count(CellCommand::cancel), 1) << at << cell.order();
        }
        if (cell.count(CellCommand::claim) > 0) {
            EXPECT_EQ(cell.commands.back().command, CellCommand::release) << at << cell.order();
        }
    }
    FAIL() << "never came to START";
}

// Brings a hand-off to its n-th turn; false if it ended before.
bool bring_to(ScriptedCell& cell, int turns) {
    for (int n = 0; n < turns; ++n) {
        if (cell.now_s > 110) cell.status.job_state = JobState::ended;
        if (!cell.step()) return false;
    }
    return true;
}

void stop_on_request(ScriptedCell& cell) {
    cell.cancelled = true;
    cell.input.cancelled = true;
    cell.written.clear();
}

TEST(HandOff, AFrozenCellIsLeftInTwoSecondsWhateverTheStep) {
    int started = 0;
    int not_started = 0;
    for (int turns = 1;; ++turns) {
        ScriptedCell cell;
        if (!bring_to(cell, turns)) break;
        cell.freeze_s = cell.now_s;
        const double frozen_at_s = cell.now_s;
        bool ended = false;
        while (cell.now_s < frozen_at_s + 4 && !ended) ended = !cell.step();
        ASSERT_FALSE(ended) << turns << cell.state.why;
        const HandOff before = cell.state;
        stop_on_request(cell);
        const double asked_s = cell.now_s;
        cell.run();
        EXPECT_LE(cell.now_s - asked_s, 2.05) << turns << " " << name(before.step);
        EXPECT_EQ(cell.state.start_outcome, before.is_started   ? StartOutcome::started
                                            : before.start_sent ? StartOutcome::unknown
                                                                : StartOutcome::not_started)
            << turns << cell.state.why;
        EXPECT_TRUE(cell.state.cancelled);
        EXPECT_FALSE(cell.state.why.empty());
        const auto was_written = [&](CellCommand command) {
            return std::count(cell.written.begin(), cell.written.end(), command) > 0;
        };
        EXPECT_EQ(was_written(CellCommand::cancel), before.is_stored && !before.start_sent && !before.is_started);
        if (before.claim_sent && !(before.start_sent && !before.is_started)) {
            EXPECT_TRUE(was_written(CellCommand::release)) << turns << " " << name(before.step);
        }
        started += cell.state.start_outcome == StartOutcome::started ? 1 : 0;
        not_started += cell.state.start_outcome == StartOutcome::not_started ? 1 : 0;
        if (before.step >= HandOffStep::release) break;
    }
    EXPECT_GT(started, 3);
    EXPECT_GT(not_started, 10);
}

TEST(HandOff, ALostLinkIsLeftInTwoSecondsWhateverTheStep) {
    for (int turns = 1;; ++turns) {
        ScriptedCell cell;
        if (!bring_to(cell, turns)) break;
        cell.lose = [](const HandOffAction& action) { return action.kind != Kind::wait; };
        const double lost_at_s = cell.now_s;
        bool ended = false;
        while (cell.now_s < lost_at_s + 1.5 && !ended) ended = !cell.step();
        if (ended) continue;
        const HandOff before = cell.state;
        stop_on_request(cell);
        const double asked_s = cell.now_s;
        cell.run();
        EXPECT_LE(cell.now_s - asked_s, 2.05) << turns << " " << name(before.step);
        EXPECT_EQ(cell.state.start_outcome, before.is_started   ? StartOutcome::started
                                            : before.start_sent ? StartOutcome::unknown
                                                                : StartOutcome::not_started);
        if (before.step >= HandOffStep::release) break;
    }
}

// Of a call that took 1.5 s more: the two seconds count from the request, not from its end.
TEST(Fault, F58_ARequestToStopDuringACallEndsTwoSecondsAfterTheRequest) {
    for (int turns = 1; turns < 200; ++turns) {
        ScriptedCell cell;
        if (!bring_to(cell, turns)) break;
        const double asked_s = cell.now_s;
        cell.now_s += 1.5;
        cell.input = HandOffInput{};
        cell.input.end = BusEnd::lost;
        cell.input.cancelled_for_s = 1.5;
        stop_on_request(cell);
        cell.lose = [](const HandOffAction&) { return true; };
        cell.run();
        EXPECT_LE(cell.now_s - asked_s, 2 + cell.call_s) << turns;
    }
}

TEST(HandOff, AskedToStopWhenTheLinkComesBackTheCellConfirmsAllTheSame) {
    ScriptedCell cell;
    cell.run_to(HandOffStep::prepare);
    double back_at_s = 1e9;
    cell.lose = [&](const HandOffAction& action) { return action.kind != Kind::wait && cell.now_s < back_at_s; };
    while (cell.state.lost_since_s < 0 && cell.step()) {
    }
    stop_on_request(cell);
    back_at_s = cell.now_s + 0.7;
    cell.run();
    EXPECT_EQ(cell.state.start_outcome, StartOutcome::not_started);
    EXPECT_EQ(cell.count(CellCommand::cancel), 1) << cell.order();
    EXPECT_EQ(cell.commands.back().command, CellCommand::release);
    EXPECT_EQ(cell.state.why.find("did not confirm"), std::string::npos) << cell.state.why;
}

TEST(HandOff, AskedToStopBetweenStartAndItsAcknowledgementTheAnswerOfTheCellIsReported) {
    for (const AckResult answer : {AckResult::ok, AckResult::safety_open, AckResult::none}) {
        ScriptedCell cell;
        int asked = 0;
        cell.grant = [&](const Command& c) {
            return c.command == CellCommand::start && ++asked < 2 ? AckResult::none
                   : c.command == CellCommand::start              ? answer
                                                                  : AckResult::ok;
        };
        while (asked < 1 && cell.step()) {
        }
        stop_on_request(cell);
        const double asked_s = cell.now_s;
        cell.run();
        EXPECT_LE(cell.now_s - asked_s, 2.05);
        EXPECT_EQ(cell.state.cancelled, answer != AckResult::safety_open);  // that end is the cell's own
        EXPECT_EQ(cell.state.start_outcome, answer == AckResult::ok     ? StartOutcome::started
                                            : answer == AckResult::none ? StartOutcome::unknown
                                                                        : StartOutcome::not_started)
            << cell.state.why;
        EXPECT_EQ(cell.count(CellCommand::cancel), answer == AckResult::safety_open ? 1 : 0);
    }
}

TEST(HandOff, AStartRefusedByACellThatRestartedMeanwhileMayHaveBeenExecutedBefore) {
    ScriptedCell cell;
    int asked = 0;
    cell.grant = [&](const Command& c) {
        if (c.command != CellCommand::start) return AckResult::ok;
        if (++asked == 1) return AckResult::none;  // it starts, loses power, and forgets its acknowledgement
        ++cell.status.boot_count;
        return AckResult::not_owner;
    };
    while (asked < 1 && cell.step()) {
    }
    stop_on_request(cell);
    cell.run();
    EXPECT_EQ(asked, 2);
    EXPECT_EQ(cell.state.start_outcome, StartOutcome::unknown) << cell.state.why;
}

}  // namespace
}  // namespace qchopper
