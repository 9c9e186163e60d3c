// What time, consent and the check of a file change in the simulated controller. O(1), and O(acknowledgements kept) for
// the end of a pending command.

#include <algorithm>
#include <cassert>
#include <cmath>

#include "sim/cell/machine_parts.h"
#include "sim/cell/panel.h"
#include "sim/cell/ticket_check.h"

namespace qchopper {
namespace cell {

constexpr double blocks_per_s = 10;

namespace {

// The states in which a program is executed to the end of its line.
bool is_stopping_at_line(const CellState& cell, PackState state) {
    return cell.job.program.run && (state == PackState::holding || state == PackState::suspending);
}

}  // namespace

double whole_run_s(const CellState& cell) {
    return cell.job.program.run ? cell.job.program.run->seconds : cell.job.ticket.estimated_time_s;
}

double run_so_far_s(const CellState& cell, CellTime now) {
    const bool stops = is_stopping_at_line(cell, cell.state);
    if ((cell.state != PackState::execute && !stops) || !cell.job.is_active()) return cell.job.run_s;
    const double here_s = static_cast<double>(now.steady_ms - cell.state_since_ms) / 1000 * cell.limits.speed;
    return std::min(stops ? cell.job.stop_s : whole_run_s(cell), cell.job.run_s + std::max(0.0, here_s));
}

void pass_run(CellState& cell, CellTime now) {
    if (cell.state != PackState::execute) return;
    cell.job.run_s = run_so_far_s(cell, now);
    cell.state_since_ms = now.steady_ms;
}

void enter_state(CellState& cell, PackState to, std::int64_t at_ms) {
    cell.job.run_s = run_so_far_s(cell, {at_ms, 0});
    if (is_stopping_at_line(cell, to)) cell.job.stop_s = line_end(*cell.job.program.run, cell.job.run_s);
    assert(to != PackState::undefined);
    cell.state_before = cell.state;
    cell.state = to;
    cell.state_since_ms = at_ms;
    if (!cell.job.is_active()) return;
    const bool is_running = to == PackState::starting || to == PackState::execute || to == PackState::completing;
    cell.job.state = is_running ? JobState::running : JobState::interrupted;
}

void note_carved(CellState& cell, CellTime now) {
    cell.surroundings.carved = {cell.job.ticket.job_id, run_so_far_s(cell, now), block_now(cell, now)};
}

void end_job(CellState& cell, JobState state, JobResult result, CellTime now, const CellHooks& hooks) {
    cell.job.state = state;
    cell.job.result = result;
    cell.consent_present = false;                               // the block is used: the next start needs a new consent
    assert(cell.memory.jobs.contains(cell.job.ticket.job_id));  // since START
    JobRecord& record = cell.memory.jobs[cell.job.ticket.job_id];
    record.state = state;
    record.result = result;
    record.end_time_ms = unix_ms(cell, now);
    note_carved(cell, now);
    record.last_block = cell.surroundings.carved.block;
    if (cell.surroundings.block == BlockOnTable::fresh) cell.surroundings.block = BlockOnTable::used;
    if (!save(cell, cell.memory, hooks)) cell.warning = true;
    log(cell, hooks, "job " + to_text(cell.job.ticket.job_id) + " " + name(state) + ": " + name(result));
}

std::uint32_t block_now(const CellState& cell, CellTime now) {
    const double run_s = run_so_far_s(cell, now);
    if (cell.job.program.run) return place_at(*cell.job.program.run, run_s).block;
    return static_cast<std::uint32_t>(std::floor(blocks_per_s * run_s));
}

std::optional<CommandAnswer> unfit_job(const CellState& cell) {
    if (const auto fault = does_not_fit(cell.job.ticket, cell.limits)) return fault;
    const ReceivedProgram& program = cell.job.program;
    if (program.fault.empty()) return std::nullopt;
    return CommandAnswer{AckResult::program_unreadable, program.fault_line};
}

void raise_alarm(CellState& cell, const CellAlarm& alarm, JobResult result, CellTime now, const CellHooks& hooks) {
    if (cell.alarm.code == 0) {
        cell.alarm = alarm;
        cell.alarm.block = cell.job.is_active() ? block_now(cell, now) : 0;
    }
    log(cell, hooks, "alarm: " + alarm.text);
    drop_preparation(cell, AckResult::safety_open);
    if (transition(cell.state, CellCommand::abort).kind != TransitionKind::moves) return;
    const bool was_active = cell.job.is_active();
    enter_state(cell, PackState::aborting, now.steady_ms);
    if (was_active) end_job(cell, JobState::aborted, result, now, hooks);
}

void settle(CellState& cell, AckResult result, std::uint32_t detail) {
    const auto put = [&](Acknowledgement& ack) {
        if (ack.owner != cell.pending->owner || ack.seq != cell.pending->seq) return;
        ack.result = result;
        ack.detail = detail;
    };
    if (!cell.pending) return;
    assert(result != AckResult::pending);
    put(cell.ack);
    for (Acknowledgement& ack : cell.senders) put(ack);
    if (cell.pending->waits == Pending::Waits::rehearsal) cell.mode = UnitMode::production;
    cell.pending.reset();
}

void drop_preparation(CellState& cell, AckResult why) {
    if (cell.pending && cell.pending->waits != Pending::Waits::file) settle(cell, why);
    if (cell.job.state != JobState::prepared) return;
    cell.job.state = JobState::stored;
    cell.job.token = 0;
    cell.consent_present = false;
}

namespace {

void pass_lease(CellState& cell, CellTime now, const CellHooks& hooks) {
    if (!cell.lease) return;
    if (!cell.watchdog_expired && now.steady_ms - cell.lease->heartbeat_ms >= watchdog_ms) {
        cell.watchdog_expired = true;
        log(cell, hooks, "no heartbeat of the dispatcher for 2.5 s");
        const bool holds = cell.job.is_active() && cell.job.ticket.on_link_loss == LinkLoss::hold;
        const Transition to = transition(cell.state, CellCommand::hold);
        if (holds && to.kind == TransitionKind::moves) enter_state(cell, to.to, now.steady_ms);
    }
    if (now.steady_ms < cell.lease->until_ms) return;
    log(cell, hooks, "the lease of the dispatcher has run out");
    cell.lease.reset();
    cell.watchdog_expired = false;
    drop_preparation(cell, AckResult::not_owner);
}

void pass_token(CellState& cell, CellTime now, const CellHooks& hooks) {
    if (cell.job.state != JobState::prepared || now.steady_ms < cell.job.token_until_ms) return;
    cell.job.expired_token = cell.job.token;
    drop_preparation(cell, AckResult::token_expired);
    log(cell, hooks, "the start token has expired");
}

// What automatic consent says of the block: for a later part the one of the part before, not moved; else a fresh one.
bool is_block_right(const CellState& cell) {
    const BlockOnTable block = cell.surroundings.block;
    if (cell.pending->command != CellCommand::prepare || block == BlockOnTable::unknown) return true;
    return block == (cell.job.ticket.part > 1 ? BlockOnTable::used : BlockOnTable::fresh);
}

void pass_pending(CellState& cell, CellTime now, const CellHooks& hooks) {
    if (!cell.pending) return;
    if (cell.pending->waits == Pending::Waits::consent && cell.limits.consent != Consent::ask) {
        const bool yes = cell.limits.consent == Consent::automatic && is_block_right(cell);
        return consent_given(cell, cell.pending->number, yes, now, hooks);
    }
    if (cell.pending->waits != Pending::Waits::rehearsal || now.steady_ms < cell.pending->due_ms) return;
    if (const auto fault = unfit_job(cell)) {
        cell.job.result = JobResult::rehearsal_failed;
        settle(cell, fault->result, fault->detail);
    } else {
        cell.job.result = JobResult::rehearsal_passed;
        cell.job.receipt = random_number(cell);
        settle(cell, AckResult::ok, cell.job.receipt);
    }
}

// When the present state ends by itself. Precondition: it is an acting state.
std::int64_t state_ends_ms(const CellState& cell) {
    const auto after_ms = [&](double job_s) {
        return static_cast<std::int64_t>(std::ceil(1000 * job_s / cell.limits.speed));
    };
    const double run_s = cell.job.run_s;
    if (cell.state == PackState::execute) return cell.state_since_ms + after_ms(whole_run_s(cell) - run_s);
    const std::int64_t line_ms = is_stopping_at_line(cell, cell.state) ? after_ms(cell.job.stop_s - run_s) : 0;
    return cell.state_since_ms + std::max(cell.limits.acting_ms, line_ms);
}

// When a fault comes at a block, in seconds of the job. Nothing: the program does not come there any more.
std::optional<double> block_begins_s(const CellState& cell, std::int64_t block) {
    if (!cell.job.program.run) return std::max(cell.job.run_s, static_cast<double>(block) / blocks_per_s);
    return begin_of_block(*cell.job.program.run, static_cast<std::uint32_t>(block), cell.job.run_s);
}

// The same of the next line that waits for an input; 0: for any.
std::optional<double> waits_at_s(const CellState& cell, std::int64_t input) {
    if (!cell.job.program.run) return std::nullopt;
    for (const RunWait& wait : cell.job.program.run->waits) {
        if (wait.at_s >= cell.job.run_s && (input == 0 || wait.input == input)) return wait.at_s;
    }
    return std::nullopt;
}

// The alarm that a fault raises in this job, if it comes before Execute ends at `ends_ms`, and when.
struct DueAlarm {
    Fault fault = Fault::count;
    std::int64_t at_ms = 0;
};
std::optional<DueAlarm> due_alarm(const CellState& cell, std::int64_t ends_ms) {
    std::optional<DueAlarm> first;
    if (cell.state != PackState::execute || !cell.job.is_active()) return first;
    for (const Fault fault : {Fault::tool_fault, Fault::e_stop_at, Fault::spindle_loses_speed, Fault::signal_falls}) {
        const auto number = armed(cell.faults, fault);
        if (!number) continue;
        const std::optional<double> at_s =
            fault == Fault::signal_falls ? waits_at_s(cell, *number) : block_begins_s(cell, *number);
        if (!at_s) continue;
        const double left_s = *at_s - cell.job.run_s;
        const auto at_ms =
            cell.state_since_ms + static_cast<std::int64_t>(std::ceil(1000 * left_s / cell.limits.speed));
        if (at_ms < ends_ms && (!first || at_ms < first->at_ms)) first = DueAlarm{fault, at_ms};
    }
    return first;
}

void raise_due(CellState& cell, DueAlarm due, CellTime now, const CellHooks& hooks) {
    const auto number = take(cell.faults, due.fault);
    if (!number) return;
    now.steady_ms = due.at_ms;
    if (due.fault == Fault::signal_falls) return miss_input(cell, static_cast<std::uint32_t>(*number), now, hooks);
    if (due.fault == Fault::spindle_loses_speed) return lose_spindle_speed(cell, now, hooks);
    if (due.fault == Fault::e_stop_at) return press_e_stop(cell, true, now, hooks);
    set_tool_broken(cell, true, now, hooks);
}

void pass_motion(CellState& cell, CellTime now, const CellHooks& hooks) {
    for (;;) {
        const PackState next = after_done(cell.state);
        if (next == PackState::undefined) return;
        const std::int64_t ends_ms = state_ends_ms(cell);
        if (const auto due = due_alarm(cell, ends_ms); due && now.steady_ms >= due->at_ms) {
            raise_due(cell, *due, now, hooks);
            continue;
        }
        if (now.steady_ms < ends_ms) return;
        const bool was_active = cell.job.is_active();
        enter_state(cell, next, ends_ms);
        if (next == PackState::stopped) cell.alarm = {};
        if (was_active && next == PackState::complete) {
            end_job(cell, JobState::ended, cell.job.cut_short ? JobResult::stopped : JobResult::complete, now, hooks);
        }
        if (was_active && next == PackState::stopped) end_job(cell, JobState::aborted, JobResult::stopped, now, hooks);
    }
}

}  // namespace
}  // namespace cell

void pass_time(CellState& cell, CellTime now, const CellHooks& hooks) {
    cell::pass_motion(cell, now, hooks);
    cell::pass_lease(cell, now, hooks);
    cell::pass_token(cell, now, hooks);
    cell::pass_pending(cell, now, hooks);
}

void consent_given(CellState& cell, std::uint64_t number, bool yes, CellTime now, const CellHooks& hooks) {
    if (!cell.pending || cell.pending->number != number || cell.pending->waits != Pending::Waits::consent) return;
    const CellCommand command = cell.pending->command;
    cell::log(cell, hooks, std::string("consent to ") + name(command) + (yes ? " given" : " refused"));
    if (!cell.surroundings.is_safe()) return cell::settle(cell, AckResult::safety_open);
    if (!yes || take(cell.faults, Fault::no_consent)) return cell::settle(cell, AckResult::no_consent);
    const Transition to = transition(cell.state, command);
    const bool is_stored = command != CellCommand::prepare || cell.job.state == JobState::stored;
    if (to.kind == TransitionKind::refused || to.kind == TransitionKind::already || !is_stored) {
        return cell::settle(cell, AckResult::wrong_state);
    }
    if (to.kind == TransitionKind::moves) {
        cell::enter_state(cell, to.to, now.steady_ms);
    } else {
        cell.job.state = JobState::prepared;
        cell.job.token = cell::random_number(cell);
        cell.job.token_until_ms = now.steady_ms + cell::token_ms;
        cell.consent_present = true;
    }
    cell::settle(cell, AckResult::ok);
    if (take(cell.faults, Fault::door_after_consent)) open_door(cell, true, now, hooks);
}

void file_checked(CellState& cell, std::uint64_t number, const FileCheck& check, CellTime now, const CellHooks& hooks) {
    if (!cell.pending || cell.pending->number != number || cell.pending->waits != Pending::Waits::file) return;
    pass_time(cell, now, hooks);
    if (!cell.pending || cell.pending->number != number) return;
    const WireTicket& ticket = cell.job.ticket;
    AckResult result = AckResult::ok;
    if (check.end == FileCheck::End::missing)
        result = AckResult::file_missing;
    else if (check.end == FileCheck::End::io_error)
        result = AckResult::store_io;
    else if (check.size != ticket.file_size)
        result = AckResult::file_size;
    else if (check.sha256 != ticket.file_sha256)
        result = AckResult::hash_mismatch;
    cell.job.stored_sha256 = check.end == FileCheck::End::ok ? check.sha256 : Sha256{};
    cell.job.program = result == AckResult::ok ? check.program : ReceivedProgram{};
    cell.job.transfer = result == AckResult::ok             ? TransferState::complete
                        : result == AckResult::file_missing ? TransferState::idle
                                                            : TransferState::hash_mismatch;
    // A wrong file that was received in chunks must be sent again from the beginning.
    if (result != AckResult::ok && ticket.transfer == Transfer::chunks) {
        cell.job.chunks.clear();
        cell.job.transfer = TransferState::open;
    }
    cell::log(cell, hooks, std::string("VERIFY ") + ticket.file_name + ": " + name(result));
    if (!cell.job.program.fault.empty()) {
        cell::log(cell, hooks, "the program of " + ticket.file_name + " cannot be executed: " + cell.job.program.fault);
    }
    cell::settle(cell, result);
}

}  // namespace qchopper
