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

void note_of_cell(JournalHistory& history, const JournalEvent& event) {
    switch (event.kind) {
        case JournalKind::identity:
            history.store = event.store;
            break;
        case JournalKind::store_lost:
            history.store_is_lost = true;
            break;
        case JournalKind::store_accepted:
            history.store = event.store;
            history.store_is_lost = false;
            history.epoch = 0;
            history.grant = 0;
            history.lease_may_live = false;
            for (JournalJob& job : history.jobs) {
                job.is_settled = job.is_settled || job.is_open();
                job.is_forgotten = true;
            }
            break;
        case JournalKind::claim:
            history.epoch = std::max(history.epoch, event.epoch);
            history.lease_may_live = true;
            history.owner = event.owner;
            history.secret = event.secret;
            history.seq = event.seq;
            break;
        case JournalKind::start_intent:
            // START follows a CLAIM that was granted: a memory with a lower EPOCH_HELD is an older one.
            if (history.store) history.store->epoch_held = std::max(history.store->epoch_held, event.epoch);
            [[fallthrough]];
        case JournalKind::command:
            if (event.owner == history.owner) history.seq = std::max(history.seq, event.seq);
            break;
        case JournalKind::granted:
            history.grant = event.grant;
            break;
        default:
            break;
    }
}

void note_of_job(JournalJob& job, const JournalEvent& event, std::uint32_t boots) {
    switch (event.kind) {
        case JournalKind::command:
            job.is_stored = job.is_stored || event.command == CellCommand::store;
            break;
        case JournalKind::start_intent:
            job.start_may_have_arrived = true;
            job.start_boots = boots;
            break;
        case JournalKind::start_void:
            job.start_may_have_arrived = false;
            break;
        case JournalKind::started:
            job.is_started = true;
            break;
        case JournalKind::result:
            job.has_ended = event.job_state == JobState::ended || event.job_state == JobState::aborted;
            job.job_result = event.job_result;
            break;
        case JournalKind::resumed:
            job.start_outcome.reset();
            break;
        case JournalKind::closed:
            job.start_outcome = event.start_outcome;
            break;
        default:
            break;
    }
}

}  // namespace

const JournalJob* JournalHistory::last_start_of(const Sha256& file) const {
    const auto found = std::find_if(jobs.rbegin(), jobs.rend(), [&](const JournalJob& job) {
        return job.may_have_started() && job.file_sha256 == file;
    });
    return found == jobs.rend() ? nullptr : &*found;
}

HandOffPast past_of(const JournalHistory& history, const JournalJob* job, std::uint32_t owner_held) {
    HandOffPast past;
    past.store = history.store;
    past.store_is_lost = history.store_is_lost;
    past.epoch = history.epoch;
    past.grant = history.grant;
    if (history.lease_may_live || (owner_held != 0 && owner_held == history.owner)) {
        past.owner = history.owner;
        past.secret = history.secret;
        past.seq = history.seq;
    }
    if (job == nullptr) return past;
    past.is_stored = job->is_stored;
    past.start_may_have_arrived = job->start_may_have_arrived;
    past.is_started = job->is_started;
    past.start_boots = job->start_boots;
    return past;
}

std::string why_part_must_wait(const JournalHistory& history, const WireTicket& ticket) {
    if (ticket.part <= 1) return {};
    for (const JournalJob& job : history.jobs) {
        const Decoded<WireTicket> before = decode_ticket(job.ticket);
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
        if (event.kind == JournalKind::claim) is_releasing = false;
        if (event.kind == JournalKind::command && event.command == CellCommand::release) is_releasing = true;
        if (event.kind == JournalKind::closed && is_releasing) history.lease_may_live = false;
        if (event.kind == JournalKind::created) {
            JournalJob job;
            job.job_id = event.job_id;
            job.file_sha256 = event.file_sha256;
            job.ticket = event.ticket;
            history.jobs.push_back(std::move(job));
        } else if (JournalJob* job = job_of(history, event.job_id)) {
            note_of_job(*job, event, history.store ? history.store->boot_count : 0);
        }
    }
    return history;
}

}  // namespace qchopper
