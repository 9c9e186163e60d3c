// The hand-off against a cell of values: its actions, given the answers.

#include "devices/hand_off.h"

#include <gtest/gtest.h>

#include <functional>

namespace qchopper {
namespace {

using Kind = HandOffAction::Kind;

constexpr Uuid job{1, 2, 3};
constexpr Uuid other_job{9, 9, 9};

HandOffPlan a_plan() {
    HandOffPlan plan;
    plan.ticket.job_id = job;
    plan.ticket.file_sha256.bytes.fill(7);
    plan.ticket.file_size = 100;
    plan.ticket.file_name = "piece.qjob";
    plan.owner = 77;
    plan.secret = 88;
    return plan;
}

// A cell of values: every command is granted at once, unless the test replaces one of the functions below.
struct ScriptedCell {
    explicit ScriptedCell(HandOffPlan with = a_plan()) : plan(std::move(with)) {
        status.cell_id = any_cell_id;
        status.flags = flag::simulated;
        status.state = PackState::stopped;
        status.boot_count = 1;
    }

    // One action and its answer; false when it is finished.
    bool step() {
        if (++steps > 100000) {
            ADD_FAILURE() << "no end in sight at " << name(state.step);
            return false;
        }
        HandOffTransition turn = advance(plan, state, input, now_s);
        state = turn.state;
        action = turn.action;
        lines.insert(lines.end(), turn.lines.begin(), turn.lines.end());
        if (action.kind == Kind::finish) return false;
        now_s += 0.01;
        status.heartbeat = static_cast<std::uint16_t>(freeze_s > 0 ? freeze_s / 0.5 : now_s / 0.5);
        input = HandOffInput{};
        input.cancelled = cancelled;
        if (action.kind == Kind::wait) now_s = std::max(now_s, action.until_s);
        if (lose && lose(action)) {
            input.end = BusEnd::lost;
            input.why = "cut";
            return true;
        }
        if (refuse && refuse(action) != 0) {
            input.end = BusEnd::exception;
            input.exception = refuse(action);
            return true;
        }
        if (action.kind == Kind::read_status) input.status = status;
        if (action.kind == Kind::read_result) input.result = result;
        if (action.kind == Kind::read_result && change_result) change_result(*input.result);
        if (action.kind == Kind::write_command) written.push_back(action.command.command);
        if (action.kind == Kind::write_command && freeze_s == 0) execute(action.command);
        return true;
    }

    void run() {
        while (step()) {
        }
    }

    void run_to(HandOffStep wanted) {
        while (state.step != wanted && step()) {
        }
    }

    void acknowledge(const Command& command, AckResult answer = AckResult::ok) {
        status.ack_owner = command.owner;
        status.ack_seq = command.seq;
        status.ack_command = command.command;
        status.ack_result = answer;
    }

    void execute(const Command& command) {
        commands.push_back(command);
        const AckResult answer = grant ? grant(command) : AckResult::ok;
        if (answer == AckResult::none) return;
        acknowledge(command, answer);
        if (is_refusal(answer)) return;
        switch (command.command) {
            case CellCommand::claim:
                status.epoch_held = command.epoch;
                status.owner_held = command.owner;
                status.flags |= flag::lease_held;
                break;
            case CellCommand::reset:
                status.state = PackState::idle;
                break;
            case CellCommand::store:
                status.job_id = command.job_id;
                status.job_state = JobState::stored;
                break;
            case CellCommand::verify:
                status.file_sha256 = command.file_sha256;
                break;
            case CellCommand::prepare:
                status.token = ++tokens;
                status.job_state = JobState::prepared;
                break;
            case CellCommand::start:
                status.job_state = JobState::running;
                status.state = PackState::execute;
                break;
            case CellCommand::query:
                result.job_id = command.job_id;
                result.query_owner = command.owner;
                result.query_seq = command.seq;
                if (status.job_id == command.job_id) result.state = status.job_state;
                result.starts = status.job_id == command.job_id && status.job_state >= JobState::running ? 1 : 0;
                result.file_sha256 = plan.ticket.file_sha256;
                break;
            default:
                break;
        }
    }

