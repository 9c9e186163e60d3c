// What each step of the hand-off does, and which step follows. Most steps are one row of a table.
//
// Chunks go out in windows of 16; XFER_NEXT of the cell then states where the next window begins (go-back-N). O(1) for
// each turn, and O(bytes / 232) turns for a file in chunks.

#include <algorithm>

#include "devices/hand_off/hand_off.h"
#include "devices/hand_off/hand_off_context.h"
#include "devices/hand_off/operator_text.h"

namespace qchopper::hand_off {
namespace {

// The steps that are one command: whether it names our job, and the next step after its acknowledgement.
struct StepRow {
    HandOffStep step;
    CellCommand command;
    bool names_job;
    HandOffStep next;
    const char* message;  // after its acknowledgement; "" for none
};
using enum HandOffStep;
constexpr StepRow step_rows[] = {
    {claim, CellCommand::claim, false, ask_before, "the cell is claimed"},
    {ask_before, CellCommand::query, true, make_ready, ""},
    {ask_file, CellCommand::query_file, false, make_ready, ""},
    {store, CellCommand::store, true, deliver, "the cell has accepted the ticket"},
    {verify, CellCommand::verify, true, prepare, "the cell has the job file, and it is the right one (SHA-256)"},
    {rehearse, CellCommand::rehearse, true, prepare, "the rehearsal in the cell has passed"},
    {prepare, CellCommand::prepare, true, start, "the operator at the cell has consented"},
    {start, CellCommand::start, true, run, ""},
    {ask_after, CellCommand::query, true, clear_result, ""},
    {clear_result, CellCommand::clear_result, true, reset, ""},
    {reset, CellCommand::reset, false, release, ""},
    {cancel, CellCommand::cancel, true, release, "the cell has dropped the job"},
    {release, CellCommand::release, false, finished, ""},
};

const StepRow* row_of(HandOffStep step) {
    const auto* row = std::find_if(std::begin(step_rows), std::end(step_rows),
                                   [step](const StepRow& one) { return one.step == step; });
    return row == std::end(step_rows) ? nullptr : row;
}

HandOffAction send_step(StepContext& context, const StepRow& row) {
    HandOff& h = context.h;
    h.command = Command{};
    if (row.names_job) {
        h.command.job_id = context.job_id();
        h.command.file_sha256 = context.plan.ticket.file_sha256;
    }
    switch (row.step) {
        case ask_before:
        case ask_after:
            h.command.arg0 = h.grant;
            break;
        case ask_file:
            h.command.file_sha256 = context.plan.ticket.file_sha256;
            break;
        case store:
            h.is_stored = true;
            break;
        case prepare:
            h.command.arg0 = h.receipt;
            break;
        case start:
            h.command.token = context.status().token;
            h.start_sent = true;
            h.start_boots = context.status().boot_count;
            break;
        default:
            break;
    }
    return send(context, row.command);
}

// After the end of the job: Reset and RELEASE. Nothing here changes the verdict.
HandOffAction end_hand_off(StepContext& context) {
    const Status& status = context.status();
    switch (context.h.step) {
        case reset:
            if (!context.h.reset_sent && (status.state == PackState::stopped || status.state == PackState::complete)) {
                context.h.reset_sent = true;
                return send_step(context, *row_of(reset));
            }
            if (status.state == PackState::resetting &&
                context.now_s - context.h.step_since_s < context.timings().answer_s) {
                return pause(context);
            }
            return enter(context, release);
        case release:
            if (context.h.claim_sent) return send_step(context, *row_of(release));
            [[fallthrough]];
        default:
            return give_up(context, "the hand-off is over");
    }
}

// The cell has another job. Its dispatcher has lost the lease, because CLAIM was granted.
HandOffAction clear_other_job(StepContext& context) {
    const Status& status = context.status();
    if (is_over(status.job_state) || status.job_state == JobState::cancelled) {
        context.report("the cell still shows the end of job " + to_text(status.job_id) + " (" +
                       name(status.job_result) + "); it is cleared from STATUS, the cell keeps its record");
        return send_new(context, CellCommand::clear_result, status.job_id);
    }
    if (status.job_state == JobState::stored || status.job_state == JobState::prepared) {
        context.report("the cell holds job " + to_text(status.job_id) +
                       " of another dispatcher without lease; it is cancelled");
        return send_new(context, CellCommand::cancel, status.job_id);
    }
    context.h.fault = DeviceFault::busy;
    return withdraw(
        context,
        "the cell has job " + to_text(status.job_id) + " of another dispatcher, which is " + name(status.job_state) +
            ": " + foam_in(status.state),
        Sentence::with_key("try_again_later", {context.plan.options.address}, "Try again when it has ended."));
}

}  // namespace

HandOffAction enter(StepContext& context, HandOffStep step) {
    HandOff& h = context.h;
    if (h.step != step) h.step_since_s = context.now_s;
    h.step = step;
    h.waits_for_ack = false;
    switch (step) {
        case stage_file:
            if (context.plan.ticket.transfer == Transfer::chunks || context.plan.adopts) return enter(context, claim);
            return plain(Kind::stage_file);
        case claim:
            return send_claim(context);
        case make_ready:
            // A decision to withdraw holds also after a lost link.
            if (!h.why.empty()) return enter(context, h.is_stored ? cancel : release);
            h.ready_commands = 0;
            return make_idle(context);
        case write_ticket:
            return plain(Kind::write_ticket);
        case write_signature:
            return plain(Kind::write_signature);
        case deliver:
            h.chunk_done = h.chunk_next = context.status().transfer_next;
            h.chunks_in_flight = 0;
            return send_file(context);
        case run:
            return watch(context);
        case reset:
        case release:
        case finished:
            return end_hand_off(context);
        default:
            return send_step(context, *row_of(step));
    }
}

HandOffAction check_identity(StepContext& context) {
    const Status& status = context.status();
    const DispatchOptions& options = context.plan.options;
    context.h.cell_heartbeat_s = context.now_s;
    if (status.cell_id != options.cell_id) {
        return fail(context, DeviceFault::refused,
                    "this is cell " + std::to_string(status.cell_id) + ", not cell " + std::to_string(options.cell_id) +
                        "; nothing was sent",
                    "Check the address, or the cell id in the cell file.");
    }
    if (status.has(flag::simulated) != options.want_simulated) {
        return fail(context, DeviceFault::refused,
                    options.want_simulated ? "a simulated cell was wanted, but this one is real; nothing was sent"
                                           : "a real cell was wanted, but this one is simulated; nothing was sent",
                    "Check the address.");
    }
    context.report("cell " + std::to_string(status.cell_id) + (status.has(flag::simulated) ? " (SIMULATED)" : "") +
                   " is in " + name(status.state));
    return plain(Kind::read_identity);
}

HandOffAction make_idle(StepContext& context) {
    HandOff& h = context.h;
    const Status& status = context.status();
    const bool foreign = status.job_id != Uuid{} && status.job_id != context.job_id();
    if (h.ready_commands > max_ready_commands) {
        h.fault = DeviceFault::busy;
        return withdraw(
            context,
            std::string("the cell acknowledges ") + name(h.command.command) + " and stays in " + name(status.state),
            "Look at the panel of the cell for a fault, then dispatch again.");
    }
    if (foreign) return clear_other_job(context);
    switch (status.state) {
        case PackState::idle:
            return enter(context, write_ticket);
        case PackState::stopped:
        case PackState::complete:
            return send_new(context, CellCommand::reset);
        case PackState::aborted:
            context.report("the machine is aborted; the operator at the cell must consent to clear it");
            return send_new(context, CellCommand::clear);
        default:
            break;
    }
    if (context.now_s - context.h.step_since_s > context.timings().answer_s) {
        context.h.fault = DeviceFault::busy;
        return withdraw(context, std::string("the cell stays in ") + name(status.state) + ": " + foam_in(status.state),
                        Sentence::with_key("wait_for_idle", {context.plan.options.address},
                                           "Look at the panel of the cell. Dispatch again when it is in Idle."));
    }
    return pause(context);
}

HandOffAction send_file(StepContext& context) {
    HandOff& h = context.h;
    constexpr int window = 16;
    if (context.plan.ticket.transfer == Transfer::drop_folder) return plain(Kind::put_file);
    const std::uint32_t size = context.plan.ticket.file_size;
    if (context.in.status && h.chunks_in_flight > 0) {
        // XFER_NEXT is where to go on, also if chunks before it were lost.
        const bool moved = context.status().transfer_next != h.chunk_done;
        h.chunks_in_flight = 0;
        h.chunk_done = h.chunk_next = context.status().transfer_next;
        if (h.chunk_next >= size) return enter(context, verify);
        if (moved) h.step_since_s = context.now_s;
        if (context.now_s - h.step_since_s > context.timings().answer_s) {
            return withdraw(
                context,
                std::string("the cell does not accept the job file: ") + describe(context.status().transfer_result),
                "Use a drop folder.");
        }
        if (!moved) return pause(context);
    }
    if (h.chunks_in_flight == window || h.chunk_next >= size) {
        h.chunks_in_flight = std::max(h.chunks_in_flight, 1);
        return plain(Kind::read_status);
    }
    HandOffAction action = plain(Kind::write_chunk);
    action.offset = h.chunk_next;
    h.chunk_next += std::min<std::uint32_t>(max_chunk_bytes, size - h.chunk_next);
    ++h.chunks_in_flight;
    return action;
}

HandOffAction watch(StepContext& context) {
    HandOff& h = context.h;
    const Status& status = context.status();
    const bool shows_it_running = context.shows_our_job() && has_started(status.job_state);
    if (context.shows_our_job() && !shows_it_running && !h.is_started) {
        // START was acknowledged: STATUS must show the job as started soon.
        if (context.is_leaving() || context.now_s - h.step_since_s <= context.timings().answer_s) return pause(context);
        return enter(context, ask_after);
    }
    if (!shows_it_running || is_over(status.job_state)) return enter(context, ask_after);
    h.odd_answers = 0;
    if (context.is_leaving() && !h.cancelled) return leave_running_job(context);
    constexpr double progress_period_s = 60;
    if (context.now_s - h.progress_s >= progress_period_s) {
        h.progress_s = context.now_s;
        context.keep(JournalKind::progress).progress = status.progress;
    }
    if (h.is_owner && status.owner_held == 0) {
        h.is_owner = h.claim_sent = false;
        context.report("the lease of the cell has run out; the job runs on");
    }
    return pause(context);
}

HandOffAction acknowledged(StepContext& context) {
    HandOff& h = context.h;
    h.waits_for_ack = false;
    h.step_since_s = context.now_s;
    switch (h.step) {
        case claim:
            h.is_owner = true;
            h.heartbeat_s = context.now_s;
            h.new_grant = context.status().ack_detail;
            break;
        case ask_before:
        case ask_file:
        case ask_after:
            return plain(Kind::read_result);
        case verify:
            if (context.status().file_sha256 != context.plan.ticket.file_sha256) {
                h.refusal = AckResult::hash_mismatch;
                return withdraw(context, "the cell has another file than the one that was sent", "Dispatch it again.");
            }
            if (context.plan.options.rehearse) {
                context.report(row_of(verify)->message);
                return enter(context, rehearse);
            }
            break;
        case rehearse:
            h.receipt = context.status().ack_detail;
            context.keep(JournalKind::receipt).receipt = h.receipt;
            break;
        case prepare:
            if (context.status().token != 0) break;
            if (++h.tokenless <= max_tokenless) return pause(context);
            return withdraw(context, "the cell acknowledges PREPARE and gives no token",
                            "Tell the integrator of the cell.");
        case start:
            h.start_acknowledged = true;
            break;
        case make_ready:
            ++h.ready_commands;
            return plain(Kind::read_status);
        case run:
            end_request(context, CommandEnd::done);
            return plain(Kind::read_status);
        case reset:
            return plain(Kind::read_status);
        default:
            break;
    }
    if (h.step == cancel || h.step == release) h.is_given_back = true;
    const StepRow& row = *row_of(h.step);
    if (row.message[0] != '\0') context.report(row.message);
    return enter(context, row.next);
}

HandOffAction refused(StepContext& context, AckResult result) {
    HandOff& h = context.h;
    h.waits_for_ack = false;
    const std::string answer = std::string(describe(result, context.status().ack_detail)) + " (" + name(result) + ")";
    if (h.step == ask_file && result == AckResult::unknown_job) return enter(context, make_ready);
    if (h.step == ask_before || h.step == ask_after) {
        if (result == AckResult::unknown_job) return plain(Kind::read_result);
    }
    // Damaged on the way, or another client has written a TICKET in between.
    const bool has_other_ticket = result == AckResult::ticket_crc || result == AckResult::no_ticket;
    if (h.step == store && has_other_ticket && ++h.tickets_lost <= max_tickets_lost)
        return enter(context, write_ticket);
    JournalEvent& event = context.keep(JournalKind::refused);
    event.command = h.command.command;
    event.refusal = result;
    if (h.step == cancel || h.step == release) h.is_given_back = true;  // also a refusal is an answer
    if (h.step == start && h.is_started && result != AckResult::already_finished) {
        return contradict(context, "it refused START, " + answer + ", and STATUS shows the job as started");
    }
    if (h.step == start && result == AckResult::already_finished) return enter(context, ask_after);
    if (h.step == start && context.status().boot_count != h.start_boots) {
        // The frame was repeated to a cell that has restarted: it may have executed it before.
        return fence(context, "the cell was restarted");
    }
    if (h.step == start) h.start_sent = false;  // a refused START has had no effect
    if (h.step == start) context.keep(JournalKind::start_void);
    if (h.step == run || h.step == make_ready || h.step == clear_result || h.step == reset || h.step == cancel ||
        h.step == release) {
        context.report(std::string("the cell refused ") + name(h.command.command) + ": " + answer);
        if (h.step == run) end_request(context, CommandEnd::refused, answer);
        if (h.step == run) return pause(context);
        if (h.step == release) h.is_owner = h.claim_sent = false;  // another dispatcher has the lease
        if (h.step == release) return end_hand_off(context);
        if (h.step != make_ready) return enter(context, row_of(h.step)->next);
    }
    h.refusal = result;
    if (h.step == claim) return claim_refused(context, result, answer);
    if (result == AckResult::not_owner) return fence(context, "the lease of the cell has run out");
    std::string why = "the cell refused the job at " + std::string(name(h.command.command)) + ": " + answer;
    if (result == AckResult::ticket_field) why += ", address " + std::to_string(context.status().ack_detail);
    return withdraw(context, why, remedy(result));
}

}  // namespace qchopper::hand_off
