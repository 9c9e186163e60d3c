// A cell whose answers contradict each other, or that acknowledges and does nothing.

#include "devices/hand_off/hand_off.h"

#include "tests/devices/hand_off/scripted_cell.h"

namespace qchopper {
namespace {

using namespace scripted;

void expect_contradiction(const ScriptedCell& cell, const std::string& named) {
    EXPECT_EQ(cell.state.start_outcome, StartOutcome::unknown) << cell.state.why;
    EXPECT_NE(cell.state.why.find("contradicts"), std::string::npos) << cell.state.why;
    EXPECT_NE(cell.state.why.find(named), std::string::npos) << cell.state.why;
    EXPECT_FALSE(cell.state.to_do.empty());
    EXPECT_LE(cell.count(CellCommand::start), 1);
    expect_leaves_with(cell, "RELEASE ");
    EXPECT_LT(cell.now_s, 140);
}

TEST(HandOff, NumbersOfStartsThatCannotBeAreAContradiction) {
    for (const std::uint32_t starts : {0U, 2U, 0xFFFFFFFFU}) {
        ScriptedCell cell;
        cell.change_result = [&](ResultRecord& result) {
            if (cell.state.start_sent) result.starts = starts;
        };
        end_the_job(cell);
        expect_contradiction(cell, "STARTS " + std::to_string(starts));
    }
    ScriptedCell before;
    before.change_result = [](ResultRecord& result) { result.starts = 1; };  // of a job without record
    before.run();
    expect_contradiction(before, "STARTS 1");
    EXPECT_EQ(before.count(CellCommand::start), 0);
}

TEST(HandOff, AStartThatIsAcknowledgedAndNeverSeenIsUnknown) {
    for (const JobState shown : {JobState::prepared, JobState::stored, JobState::none}) {
        ScriptedCell cell;
        cell.grant = [&](const Command& c) {
            if (c.command != CellCommand::start) return AckResult::ok;
            cell.acknowledge(c);
            cell.status.job_state = shown;
            if (shown == JobState::none) cell.status.job_id = {};
            return AckResult::none;
        };
        cell.run();
        expect_contradiction(cell, "acknowledged START");
        EXPECT_NE(cell.state.why.find(name(shown)), std::string::npos) << cell.state.why;
    }
}

TEST(HandOff, AStartThatIsRefusedWhileTheJobIsShownAsRunningIsUnknown) {
    ScriptedCell cell;
    cell.grant = [&](const Command& c) {
        if (c.command == CellCommand::start) cell.status.job_state = JobState::running;
        return c.command == CellCommand::start ? AckResult::token_bad : AckResult::ok;
    };
    cell.run();
    expect_contradiction(cell, "TOKEN_BAD");
}

TEST(HandOff, StatusAndResultThatDisagreeWithoutEndAreUnknown) {
    // STATUS shows the end, RESULT a running job; STATUS shows no job, RESULT a running one.
    for (const bool shown : {true, false}) {
        ScriptedCell cell;
        cell.run_to(HandOffStep::run);
        cell.status.job_state = JobState::ended;
        if (!shown) cell.status.job_id = {};
        cell.change_result = [](ResultRecord& result) {
            result.state = JobState::running;
            result.starts = 1;
        };
        cell.run();
        expect_contradiction(cell, "running");
    }
    // STATUS showed it running, and now neither it nor RESULT does.
    ScriptedCell back;
    back.run_to(HandOffStep::run);
    back.status.job_state = JobState::prepared;
    back.run();
    expect_contradiction(back, "prepared");
}

TEST(HandOff, AnotherFileThanOursUnderOurJobIsAContradictionAfterTheStart) {
    ScriptedCell cell;
    cell.change_result = [&](ResultRecord& result) {
        if (cell.state.is_started) result.file_sha256.bytes.fill(1);
    };
    end_the_job(cell);
    expect_contradiction(cell, "another file");
}

TEST(HandOff, ACellThatAcknowledgesAndDoesNothingIsNotTriedWithoutEnd) {
    ScriptedCell lazy;  // acknowledges Reset with OK and stays in Stopped
    lazy.grant = [&](const Command& c) {
        if (c.command != CellCommand::reset) return AckResult::ok;
        lazy.acknowledge(c);
        return AckResult::none;
    };
    lazy.run();
    EXPECT_EQ(lazy.state.fault, DeviceFault::busy);
    EXPECT_LE(lazy.count(CellCommand::reset) + lazy.count(CellCommand::clear), 12);

    ScriptedCell tokenless;
    tokenless.tokens = 0xFFFFFFFF;  // the next one is 0
    tokenless.grant = [&](const Command&) {
        tokenless.tokens = 0xFFFFFFFF;
        return AckResult::ok;
    };
    tokenless.run();
    EXPECT_EQ(tokenless.state.start_outcome, StartOutcome::not_started);
    EXPECT_NE(tokenless.state.why.find("token"), std::string::npos) << tokenless.state.why;
    EXPECT_LE(tokenless.count(CellCommand::prepare), 5);
    expect_leaves_with(tokenless, " CANCEL RELEASE ");

    ScriptedCell cutting;  // answers to everything, but cuts the link at every CLAIM
    int claims = 0;
    cutting.lose = [&](const HandOffAction& action) {
        claims += writes(action, CellCommand::claim) ? 1 : 0;
        return writes(action, CellCommand::claim);
    };
    cutting.run();
    EXPECT_EQ(cutting.state.start_outcome, StartOutcome::not_started);
    EXPECT_LE(claims, 12);
}

TEST(HandOff, AnAcknowledgementOfAnotherCommandUnderOurNumberIsNotTaken) {
    ScriptedCell cell;
    cell.grant = [&](const Command& c) {
        if (c.command != CellCommand::start) return AckResult::ok;
        cell.acknowledge(c);
        cell.status.ack_command = CellCommand::prepare;
        return AckResult::none;
    };
    cell.run();
    expect_contradiction(cell, "PREPARE");
}

}  // namespace
}  // namespace qchopper
