// The commands of the simulated controller. Checked first: frame, repetition, owner, command, lease.
//
// CLAIM grants a lease (C. Gray, D. Cheriton: Leases: An Efficient Fault-Tolerant Mechanism for Distributed File Cache
// Consistency, 1989) with a fencing number, the epoch; heartbeats extend it. A start is written to the memory before
// the machine moves. O(owners kept), at most 256; CLAIM, CANCEL and Start copy the memory and QUERY_FILE
// searches it: O(jobs kept).

#include <algorithm>
#include <cassert>
#include <utility>

#include "sim/cell/machine_parts.h"
#include "sim/cell/signature_check.h"
#include "sim/cell/ticket_check.h"

namespace qchopper {
namespace cell {
namespace {

using Answer = CommandAnswer;
using enum AckResult;

constexpr Uuid any_job = [] {
    Uuid ones{};
    ones.fill(0xFF);
    return ones;
}();

// At most one line a minute: anybody on the network can send such commands, as fast as the link takes them.
void count_bad_frame(CellState& cell, AckResult reason, CellTime now, const CellHooks& hooks) {
    constexpr std::int64_t line_ms = 60000;
    ++cell.bad_frames;
    cell.bad_reason = reason;
    ++cell.untold_bad_frames;
    if (cell.bad_frame_told_ms && now.steady_ms - *cell.bad_frame_told_ms < line_ms) return;
    const std::uint64_t before = cell.untold_bad_frames - 1;
    log(cell, hooks,
        std::string("a command that cannot be trusted: ") + name(reason) +
            (before == 0 ? "" : ", and " + std::to_string(before) + " before it since the last such line"));
    cell.bad_frame_told_ms = now.steady_ms;
    cell.untold_bad_frames = 0;
}

AckResult reason_of(BlockFault fault) {
    if (fault == BlockFault::magic) return bad_magic;
    return fault == BlockFault::version ? bad_version : bad_crc;
}

bool is_known(CellCommand command) {
    return std::find(all_commands.begin(), all_commands.end(), command) != all_commands.end();
}

bool needs_lease(CellCommand command) {
    return command != CellCommand::query && command != CellCommand::query_file && command != CellCommand::stop &&
           command != CellCommand::hold && command != CellCommand::abort;
}

bool is_current(const CellState& cell, const Uuid& id) {
    return cell.job.state != JobState::none && cell.job.ticket.job_id == id;
}

bool is_refused(const CellState& cell, CellCommand command) {
    return transition(cell.state, command).kind == TransitionKind::refused;
}

// What the state of the machine and its surroundings refuse; OK if nothing.
AckResult refused_here(const CellState& cell, CellCommand command) {
    if (cell.surroundings.local_control) return local_control;
    if (is_refused(cell, command)) return wrong_state;
    const bool moves_later = command == CellCommand::prepare || command == CellCommand::start ||
                             command == CellCommand::unhold || command == CellCommand::unsuspend ||
                             command == CellCommand::clear;
    return moves_later && !cell.surroundings.is_safe() ? safety_open : ok;
}

// The result for a job that is not the current one.
AckResult not_current(const CellState& cell, const Uuid& id) {
    const auto known = cell.memory.jobs.find(id);
    if (known == cell.memory.jobs.end()) return cell.job.state == JobState::none ? unknown_job : wrong_job;
    return known->second.state == JobState::cancelled ? cancelled : already_finished;
}

Answer wait_for(CellState& cell, const Command& command, Pending::Waits waits, CellTime now,
                const std::string& question) {
    Pending next{++cell.pending_count, waits, command.command, command.owner, command.seq, question, 0};
    next.due_ms = now.steady_ms + 5 * cell.limits.acting_ms;
    // The same command again does not ask a second time: only the acknowledgement to complete is another.
    if (cell.pending && cell.pending->command == command.command) {
        next.number = cell.pending->number;
        next.due_ms = cell.pending->due_ms;
    }
    cell.pending = next;
    return {pending};
}

// False: it could not be written, and the memory is as before.
bool replace_memory(CellState& cell, CellMemory next, const CellHooks& hooks) {
    const bool is_saved = save(cell, next, hooks);
    if (is_saved) cell.memory = std::move(next);
    return is_saved;
}

Answer claim(CellState& cell, const Command& command, CellTime now, const CellHooks& hooks) {
    if (command.epoch <= cell.memory.epoch_held) return {stale_epoch, cell.memory.epoch_held};
    // A number far ahead would leave few numbers for later CLAIMs.
    if (command.epoch - cell.memory.epoch_held > max_epoch_jump) return {epoch_jump, cell.memory.epoch_held};
    if (cell.lease) {
        const bool is_same = cell.lease->owner == command.owner && cell.lease->secret == command.arg1;
        const bool has_code = cell.limits.takeover_code != 0 && command.arg0 == cell.limits.takeover_code;
        if (!is_same && !has_code) return {lease_busy, cell.lease->owner};
    }
    CellMemory next = cell.memory;
    next.epoch_held = command.epoch;
    const std::uint32_t grant = random_number(cell);
    next.grants[grant] = command.epoch;
    if (!replace_memory(cell, std::move(next), hooks)) return {store_io};
    drop_preparation(cell, stale_epoch);
    cell.lease = Lease{command.owner, command.arg1, now.steady_ms + lease_ms, now.steady_ms, std::nullopt};
    cell.watchdog_expired = false;
    return {ok, grant};
}

Answer release(CellState& cell) {
    drop_preparation(cell, cancelled);
    cell.lease.reset();
    cell.watchdog_expired = false;
    return {};
}

// Reset, Stop, Hold, Unhold, Suspend, Unsuspend, Abort, Clear, Complete.
Answer machine_command(CellState& cell, const Command& command, CellTime now, const CellHooks& hooks) {
    const CellCommand what = command.command;
    if (what == CellCommand::reset || what == CellCommand::clear) {
        if (command.job_id != Uuid{}) return {wrong_job};
    } else if (what == CellCommand::abort) {
        if (command.job_id != any_job && !is_current(cell, command.job_id)) return {wrong_job};
    } else {
        if (!cell.job.is_active()) return {wrong_state};
        if (!is_current(cell, command.job_id)) return {wrong_job};
    }
    const Transition to = transition(cell.state, what);
    if (to.kind == TransitionKind::already) return {already};
    if (const AckResult why = refused_here(cell, what); why != ok) return {why};
    if (what == CellCommand::unhold || what == CellCommand::clear) {
        if (cell.pending && cell.pending->command != what) return {wrong_state};
        return wait_for(cell, command, Pending::Waits::consent, now,
                        what == CellCommand::clear
                            ? "The machine is aborted. Is the cell safe, and may it be cleared?"
                            : "Job " + cell.job.ticket.file_name + " is held. May it go on: is the area clear?");
    }
    if (what == CellCommand::complete) cell.job.cut_short = true;
    enter_state(cell, to.to, now.steady_ms);
    if (what == CellCommand::abort) {
        drop_preparation(cell, wrong_state);
        if (cell.job.is_active()) end_job(cell, JobState::aborted, JobResult::aborted, now, hooks);
    }
    return {};
}

Answer query(CellState& cell, const Command& command) {
    const auto known = cell.memory.jobs.find(command.job_id);
    const JobRecord record = known == cell.memory.jobs.end() ? JobRecord{} : known->second;
    ResultRecord answer{record, command.job_id, command.seq, command.owner};
    const auto grant = cell.memory.grants.find(command.arg0);
    if (grant != cell.memory.grants.end()) answer.grant_epoch = grant->second;
    if (is_current(cell, command.job_id)) {
        answer.state = cell.job.state;
        answer.result = cell.job.result;
        answer.file_sha256 = cell.job.stored_sha256;
    }
    cell.answer = answer;
    cell.has_answer = true;
    return {answer.state == JobState::none ? unknown_job : ok};
}

// The later of two starts. The time of day may have jumped: epochs rise, and so do the numbers of one owner in an
// epoch.
bool is_later(const JobRecord& one, const JobRecord& other) {
    return std::pair(one.start_epoch, one.start_seq) > std::pair(other.start_epoch, other.start_seq);
}

Answer query_file(CellState& cell, const Command& command) {
    if (command.job_id != Uuid{}) return {wrong_job};
    const std::pair<const Uuid, JobRecord>* last = nullptr;
    std::uint32_t count = 0;
    for (const auto& job : cell.memory.jobs) {
        if (job.second.starts == 0 || job.second.file_sha256 != command.file_sha256) continue;
        ++count;
        if (last == nullptr || is_later(job.second, last->second)) last = &job;
    }
    cell.answer = {last == nullptr ? JobRecord{} : last->second, last == nullptr ? Uuid{} : last->first, command.seq,
                   command.owner};
    if (last != nullptr && is_current(cell, last->first)) cell.answer.state = cell.job.state;
    cell.has_answer = true;
    return {last == nullptr ? unknown_job : ok, count};
}

Answer set_mode(CellState& cell, const Command& command) {
    if (command.job_id != Uuid{}) return {wrong_job};
    if (command.arg0 == static_cast<std::uint32_t>(cell.mode)) return {already};
    const bool is_settable = command.arg0 >= 1 && command.arg0 <= 3 && cell.mode != UnitMode::rehearsal;
    if (!is_settable) return {wrong_mode};
    if (const AckResult why = refused_here(cell, command.command); why != ok) return {why};
    drop_preparation(cell, wrong_mode);
    cell.mode = static_cast<UnitMode>(command.arg0);
    return {};
}

Answer store(CellState& cell, const Command& command, const CellHooks& hooks) {
    if (cell.ticket_draft.empty()) return {no_ticket};
    const Decoded<WireTicket> ticket = decode<WireTicket>(cell.ticket_draft);
    if (!ticket.is_ok()) return {ticket_crc};
    const Uuid& id = ticket.value.job_id;
    if (id == Uuid{} || command.job_id != id) return {ticket_field, address_of(ticket_block, "JOB_ID")};
    const auto known = cell.memory.jobs.find(id);
    if (known != cell.memory.jobs.end()) {
        return {known->second.state == JobState::cancelled ? cancelled : job_id_reused};
    }
    if (is_current(cell, id)) {
        const bool is_same = cell.job.ticket_block == cell.ticket_draft;
        return {is_same ? already : job_id_reused};
    }
    if (cell.job.state != JobState::none) return {busy_other_job, static_cast<std::uint32_t>(cell.job.state)};
    if (cell.mode != UnitMode::production) return {wrong_mode};
    if (const AckResult why = refused_here(cell, command.command); why != ok) return {why};
    if (const auto fault = wrong_signature(cell.ticket_draft, cell.signature_draft, cell.limits, hooks)) return *fault;
    if (const auto fault = wrong_field(ticket.value, cell.ticket_draft, cell.limits)) return *fault;
    if (command.file_sha256 != ticket.value.file_sha256) return {hash_mismatch};
    const bool is_chunks = ticket.value.transfer == Transfer::chunks;
    if (is_chunks && ticket.value.file_size > cell.limits.max_chunk_file)
        return {store_full, address_of(ticket_block, "FILE_SIZE")};
    if (hooks.remove_old_copies) {
        cell.store_free_kib = hooks.remove_old_copies(cell.memory, ticket.value.file_size + 1024ULL);
    }
    if (take(cell.faults, Fault::store_full) || ticket.value.file_size / 1024 >= cell.store_free_kib)
        return {store_full, address_of(ticket_block, "FILE_SIZE")};
    cell.job = CellJob{};
    cell.job.ticket = ticket.value;
    cell.job.ticket_block = cell.ticket_draft;
    cell.job.signature = cell.signature_draft;
    cell.job.state = JobState::stored;
    cell.job.transfer = is_chunks ? TransferState::open : TransferState::idle;
    cell.transfer_result = none;
    log(cell, hooks,
        "job " + to_text(id) + " stored: " + ticket.value.file_name +
            (cell.job.signature.empty() ? " (unsigned)"
             : hooks.trusted_keys       ? ""
                                        : " (its signature is not checked: this cell has no list of keys)"));
    return {};
}

Answer cancel(CellState& cell, const Command& command, const CellHooks& hooks) {
    if (!is_current(cell, command.job_id)) {
        const AckResult known = not_current(cell, command.job_id);
        return {known == cancelled ? already : known == wrong_job ? unknown_job : known, 0};
    }
    if (cell.job.is_finished()) return {already_finished};
    if (is_refused(cell, command.command) || !cell.job.is_waiting()) return {wrong_state};
    CellMemory next = cell.memory;
    next.jobs[command.job_id].state = JobState::cancelled;
    if (!replace_memory(cell, std::move(next), hooks)) return {store_io};
    drop_preparation(cell, cancelled);
    if (cell.pending) settle(cell, cancelled);
    cell.job = CellJob{};
    log(cell, hooks, "job " + to_text(command.job_id) + " cancelled");
    return {};
}

Answer clear_result(CellState& cell, const Command& command) {
    if (!is_current(cell, command.job_id)) {
        const AckResult known = not_current(cell, command.job_id);
        return {known == already_finished || known == cancelled ? already : unknown_job};
    }
    if (!cell.job.is_finished() || is_refused(cell, command.command)) return {wrong_state};
    cell.job = CellJob{};
    return {};
}

// A key may have been revoked since STORE.
std::optional<Answer> wrong_signature_now(const CellState& cell, const CellHooks& hooks) {
    return wrong_signature(cell.job.ticket_block, cell.job.signature, cell.limits, hooks);
}

// The conditions that VERIFY, REHEARSE and PREPARE have in common.
Answer check_stored_job(const CellState& cell, const Command& command) {
    if (!is_current(cell, command.job_id)) return {not_current(cell, command.job_id), 0};
    if (cell.job.is_finished()) return {already_finished};
    if (cell.job.state == JobState::prepared && command.command != CellCommand::rehearse) return {already};
    if (cell.mode != UnitMode::production && !(cell.pending && cell.pending->command == command.command)) {
        return {wrong_mode};
    }
    if (const AckResult why = refused_here(cell, command.command); why != ok) return {why};
    if (cell.job.state != JobState::stored) return {wrong_state};
    if (cell.pending && cell.pending->command != command.command) return {wrong_state};
    if (command.file_sha256 != cell.job.ticket.file_sha256) return {hash_mismatch};
    const bool has_file = cell.job.transfer == TransferState::complete;
    if (command.command != CellCommand::verify && !has_file) return {file_missing};
    return {};
}

std::string consent_question(const CellState& cell) {
    const WireTicket& ticket = cell.job.ticket;
    const auto of = [](unsigned k, unsigned n) { return std::to_string(k) + " of " + std::to_string(n); };
    std::string question = "Job " + ticket.file_name + " (piece " + of(ticket.piece_no, ticket.piece_count);
    if (ticket.parts > 0) question += ", part " + of(ticket.part, ticket.parts);
    question += ticket.is_restart() ? "): have the chunks before it ended, and is it the same block, not moved"
                : ticket.part > 1   ? "): is it the same block, not moved since part " + std::to_string(ticket.part - 1)
                                    : std::string("): is the block loaded");
    question += ", and is the area clear?";
    const auto carved = std::count_if(cell.memory.jobs.begin(), cell.memory.jobs.end(), [&](const auto& job) {
        return job.second.starts > 0 && job.second.file_sha256 == ticket.file_sha256;
    });
    if (carved > 0) question += " This file was started " + std::to_string(carved) + " times before.";
    return question;
}

Answer prepare(CellState& cell, const Command& command, CellTime now, const CellHooks& hooks) {
    const WireTicket& ticket = cell.job.ticket;
    if (const auto fault = wrong_signature_now(cell, hooks)) return *fault;
    const bool needs_receipt = (ticket.requirements & 1U) != 0 || command.arg0 != 0;
    if (needs_receipt && (cell.job.receipt == 0 || command.arg0 != cell.job.receipt)) return {rehearsal_required};
    if (const auto fault = unfit_job(cell)) return *fault;
    if (cell.surroundings.tool_broken) return {tool, address_of(ticket_block, "TOOL_NO")};
    return wait_for(cell, command, Pending::Waits::consent, now, consent_question(cell));
}

Answer start_job(CellState& cell, const Command& command, CellTime now, const CellHooks& hooks) {
    CellJob& job = cell.job;
    if (!is_current(cell, command.job_id)) return {not_current(cell, command.job_id), 0};
    if (job.is_active()) return {already};
    if (job.is_finished()) return {already_finished};
    if (cell.mode != UnitMode::production) return {wrong_mode};
    const Transition to = transition(cell.state, CellCommand::start);
    if (to.kind != TransitionKind::moves) return {wrong_state};
    if (const AckResult why = refused_here(cell, command.command); why != ok) return {why};
    if (job.state != JobState::prepared || command.token != job.token) {
        const bool is_expired = command.token != 0 && command.token == job.expired_token;
        return {is_expired ? token_expired : token_bad};
    }
    if (command.file_sha256 != job.ticket.file_sha256) return {hash_mismatch};
    if (cell.memory.jobs.count(command.job_id) != 0) return {job_id_reused};
    if (const auto fault = wrong_signature_now(cell, hooks)) return *fault;
    CellMemory next = cell.memory;
    JobRecord& record = next.jobs[command.job_id];
    record.state = JobState::running;
    record.starts = 1;
    record.start_epoch = command.epoch;
    record.start_seq = command.seq;
    record.start_time_ms = unix_ms(cell, now);
    record.file_sha256 = job.stored_sha256;
    ++next.starts_total;
    assert(next.jobs.size() == cell.memory.jobs.size() + 1 && record.starts == 1);
    if (!replace_memory(cell, std::move(next), hooks)) return {store_io};  // before anything moves
    job.token = 0;
    job.state = JobState::running;
    job.result = JobResult::none;
    enter_state(cell, to.to, now.steady_ms);
    log(cell, hooks, "job " + to_text(command.job_id) + " STARTED");
    return {};
}

Answer job_command(CellState& cell, const Command& command, CellTime now, const CellHooks& hooks) {
    const CellCommand what = command.command;
    if (what == CellCommand::release) return release(cell);
    if (what == CellCommand::store) return store(cell, command, hooks);
    if (what == CellCommand::cancel) return cancel(cell, command, hooks);
    if (what == CellCommand::query) return query(cell, command);
    if (what == CellCommand::query_file) return query_file(cell, command);
    if (what == CellCommand::clear_result) return clear_result(cell, command);
    if (what == CellCommand::set_mode) return set_mode(cell, command);
    const Answer fitness = check_stored_job(cell, command);
    if (fitness.result != ok) return fitness;
    if (what == CellCommand::prepare) return prepare(cell, command, now, hooks);
    if (what == CellCommand::verify) {
        const bool is_partial = cell.job.chunks.size() < cell.job.ticket.file_size;
        if (cell.job.ticket.transfer == Transfer::chunks && is_partial) return {file_missing};
        return wait_for(cell, command, Pending::Waits::file, now, {});
    }
    cell.mode = UnitMode::rehearsal;
    return wait_for(cell, command, Pending::Waits::rehearsal, now, {});
}

Answer execute(CellState& cell, const Command& command, CellTime now, const CellHooks& hooks) {
    if (command.owner == 0) return {not_owner};
    if (!is_known(command.command)) return {unknown_cmd};
    if (command.command == CellCommand::claim) return claim(cell, command, now, hooks);
    if (needs_lease(command.command)) {
        if (command.epoch < cell.memory.epoch_held) return {stale_epoch, cell.memory.epoch_held};
        if (!holds_lease(cell, command.owner, command.epoch)) return {not_owner};
    }
    if (command.command == CellCommand::start) return start_job(cell, command, now, hooks);
    if (static_cast<std::uint16_t>(command.command) >= static_cast<std::uint16_t>(CellCommand::claim)) {
        return job_command(cell, command, now, hooks);
    }
    return machine_command(cell, command, now, hooks);
}

void keep_acknowledgement(CellState& cell, const Acknowledgement& ack) {
    std::erase_if(cell.senders, [&](const Acknowledgement& old) { return old.owner == ack.owner; });
    cell.senders.push_back(ack);
    assert(cell.senders.size() <= max_senders + 1);
    if (cell.senders.size() > max_senders) {
        // The oldest, but never that of the lease holder: it may have to be repeated.
        const bool first_holds = cell.lease && cell.senders.front().owner == cell.lease->owner;
        cell.senders.erase(cell.senders.begin() + (first_holds ? 1 : 0));
    }
}

}  // namespace
}  // namespace cell

void receive_command(CellState& cell, std::span<const std::uint16_t> block, CellTime now, const CellHooks& hooks) {
    pass_time(cell, now, hooks);
    const Decoded<Command> decoded = decode<Command>(block);
    if (decoded.fault == BlockFault::empty || decoded.fault == BlockFault::length) return;
    if (!decoded.is_ok()) return cell::count_bad_frame(cell, cell::reason_of(decoded.fault), now, hooks);
    const Command& command = decoded.value;
    const std::uint32_t crc = command_crc(block);
    if (command.seq == 0) return cell::count_bad_frame(cell, AckResult::stale_seq, now, hooks);
    for (const Acknowledgement& last : cell.senders) {
        if (last.owner != command.owner || command.seq > last.seq) continue;
        if (command.seq < last.seq || crc != last.crc)
            return cell::count_bad_frame(cell, AckResult::stale_seq, now, hooks);
        cell.ack = last;
        return;
    }
    // What a later version of the map asks for there is not done by half.
    const std::optional<std::uint16_t> used = used_reserved<Command>(block);
    const cell::Answer answer =
        used ? cell::Answer{AckResult::unknown_cmd, *used} : cell::execute(cell, command, now, hooks);
    const Acknowledgement ack{command.owner, command.seq, crc, command.command, answer.result, answer.detail};
    cell::keep_acknowledgement(cell, ack);
    cell.ack = ack;
    if (!is_refusal(answer.result) && cell::holds_lease(cell, command.owner, command.epoch)) {
        cell.lease->until_ms = now.steady_ms + cell::lease_ms;
    }
    cell::log(cell, hooks, std::string(name(command.command)) + ": " + name(answer.result));
}

}  // namespace qchopper
