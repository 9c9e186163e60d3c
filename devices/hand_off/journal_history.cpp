// One pass over the rows, with a search for the job of each from the end: O(rows), as long as few jobs are open.

#include "devices/hand_off/journal_history.h"

#include <algorithm>

#include "devices/wire/codec.h"

namespace qchopper {
namespace {

JournalJob* job_of(JournalHistory& history, const Uuid& id) {
    const auto found = std::find_if(history.jobs.rbegin(), history.jobs.rend(),
                                    [&](const JournalJob& job) { return job.job_id == id; });
    return found == history.jobs.rend() ? nullptr : &*found;
}

using enum JournalKind;

void note_of_cell(JournalHistory& history, const JournalEvent& event) {
    if (event.kind == identity || event.kind == store_accepted) history.store = event.store;
    if (event.kind == store_lost) history.store_is_lost = true;
    if (event.kind == store_accepted) {
        history.store_is_lost = false;
        history.epoch = history.grant = 0;
        history.lease_may_live = false;
        for (JournalJob& job : history.jobs) {
            job.is_settled = job.is_settled || job.is_open();
            job.is_forgotten = true;
        }
    }
    if (event.kind == claim) {
        history.epoch = std::max(history.epoch, event.epoch);
        history.lease_may_live = true;
        history.owner = event.owner;
        history.secret = event.secret;
        history.seq = event.seq;
    }
    // START follows a CLAIM that was granted: a memory with a lower EPOCH_HELD is an older one.
    if (event.kind == start_intent && history.store) {
        history.store->epoch_held = std::max(history.store->epoch_held, event.epoch);
    }
    const bool has_number = event.kind == start_intent || event.kind == command;
    if (has_number && event.owner == history.owner) history.seq = std::max(history.seq, event.seq);
    if (event.kind == granted) history.grant = event.grant;
}

void note_of_job(JournalJob& job, const JournalRow& row, std::uint32_t boots) {
    const JournalEvent& event = row.event;
    if (event.kind == command && event.command == CellCommand::store) job.is_stored = true;
    if (event.kind == start_intent) job.start_boots = boots;
    if (event.kind == start_intent || event.kind == start_void) job.start_sent = event.kind == start_intent;
    if (event.kind == started) {
        job.is_started = true;
        job.started_ms = row.unix_ms;
    }
    if (event.kind == result) {
        job.has_ended = is_over(event.job_state);
        job.job_result = event.job_result;
        job.ended_ms = job.has_ended ? row.unix_ms : 0;
    }
    if (event.kind == resumed) job.start_outcome.reset();
    if (event.kind == closed) job.start_outcome = event.start_outcome;
}

}  // namespace

const JournalJob* JournalHistory::last_start_of(const Sha256& file) const {
    const auto found = std::find_if(jobs.rbegin(), jobs.rend(), [&](const JournalJob& job) {
        return job.may_have_started() && job.file_sha256 == file;
    });
    return found == jobs.rend() ? nullptr : &*found;
}

HandOffPast past_of(const JournalHistory& history, const JournalJob* job, std::uint32_t owner_held) {
    HandOffPast past{history, {}};
    if (job != nullptr) static_cast<JobPast&>(past) = *job;
    const bool goes_on = history.lease_may_live || (owner_held != 0 && owner_held == history.owner);
    if (!goes_on) past.owner = past.secret = past.seq = 0;
    return past;
}

std::string why_part_must_wait(const JournalHistory& history, const WireTicket& ticket) {
    if (ticket.part <= 1) return {};
    for (const JournalJob& job : history.jobs) {
        const Decoded<WireTicket> before = decode<WireTicket>(job.ticket);
        if (!job.is_complete() || !before.is_ok()) continue;
        const WireTicket& t = before.value;
        if (t.project_id == ticket.project_id && t.piece_no == ticket.piece_no && t.parts == ticket.parts &&
            t.part + 1 == ticket.part) {
            return {};
        }
    }
    return "part " + std::to_string(ticket.part) + " of " + std::to_string(ticket.parts) +
           " is not sent: the journal has no complete end of part " + std::to_string(ticket.part - 1);
}

JournalHistory history_of(std::span<const JournalRow> rows) {
    JournalHistory history;
    bool is_releasing = false;
    for (const JournalRow& row : rows) {
        const JournalEvent& event = row.event;
        note_of_cell(history, event);
        if (event.kind == claim) is_releasing = false;
        if (event.kind == command && event.command == CellCommand::release) is_releasing = true;
        if (event.kind == closed && is_releasing) history.lease_may_live = false;
        if (event.kind == created) {
            JournalJob job;
            job.job_id = event.job_id;
            job.file_sha256 = event.file_sha256;
            job.ticket = event.ticket;
            job.created_ms = row.unix_ms;
            history.jobs.push_back(std::move(job));
        } else if (JournalJob* job = job_of(history, event.job_id)) {
            note_of_job(*job, row, history.store ? history.store->boot_count : 0);
        }
    }
    return history;
}

}  // namespace qchopper
