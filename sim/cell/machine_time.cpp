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

double run_so_far_s(const CellState& cell, CellTime now) {
    const double whole_s = cell.job.ticket.estimated_time_s;
    if (cell.state != PackState::execute || !cell.job.is_active()) return cell.job.run_s;
    const double here_s = static_cast<double>(now.steady_ms - cell.state_since_ms) / 1000 * cell.limits.speed;
    return std::min(whole_s, cell.job.run_s + std::max(0.0, here_s));
}

void enter_state(CellState& cell, PackState to, std::int64_t at_ms) {
    if (cell.state == PackState::execute) cell.job.run_s = run_so_far_s(cell, {at_ms, 0});
    assert(to != PackState::undefined);
    cell.state_before = cell.state;
    cell.state = to;
    cell.state_since_ms = at_ms;
    if (!cell.job.is_active()) return;
    const bool is_running = to == PackState::starting || to == PackState::execute || to == PackState::completing;
    cell.job.state = is_running ? JobState::running : JobState::interrupted;
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
    record.last_block = blocks_so_far(cell, now);
    if (cell.surroundings.block == BlockOnTable::fresh) cell.surroundings.block = BlockOnTable::used;
    if (!save(cell, cell.memory, hooks)) cell.warning = true;
    log(cell, hooks, "job " + to_text(cell.job.ticket.job_id) + " " + name(state) + ": " + name(result));
}

std::uint32_t blocks_so_far(const CellState& cell, CellTime now) {
    return static_cast<std::uint32_t>(std::floor(blocks_per_s * run_so_far_s(cell, now)));
}

void raise_alarm(CellState& cell, const CellAlarm& alarm, JobResult result, CellTime now, const CellHooks& hooks) {
    if (cell.alarm.code == 0) {
        cell.alarm = alarm;
        cell.alarm.block = cell.job.is_active() ? blocks_so_far(cell, now) : 0;
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
    if (const auto fault = does_not_fit(cell.job.ticket, cell.limits)) {
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
    if (cell.state != PackState::execute) return cell.state_since_ms + cell.limits.acting_ms;
    const double left_s = cell.job.ticket.estimated_time_s - cell.job.run_s;
    return cell.state_since_ms + static_cast<std::int64_t>(std::ceil(1000 * left_s / cell.limits.speed));
}

// The alarm that a fault raises in this job, if it comes before Execute ends at `ends_ms`, and when.
struct DueAlarm {
    Fault fault = Fault::count;
    std::int64_t at_ms = 0;
};
std::optional<DueAlarm> due_alarm(const CellState& cell, std::int64_t ends_ms) {
    std::optional<DueAlarm> first;
    if (cell.state != PackState::execute || !cell.job.is_active()) return first;
    for (const Fault fault : {Fault::tool_fault, Fault::e_stop_at}) {
        const auto block = armed(cell.faults, fault);
        if (!block) continue;
        const double left_s = std::max(0.0, static_cast<double>(*block) / blocks_per_s - cell.job.run_s);
        const auto at_ms =
            cell.state_since_ms + static_cast<std::int64_t>(std::ceil(1000 * left_s / cell.limits.speed));
        if (at_ms < ends_ms && (!first || at_ms < first->at_ms)) first = DueAlarm{fault, at_ms};
    }
    return first;
}

void raise_due(CellState& cell, DueAlarm due, CellTime now, const CellHooks& hooks) {
    if (!take(cell.faults, due.fault)) return;
    now.steady_ms = due.at_ms;
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
    cell.job.transfer = result == AckResult::ok             ? TransferState::complete
                        : result == AckResult::file_missing ? TransferState::idle
                                                            : TransferState::hash_mismatch;
    // A wrong file that was received in chunks must be sent again from the beginning.
    if (result != AckResult::ok && ticket.transfer == Transfer::chunks) {
        cell.job.chunks.clear();
        cell.job.transfer = TransferState::open;
    }
    cell::log(cell, hooks, std::string("VERIFY ") + ticket.file_name + ": " + name(result));
    cell::settle(cell, result);
}

}  // namespace qchopper
