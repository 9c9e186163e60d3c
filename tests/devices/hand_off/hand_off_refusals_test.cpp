// Faults of docs/developer/link-faults.md on the side of the PC: what the hand-off sends and says when the cell answers
// so.

#include <set>

#include "tests/devices/hand_off/scripted_cell.h"

namespace qchopper {
namespace {

using namespace scripted;

constexpr std::uint32_t foreign_owner = 0xABCD;

// The cell refuses one command: NOT STARTED with its word, and the cell is given back.
void expect_not_started(CellCommand at, AckResult with, bool rehearses = false) {
    SCOPED_TRACE(std::string(name(at)) + " " + name(with));
    ScriptedCell cell;
    cell.plan.options.rehearse = rehearses;
    cell.grant = [&](const Command& c) { return c.command == at ? with : AckResult::ok; };
    cell.run();
    EXPECT_EQ(cell.state.start_outcome, StartOutcome::not_started);
    EXPECT_EQ(cell.state.refusal, with);
    EXPECT_FALSE(cell.state.fault);
    EXPECT_NE(cell.state.why.find(name(with)), std::string::npos) << cell.state.why;
    EXPECT_FALSE(cell.state.to_do.empty());
    EXPECT_EQ(cell.status.starts_total, 0U);
    EXPECT_EQ(cell.count(CellCommand::start), at == CellCommand::start ? 1 : 0) << "never a second time";
    expect_leaves_with(cell, "CANCEL RELEASE ");
}

TEST(Fault, F33_AnAcknowledgementOfAnotherPcWithTheSameNumberIsNoStart) {
    ScriptedCell cell;
    cell.grant = [&](const Command& c) {
        if (c.command != CellCommand::start) return AckResult::ok;
        Command theirs = c;
        theirs.owner = foreign_owner;
        cell.acknowledge(theirs);
        return AckResult::none;
    };
    cell.run();
    EXPECT_EQ(cell.state.start_outcome, StartOutcome::not_started) << cell.state.why;
    EXPECT_EQ(cell.status.starts_total, 0U);
    EXPECT_FALSE(cell.state.is_started);
}

TEST(Fault, F37_AFileThatChangedOnItsWayIsNotStarted) {
    expect_not_started(CellCommand::verify, AckResult::hash_mismatch);
    expect_not_started(CellCommand::store, AckResult::hash_mismatch);
    expect_not_started(CellCommand::prepare, AckResult::hash_mismatch);
    expect_not_started(CellCommand::start, AckResult::hash_mismatch);
}

TEST(Fault, F37_ACellThatSaysOkOfAnotherFileIsNotBelieved) {
    ScriptedCell cell;
    while (cell.step()) {
        if (cell.status.file_sha256 == cell.plan.ticket.file_sha256) cell.status.file_sha256.bytes[31] ^= 1;
    }
    EXPECT_EQ(cell.count(CellCommand::verify), 1);
    EXPECT_EQ(cell.state.start_outcome, StartOutcome::not_started);
    EXPECT_EQ(cell.state.refusal, AckResult::hash_mismatch);
    EXPECT_EQ(cell.count(CellCommand::prepare), 0);
    expect_leaves_with(cell, "CANCEL RELEASE ");
}

TEST(Fault, F38_AFileThatTheCellCannotTakeIsNotStarted) {
    expect_not_started(CellCommand::store, AckResult::store_full);
    expect_not_started(CellCommand::store, AckResult::ticket_field);
    expect_not_started(CellCommand::verify, AckResult::file_missing);
    expect_not_started(CellCommand::verify, AckResult::file_size);
    expect_not_started(CellCommand::verify, AckResult::store_io);
}

TEST(Fault, F47_ATokenOrReceiptOfAnotherCellIsNotStarted) {
    expect_not_started(CellCommand::start, AckResult::token_bad);
    expect_not_started(CellCommand::prepare, AckResult::rehearsal_required, true);
}

TEST(Fault, F58_AStopOnRequestWhileTheJobRunsIsSentAndConfirmed) {
    ScriptedCell cell;
    cell.plan.options.stop_when_cancelled = true;
    cell.run_to(HandOffStep::run);
    cell.grant = [&](const Command& c) {
        if (c.command != CellCommand::stop) return AckResult::ok;
        EXPECT_EQ(c.job_id, job);
        cell.status.state = PackState::stopped;
        cell.status.job_state = JobState::aborted;
        cell.change_result = [](ResultRecord& r) { r.result = JobResult::stopped; };
        return AckResult::ok;
    };
    cell.cancelled = cell.input.cancelled = true;
    cell.run();
    EXPECT_EQ(cell.count(CellCommand::stop), 1);
    EXPECT_EQ(cell.state.start_outcome, StartOutcome::started);
    EXPECT_TRUE(cell.state.cancelled);
    EXPECT_EQ(cell.status.starts_total, 1U);
    EXPECT_NE(cell.state.why.find("stopped"), std::string::npos) << cell.state.why;
}

TEST(Fault, F58_WithoutAnAnswerToStopTheReportDoesNotSayThatItStands) {
    ScriptedCell cell;
    cell.plan.options.stop_when_cancelled = true;
    cell.run_to(HandOffStep::run);
    cell.lose = [](const HandOffAction& action) { return action.kind != Kind::wait; };
    cell.cancelled = cell.input.cancelled = true;
    const double asked_s = cell.now_s;
    cell.run();
    EXPECT_LE(cell.now_s - asked_s, cell.plan.options.timings.answer_s + 0.1);
    EXPECT_EQ(cell.state.start_outcome, StartOutcome::started);
    EXPECT_NE(cell.state.why.find("continues by itself"), std::string::npos) << cell.state.why;
    EXPECT_FALSE(cell.state.to_do.empty());
}

TEST(Fault, F58_AStopOnRequestAfterTheStartLeavesTheJobRunningAndSaysSo) {
    ScriptedCell cell;
    cell.run_to(HandOffStep::run);
    cell.cancelled = cell.input.cancelled = true;
    cell.run();
    EXPECT_EQ(cell.count(CellCommand::stop), 0);
    EXPECT_EQ(cell.state.start_outcome, StartOutcome::started);
    EXPECT_NE(cell.state.why.find("runs on by itself"), std::string::npos) << cell.state.why;
    EXPECT_EQ(cell.commands.back().command, CellCommand::release);
}

TEST(Fault, F59_AfterAnEmergencyStopNothingIsSentThatMovesTheMachine) {
    ScriptedCell cell;
    cell.run_to(HandOffStep::run);
    cell.step();
    cell.commands.clear();
    cell.status.state = PackState::aborted;
    cell.status.flags |= flag::safety_open | flag::fault;
    cell.status.job_state = JobState::aborted;
    cell.change_result = [](ResultRecord& r) { r.result = JobResult::aborted; };
    cell.grant = [&](const Command& c) {
        cell.status.flags = flag::simulated;  // and released meanwhile
        return c.command == CellCommand::start ? AckResult::already_finished : AckResult::ok;
    };
    cell.run();
    EXPECT_EQ(cell.order(), "QUERY CLEAR_RESULT RELEASE ") << "no Clear, no Reset, no Start";
    EXPECT_EQ(cell.state.start_outcome, StartOutcome::started);
    EXPECT_NE(cell.state.why.find("aborted"), std::string::npos) << cell.state.why;
    EXPECT_FALSE(cell.state.to_do.empty());
    EXPECT_EQ(cell.status.starts_total, 1U);
}

// The cell executes a command once, and shows its acknowledgement only when the frame comes a second time.
TEST(Fault, F63_AnAcknowledgementThatWasOvertakenIsAskedForByTheSameFrame) {
    ScriptedCell cell;
    std::set<std::uint32_t> executed;
    cell.grant = [&](const Command& c) {
        if (executed.insert(c.seq).second) return AckResult::ok;
        cell.acknowledge(c, c.command == CellCommand::query_file ? AckResult::unknown_job : AckResult::ok);
        return AckResult::none;  // no second effect
    };
    std::size_t seen = 0;
    int overtaken = 0;
    while (cell.state.step < HandOffStep::run && cell.step()) {
        if (cell.commands.size() == seen) continue;
        seen = cell.commands.size();
        const Command& last = cell.commands.back();
        const bool is_first = std::count(cell.commands.begin(), cell.commands.end(), last) == 1;
        if (!is_first || last.command == CellCommand::query || last.command == CellCommand::query_file) continue;
        cell.status.ack_owner = foreign_owner;  // a QUERY of another client came next
        cell.status.ack_command = CellCommand::query;
        ++overtaken;
    }
    EXPECT_GE(overtaken, 5) << cell.order();
    for (const CellCommand command :
         {CellCommand::claim, CellCommand::store, CellCommand::verify, CellCommand::prepare}) {
        EXPECT_EQ(cell.count(command), 2) << name(command);
    }
    EXPECT_EQ(cell.status.starts_total, 1U);
    EXPECT_TRUE(cell.state.is_started);
    end_the_job(cell);
    EXPECT_EQ(cell.state.start_outcome, StartOutcome::started);
}

}  // namespace
}  // namespace qchopper
