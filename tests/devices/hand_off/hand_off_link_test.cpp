// The hand-off when the link or the cell does not answer as it should.

#include "devices/hand_off/hand_off.h"

#include "tests/devices/hand_off/scripted_cell.h"

namespace qchopper {
namespace {

using namespace scripted;

TEST(HandOff, AfterALostLinkComesAFenceAndAQuestionBeforeAnythingElse) {
    ScriptedCell cell;
    lose_first_start(cell, [&](const Command&) { cell.status.job_state = JobState::stored; });  // it did not arrive
    end_the_job(cell);
    EXPECT_EQ(cell.order(),
              "CLAIM QUERY QUERY_FILE Reset STORE VERIFY PREPARE CLAIM QUERY QUERY_FILE STORE VERIFY PREPARE Start "
              "QUERY CLEAR_RESULT Reset "
              "RELEASE ");
    EXPECT_GT(cell.commands[7].epoch, cell.commands[6].epoch);
    EXPECT_EQ(cell.state.start_outcome, StartOutcome::started);
    EXPECT_EQ(cell.commands[13].token, 1002U);  // a new token
}

TEST(Fault, F07_AStartThatArrivedThoughItsAnswerDidNotIsTakenUp) {
    ScriptedCell cell;
    lose_first_start(cell, [&](const Command& start) { cell.execute(start); });
    end_the_job(cell);
    EXPECT_EQ(cell.count(CellCommand::start), 1);
    EXPECT_EQ(cell.state.start_outcome, StartOutcome::started);
}

TEST(HandOff, ALinkThatNeverComesBackIsUnknownOnlyIfAStartMayHaveArrived) {
    for (const CellCommand last : {CellCommand::store, CellCommand::prepare, CellCommand::start}) {
        ScriptedCell cell;
        bool dead = false;
        cell.lose = [&](const HandOffAction& action) {
            dead = dead || writes(action, last);
            return dead && action.kind != Kind::wait;
        };
        const double began = cell.now_s;
        cell.run();
        EXPECT_EQ(cell.state.start_outcome,
                  last == CellCommand::start ? StartOutcome::unknown : StartOutcome::not_started);
        EXPECT_EQ(cell.count(CellCommand::start), 0);
        EXPECT_LT(cell.now_s - began, 40);
    }
}

TEST(HandOff, ALinkLostForGoodWhileTheJobRunsIsStillStarted) {
    ScriptedCell cell;
    cell.run_to(HandOffStep::run);
    cell.lose = [](const HandOffAction& action) { return action.kind != Kind::wait; };
    cell.run();
    EXPECT_EQ(cell.state.start_outcome, StartOutcome::started);
    EXPECT_NE(cell.state.why.find("runs on by itself"), std::string::npos);
}

TEST(HandOff, ABusyCellIsAskedAgainTenTimesAndNoMore) {
    ScriptedCell cell;
    int asked = 0;
    cell.refuse = [](const HandOffAction& action) { return writes(action, CellCommand::store) ? 6 : 0; };
    while (cell.step()) asked += writes(cell.action, CellCommand::store) ? 1 : 0;
    EXPECT_EQ(asked, 11);
    EXPECT_EQ(cell.state.start_outcome, StartOutcome::not_started);
    EXPECT_NE(cell.state.why.find("exception 6"), std::string::npos) << cell.state.why;
}

TEST(HandOff, AnyOtherExceptionIsReportedAtOnce) {
    ScriptedCell cell;
    int asked = 0;
    cell.refuse = [](const HandOffAction& action) { return action.kind == Kind::write_ticket ? 2 : 0; };
    while (cell.step()) asked += cell.action.kind == Kind::write_ticket ? 1 : 0;
    EXPECT_EQ(asked, 1);
    EXPECT_EQ(cell.state.start_outcome, StartOutcome::not_started);
}

TEST(HandOff, AFrozenCellGetsNoCommand) {
    ScriptedCell cell;
    cell.grant = [&](const Command& c) {
        return c.command == CellCommand::prepare ? AckResult::pending : AckResult::ok;
    };
    cell.run_to(HandOffStep::prepare);
    cell.freeze_s = cell.now_s;
    const auto before = cell.commands.size();
    cell.run();
    EXPECT_EQ(cell.commands.size(), before);
    EXPECT_EQ(cell.state.start_outcome, StartOutcome::not_started);
    EXPECT_NE(cell.state.why.find("CELL FROZEN"), std::string::npos) << cell.state.why;
}

TEST(HandOff, AfterAnExceptionTheCellIsGivenBack) {
    for (const int code : {1, 2, 3, 4}) {
        for (const CellCommand at : {CellCommand::query, CellCommand::verify, CellCommand::prepare}) {
            ScriptedCell cell;
            cell.refuse = [&](const HandOffAction& action) { return writes(action, at) ? code : 0; };
            cell.run();
            EXPECT_EQ(cell.state.start_outcome, StartOutcome::not_started);
            EXPECT_NE(cell.state.why.find("exception " + std::to_string(code)), std::string::npos) << cell.state.why;
            expect_leaves_with(cell, at == CellCommand::query ? "CLAIM RELEASE " : " CANCEL RELEASE ");
        }
    }
    // With a cell that refuses everything from some moment on the hand-off ends as well.
    for (const HandOffStep step : {HandOffStep::prepare, HandOffStep::run}) {
        ScriptedCell cell;
        cell.run_to(step);
        cell.refuse = [](const HandOffAction& action) { return action.kind == Kind::wait ? 0 : 4; };
        const double began_s = cell.now_s;
        cell.run();
        EXPECT_LT(cell.now_s - began_s, 1);
        EXPECT_EQ(cell.state.start_outcome,
                  step == HandOffStep::run ? StartOutcome::started : StartOutcome::not_started);
    }
}

TEST(HandOff, TheFirstStatusIsTriedAgainBeforeItIsGivenUp) {
    const auto first = [](HandOffInput failure, int failures) {
        ScriptedCell cell;
        cell.step();
        for (int n = 0; n < 100 && cell.state.step != HandOffStep::finished; ++n) {
            if (cell.action.kind == Kind::read_status && failures-- > 0) cell.input = failure;
            if (cell.state.step > HandOffStep::check_cell || !cell.step()) break;
        }
        return cell;
    };
    HandOffInput silent;
    silent.end = BusEnd::lost;
    silent.why = "no answer in time";
    EXPECT_GT(first(silent, 2).state.step, HandOffStep::check_cell);
    EXPECT_EQ(first(silent, 99).state.fault, DeviceFault::unreachable);
    EXPECT_LT(first(silent, 99).now_s, 103);
    HandOffInput alien = silent;
    alien.is_alien = true;
    EXPECT_GT(first(alien, 1).state.step, HandOffStep::check_cell);
    EXPECT_EQ(first(alien, 99).state.fault, DeviceFault::protocol);
    HandOffInput damaged = silent;
    damaged.fault = BlockFault::crc;
    EXPECT_GT(first(damaged, 2).state.step, HandOffStep::check_cell);
    EXPECT_EQ(first(damaged, 99).state.fault, DeviceFault::protocol);
    const auto exception = [](int code) {
        HandOffInput input;
        input.end = BusEnd::exception;
        input.exception = code;
        return input;
    };
    EXPECT_EQ(first(exception(6), 99).state.fault, DeviceFault::busy);
    EXPECT_EQ(first(exception(2), 99).state.fault, DeviceFault::protocol);
    for (const int code : {4, 10, 11}) {
        EXPECT_GT(first(exception(code), 2).state.step, HandOffStep::check_cell) << code;
        EXPECT_EQ(first(exception(code), 99).state.fault, DeviceFault::unreachable) << code;
    }
}

// One damaged STATUS is read again, whatever is wrong in it; what answers with nothing else for 2 s is no cell.
TEST(HandOff, AnotherMagicNumberIsAnErrorOfTheProtocolOnlyIfItStays) {
    for (const BlockFault fault : {BlockFault::magic, BlockFault::version, BlockFault::crc, BlockFault::torn}) {
        const auto damaged_until = [fault](double good_s) {
            ScriptedCell cell;
            cell.now_s = 0;
            while (cell.state.step == HandOffStep::check_cell && cell.step()) {
                if (cell.action.kind != Kind::read_status || cell.now_s >= good_s) continue;
                cell.input = {};
                cell.input.end = BusEnd::lost;
                cell.input.fault = fault;
            }
            return cell;
        };
        EXPECT_FALSE(damaged_until(0.5).state.fault.has_value());
        const ScriptedCell foreign = damaged_until(99);
        EXPECT_EQ(foreign.state.fault, DeviceFault::protocol);
        EXPECT_EQ(foreign.state.to_do.text.find("register map 1.1") != std::string::npos, fault == BlockFault::version);
        EXPECT_LT(foreign.now_s, 3);
        EXPECT_TRUE(foreign.written.empty());
    }
}

TEST(HandOff, OverALinkSlowerThanItsHeartbeatsTheJobStartsAllTheSame) {
    ScriptedCell cell;
    cell.call_s = 0.9;
    cell.run_to(HandOffStep::run);
    EXPECT_EQ(cell.state.step, HandOffStep::run);
    EXPECT_EQ(cell.count(CellCommand::start), 1);
}

TEST(HandOff, TheCellIsQueriedOnlyOverTheConnectionWhoseIdentityWasRead) {
    // Whichever call loses the connection: before the next CLAIM, and after it until the answer to QUERY, no call was
    // lost since the last read of IDENTITY.
    for (int lost_at = 1; lost_at < 60; ++lost_at) {
        ScriptedCell cell;
        int calls = 0;
        bool identity_is_of_connection = false;
        cell.lose = [&](const HandOffAction& action) {
            if (action.kind == Kind::wait || action.kind == Kind::stage_file || action.kind == Kind::put_file)
                return false;
            const bool is_lost = ++calls == lost_at;
            if (is_lost) identity_is_of_connection = false;
            if (!is_lost && action.kind == Kind::read_identity) identity_is_of_connection = true;
            if (!is_lost && (writes(action, CellCommand::claim) || writes(action, CellCommand::query))) {
                EXPECT_TRUE(identity_is_of_connection) << "lost at call " << lost_at;
            }
            return is_lost;
        };
        cell.run_to(HandOffStep::run);
    }
}

TEST(Fault, F24_AnEmptiedCellIsFoundWhicheverCallLosesTheConnectionAfterStart) {
    for (int lost_at = 0; lost_at < 12; ++lost_at) {
        ScriptedCell cell;
        int calls = -1;
        bool start_was_open = false;
        cell.lose = [&](const HandOffAction& action) {
            if (writes(action, CellCommand::start)) calls = 0;
            if (calls < 0 || action.kind == Kind::wait) return false;
            if (calls++ == 0) return true;  // START itself: the cell has not got it, or lost it with its memory
            if (calls != lost_at + 2) return false;
            start_was_open = cell.state.start_sent;
            // Power fails, and the cell comes back with an empty memory whose counters are those that were seen.
            cell.store_id = Uuid{43};
            cell.status.job_id = {};
            cell.status.job_state = JobState::none;
            cell.status.state = PackState::stopped;
            return true;
        };
        cell.run_to(HandOffStep::prepare);
        cell.run_to(HandOffStep::finished);
        if (start_was_open) {
            EXPECT_EQ(cell.state.start_outcome, StartOutcome::unknown) << lost_at;
        }
    }
}

TEST(Fault, F48_ARealCellWhereASimulatedOneIsWantedAndTheReverse) {
    for (const bool want_simulated : {true, false}) {
        HandOffPlan plan = a_plan();
        plan.options.want_simulated = want_simulated;
        ScriptedCell cell(plan);
        cell.status.flags = want_simulated ? 0 : flag::simulated;
        cell.run();
        EXPECT_EQ(cell.state.fault, DeviceFault::refused);
        EXPECT_TRUE(cell.written.empty());
    }
}

}  // namespace
}  // namespace qchopper
