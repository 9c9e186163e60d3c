// A cell of values that answers the actions of the hand-off: what the tests of hand_off.h share.

#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "devices/hand_off/hand_off.h"

namespace qchopper::scripted {

using Kind = HandOffAction::Kind;

constexpr Uuid job{1, 2, 3};
constexpr Uuid other_job{9, 9, 9};

inline HandOffPlan a_plan() {
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

    double call_s = 0.01;  // that each call takes

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
        events.insert(events.end(), turn.journal.begin(), turn.journal.end());
        if (turn.request_answer) request_answer = turn.request_answer;
        if (action.kind == Kind::finish) return false;
        now_s += call_s;
        status.heartbeat = static_cast<std::uint16_t>(freeze_s > 0 ? freeze_s / 0.5 : now_s / 0.5);
        input = HandOffInput{};
        input.cancelled = cancelled;
        input.request = std::exchange(request, CellCommand::none);
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
        if (action.kind == Kind::read_identity) input.identity = identity();
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

    Identity identity() const {
        Identity shown;
        shown.store_id = store_id;
        shown.boot_count = status.boot_count;
        shown.epoch_held = status.epoch_held;
        shown.starts_total = status.starts_total;
        shown.checks_store = checks_store;
        return shown;
    }

    void acknowledge(const Command& command, AckResult answer = AckResult::ok) {
        status.ack_owner = command.owner;
        status.ack_seq = command.seq;
        status.ack_command = command.command;
        status.ack_result = answer;
    }

    // As a cell does: commands with a lower number, or with other content under the last one, are ignored.
    bool ignores(const Command& command) {
        const auto last = last_of_owner.find(command.owner);
        const bool is_known = last != last_of_owner.end();
        const bool is_repeated = is_known && last->second == command;
        if (is_known && command.seq <= last->second.seq && !is_repeated) {
            ++status.bad_frames;
            status.bad_reason = AckResult::stale_seq;
            return true;
        }
        last_of_owner[command.owner] = command;
        return false;
    }

    void execute(const Command& command) {
        if (ignores(command)) return;
        commands.push_back(command);
        const AckResult answer = grant ? grant(command) : AckResult::ok;
        if (answer == AckResult::none) return;
        acknowledge(command, answer);
        if (is_refusal(answer)) return;
        switch (command.command) {
            case CellCommand::claim:
                status.epoch_held = command.epoch;
                status.ack_detail = 50000 + command.epoch;
                grants[status.ack_detail] = command.epoch;
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
                ++status.starts_total;
                break;
            case CellCommand::query_file:
                result = milled_before.value_or(ResultRecord{});
                result.query_owner = command.owner;
                result.query_seq = command.seq;
                status.ack_detail = milled_before ? 1 : 0;
                if (!milled_before) acknowledge(command, AckResult::unknown_job);
                break;
            case CellCommand::query:
                if (milled_before || result.job_id != command.job_id) result = ResultRecord{};
                result.job_id = command.job_id;
                result.query_owner = command.owner;
                result.query_seq = command.seq;
                result.grant_epoch = grants.contains(command.arg0) ? grants[command.arg0] : 0;
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
    std::map<std::uint32_t, Command> last_of_owner;
    std::vector<CellCommand> written;
    std::vector<std::string> lines;
    std::vector<JournalEvent> events;
    Uuid store_id{42};
    std::uint16_t checks_store = 1;
    std::map<std::uint32_t, std::uint32_t> grants;  // of CLAIMs: their numbers, their epochs
    std::optional<ResultRecord> milled_before;      // the answer to QUERY_FILE
    CellCommand request = CellCommand::none;
    std::optional<RequestAnswer> request_answer;
    std::function<AckResult(const Command&)> grant;    // the result; none: not acknowledged
    std::function<bool(const HandOffAction&)> lose;    // the link is lost at this action
    std::function<int(const HandOffAction&)> refuse;   // the exception, or 0
    std::function<void(ResultRecord&)> change_result;  // of the answer to QUERY
};

inline bool writes(const HandOffAction& action, CellCommand command) {
    return action.kind == Kind::write_command && action.command.command == command;
}

// Loses the link once, at the first START, after `meanwhile`.
inline void lose_first_start(ScriptedCell& cell, const std::function<void(const Command&)>& meanwhile) {
    cell.lose = [meanwhile, is_done = false](const HandOffAction& action) mutable {
        if (is_done || !writes(action, CellCommand::start)) return false;
        is_done = true;
        meanwhile(action.command);
        return true;
    };
}

inline void end_the_job(ScriptedCell& cell) {
    cell.run_to(HandOffStep::run);
    cell.status.job_state = JobState::ended;
    cell.status.job_result = JobResult::complete;
    cell.status.state = PackState::complete;
    cell.result.result = JobResult::complete;
    cell.result.starts = 1;
    cell.run();
}

inline void expect_leaves_with(const ScriptedCell& cell, const std::string& last_commands) {
    const std::string order = cell.order();
    EXPECT_TRUE(order.ends_with(last_commands)) << order;
}

}  // namespace qchopper::scripted