    int count(CellCommand command) const {
        int n = 0;
        for (const Command& one : commands) n += one.command == command ? 1 : 0;
        return n;
    }
    std::string order() const {
        std::string text;
        for (const Command& one : commands) text += std::string(name(one.command)) + " ";
        return text;
    }

    HandOffPlan plan;
    HandOff state;
    HandOffInput input;
    HandOffAction action;
    double now_s = 100;
    double freeze_s = 0;
    int steps = 0;
    bool cancelled = false;
    Status status;
    ResultRecord result;
    std::uint32_t tokens = 1000;
    std::vector<Command> commands;  // that the cell has executed; a frozen one executes none
    std::vector<CellCommand> written;
    std::vector<std::string> lines;
    std::function<AckResult(const Command&)> grant;    // the result; none: not acknowledged
    std::function<bool(const HandOffAction&)> lose;    // the link is lost at this action
    std::function<int(const HandOffAction&)> refuse;   // the exception, or 0
    std::function<void(ResultRecord&)> change_result;  // of the answer to QUERY
};

bool writes(const HandOffAction& action, CellCommand command) {
    return action.kind == Kind::write_command && action.command.command == command;
}

// Loses the link once, at the first START, after `meanwhile`.
void lose_first_start(ScriptedCell& cell, const std::function<void(const Command&)>& meanwhile) {
    cell.lose = [meanwhile, is_done = false](const HandOffAction& action) mutable {
        if (is_done || !writes(action, CellCommand::start)) return false;
        is_done = true;
        meanwhile(action.command);
        return true;
    };
}

void end_the_job(ScriptedCell& cell) {
    cell.run_to(HandOffStep::run);
    cell.status.job_state = JobState::ended;
    cell.status.job_result = JobResult::complete;
    cell.status.state = PackState::complete;
    cell.result.result = JobResult::complete;
    cell.result.starts = 1;
    cell.run();
}

TEST(HandOff, TheCommandsComeInTheOrderOfTheProtocol) {
    ScriptedCell cell;
    end_the_job(cell);
    EXPECT_EQ(cell.order(), "CLAIM QUERY Reset STORE VERIFY PREPARE Start QUERY CLEAR_RESULT Reset RELEASE ");
    EXPECT_EQ(cell.state.verdict, StartVerdict::started);
    ASSERT_TRUE(cell.state.result.has_value());
    EXPECT_EQ(cell.state.result->starts, 1U);
    for (const Command& command : cell.commands) EXPECT_EQ(command.owner, 77U);
    for (std::size_t i = 1; i < cell.commands.size(); ++i) EXPECT_GT(cell.commands[i].seq, cell.commands[i - 1].seq);
}

TEST(HandOff, BeforeEveryCommandThereIsARowForTheJournal) {
    ScriptedCell cell;
    std::string rows;
    int commands = 0;
    while (cell.state.step != HandOffStep::run && cell.step()) {
        if (cell.action.kind != Kind::write_command) continue;
        ++commands;
        EXPECT_FALSE(cell.action.journal.empty()) << name(cell.action.command.command);
        rows += cell.action.journal + "\n";
    }
    EXPECT_EQ(commands, 7);
    EXPECT_NE(rows.find("EPOCH"), std::string::npos);
    EXPECT_NE(rows.find("START_INTENT job=" + to_text(job)), std::string::npos) << rows;
    EXPECT_NE(rows.find("token=1001"), std::string::npos) << rows;
}

TEST(HandOff, AnOwnRefusalOfStartIsNotStarted) {
    ScriptedCell cell;
    cell.grant = [](const Command& c) {
        return c.command == CellCommand::start ? AckResult::safety_open : AckResult::ok;
    };
    cell.run();
    EXPECT_EQ(cell.state.verdict, StartVerdict::not_started);
    EXPECT_EQ(cell.state.refusal, AckResult::safety_open);
    EXPECT_EQ(cell.order(), "CLAIM QUERY Reset STORE VERIFY PREPARE Start CANCEL RELEASE ");
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
    EXPECT_EQ(cell.state.verdict, StartVerdict::started);
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

TEST(HandOff, AfterALostLinkComesAFenceAndAQuestionBeforeAnythingElse) {
    ScriptedCell cell;
    lose_first_start(cell, [&](const Command&) { cell.status.job_state = JobState::stored; });  // it did not arrive
    end_the_job(cell);
    EXPECT_EQ(cell.order(),
              "CLAIM QUERY Reset STORE VERIFY PREPARE CLAIM QUERY STORE VERIFY PREPARE Start QUERY CLEAR_RESULT Reset "
              "RELEASE ");
    EXPECT_GT(cell.commands[6].epoch, cell.commands[5].epoch);
    EXPECT_EQ(cell.state.verdict, StartVerdict::started);
    EXPECT_EQ(cell.commands[11].token, 1002U);  // a new token
}

TEST(HandOff, AStartThatArrivedThoughItsAnswerDidNotIsTakenUp) {
    ScriptedCell cell;
    lose_first_start(cell, [&](const Command& start) { cell.execute(start); });
    end_the_job(cell);
    EXPECT_EQ(cell.count(CellCommand::start), 1);
    EXPECT_EQ(cell.state.verdict, StartVerdict::started);
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
        EXPECT_EQ(cell.state.verdict, last == CellCommand::start ? StartVerdict::unknown : StartVerdict::not_started);
        EXPECT_EQ(cell.count(CellCommand::start), 0);
        EXPECT_LT(cell.now_s - began, 40);
    }
}

TEST(HandOff, ALinkLostForGoodWhileTheJobRunsIsStillStarted) {
    ScriptedCell cell;
    cell.run_to(HandOffStep::run);
    cell.lose = [](const HandOffAction& action) { return action.kind != Kind::wait; };
    cell.run();
    EXPECT_EQ(cell.state.verdict, StartVerdict::started);
    EXPECT_NE(cell.state.why.find("runs on by itself"), std::string::npos);
}

TEST(HandOff, ABusyCellIsAskedAgainTenTimesAndNoMore) {
    ScriptedCell cell;
    int asked = 0;
    cell.refuse = [](const HandOffAction& action) { return writes(action, CellCommand::store) ? 6 : 0; };
    while (cell.step()) asked += writes(cell.action, CellCommand::store) ? 1 : 0;
    EXPECT_EQ(asked, 11);
    EXPECT_EQ(cell.state.verdict, StartVerdict::not_started);
    EXPECT_NE(cell.state.why.find("exception 6"), std::string::npos) << cell.state.why;
}

TEST(HandOff, AnyOtherExceptionIsReportedAtOnce) {
    ScriptedCell cell;
    int asked = 0;
    cell.refuse = [](const HandOffAction& action) { return action.kind == Kind::write_ticket ? 2 : 0; };
    while (cell.step()) asked += cell.action.kind == Kind::write_ticket ? 1 : 0;
    EXPECT_EQ(asked, 1);
    EXPECT_EQ(cell.state.verdict, StartVerdict::not_started);
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
    EXPECT_EQ(cell.state.verdict, StartVerdict::not_started);
    EXPECT_NE(cell.state.why.find("frozen"), std::string::npos) << cell.state.why;
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

TEST(HandOff, AStopOnRequestAtAnyMomentBeforeStartIsConfirmedAndNothingIsStarted) {
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
        EXPECT_EQ(cell.state.verdict, StartVerdict::not_started) << at;
        EXPECT_TRUE(cell.state.is_cancelled);
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
        EXPECT_EQ(cell.state.verdict, before.is_started   ? StartVerdict::started
                                      : before.start_sent ? StartVerdict::unknown
                                                          : StartVerdict::not_started)
            << turns << cell.state.why;
        EXPECT_TRUE(cell.state.is_cancelled);
        EXPECT_FALSE(cell.state.why.empty());
        const auto was_written = [&](CellCommand command) {
            return std::count(cell.written.begin(), cell.written.end(), command) > 0;
        };
        EXPECT_EQ(was_written(CellCommand::cancel), before.is_stored && !before.start_sent && !before.is_started);
        if (before.claim_sent && !(before.start_sent && !before.is_started)) {
            EXPECT_TRUE(was_written(CellCommand::release)) << turns << " " << name(before.step);
        }
        started += cell.state.verdict == StartVerdict::started ? 1 : 0;
        not_started += cell.state.verdict == StartVerdict::not_started ? 1 : 0;
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
        EXPECT_EQ(cell.state.verdict, before.is_started   ? StartVerdict::started
                                      : before.start_sent ? StartVerdict::unknown
                                                          : StartVerdict::not_started);
        if (before.step >= HandOffStep::release) break;
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
    EXPECT_EQ(cell.state.verdict, StartVerdict::not_started);
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
        EXPECT_EQ(cell.state.is_cancelled, answer != AckResult::safety_open);  // that end is the cell's own
        EXPECT_EQ(cell.state.verdict, answer == AckResult::ok     ? StartVerdict::started
                                      : answer == AckResult::none ? StartVerdict::unknown
                                                                  : StartVerdict::not_started)
            << cell.state.why;
        EXPECT_EQ(cell.count(CellCommand::cancel), answer == AckResult::safety_open ? 1 : 0);
    }
}

void expect_leaves_with(const ScriptedCell& cell, const std::string& last_commands) {
    const std::string order = cell.order();
    EXPECT_TRUE(order.ends_with(last_commands)) << order;
}

TEST(HandOff, AfterAnExceptionTheCellIsGivenBack) {
    for (const int code : {1, 2, 3, 4}) {
        for (const CellCommand at : {CellCommand::query, CellCommand::verify, CellCommand::prepare}) {
            ScriptedCell cell;
            cell.refuse = [&](const HandOffAction& action) { return writes(action, at) ? code : 0; };
            cell.run();
            EXPECT_EQ(cell.state.verdict, StartVerdict::not_started);
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
        EXPECT_EQ(cell.state.verdict, step == HandOffStep::run ? StartVerdict::started : StartVerdict::not_started);
    }
}

TEST(HandOff, TheResultOfAnotherJobIsNotAskedForWithoutEnd) {
    ScriptedCell before;
    before.change_result = [](ResultRecord& result) { result.job_id = other_job; };
    before.run();
    EXPECT_EQ(before.state.verdict, StartVerdict::not_started);
    EXPECT_NE(before.state.why.find(to_text(other_job)), std::string::npos) << before.state.why;
    EXPECT_LE(before.count(CellCommand::query), 12);
    expect_leaves_with(before, "QUERY RELEASE ");

    ScriptedCell after;
    after.run_to(HandOffStep::run);
    after.change_result = before.change_result;
    end_the_job(after);
    EXPECT_EQ(after.state.verdict, StartVerdict::started);  // STATUS has shown that
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
    EXPECT_EQ(cell.state.verdict, StartVerdict::started);
    EXPECT_EQ(cell.count(CellCommand::query), 8);
    EXPECT_EQ(cell.count(CellCommand::start), 1);
}

void expect_contradiction(const ScriptedCell& cell, const std::string& named) {
    EXPECT_EQ(cell.state.verdict, StartVerdict::unknown) << cell.state.why;
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
    EXPECT_EQ(tokenless.state.verdict, StartVerdict::not_started);
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
    EXPECT_EQ(cutting.state.verdict, StartVerdict::not_started);
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
    EXPECT_EQ(cell.state.verdict, StartVerdict::started);

    ScriptedCell busy;
    busy.status.job_id = other_job;
    busy.status.job_state = JobState::running;
    busy.status.state = PackState::execute;
    busy.run();
    EXPECT_EQ(busy.state.fault, DeviceFault::busy);
    EXPECT_EQ(busy.order(), "CLAIM QUERY RELEASE ");
}

TEST(HandOff, ACellWithAnotherMagicNumberIsAnErrorOfTheProtocol) {
    ScriptedCell cell;
    cell.step();
    cell.input = {};
    cell.input.end = BusEnd::lost;
    cell.input.fault = BlockFault::magic;
    HandOffTransition turn = advance(cell.plan, cell.state, cell.input, 1);
    EXPECT_EQ(turn.action.kind, Kind::finish);
    EXPECT_EQ(turn.state.fault, DeviceFault::protocol);
}

}  // namespace
}  // namespace qchopper
