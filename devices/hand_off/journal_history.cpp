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

// The bits of JournalEvent::marks of an exported job, and of a head.
constexpr std::uint16_t was_stored = 1;
constexpr std::uint16_t was_start_sent = 2;
constexpr std::uint16_t was_started = 4;
constexpr std::uint16_t had_ended = 8;
constexpr std::uint16_t had_verdict = 16;
constexpr std::uint16_t was_settled = 32;
constexpr std::uint16_t was_forgotten = 64;
constexpr std::uint16_t lease_may_have_lived = 1;
constexpr std::uint16_t store_was_lost = 2;

using enum JournalKind;

void note_head(JournalHistory& history, const JournalEvent& event) {
    history.epoch = event.epoch;
    history.seq = event.seq;
    history.owner = event.owner;
    history.secret = event.secret;
    history.grant = event.grant;
    history.lease_may_live = (event.marks & lease_may_have_lived) != 0;
    history.store_is_lost = (event.marks & store_was_lost) != 0;
}

JournalJob exported_job(const JournalEvent& event) {
    const auto has = [&](std::uint16_t mark) { return (event.marks & mark) != 0; };
    JournalJob job;
    job.job_id = event.job_id;
    job.file_sha256 = event.file_sha256;
    job.ticket = event.ticket;
    job.created_ms = event.created_ms;
    job.started_ms = event.started_ms;
    job.ended_ms = event.ended_ms;
    job.job_result = event.job_result;
    job.is_stored = has(was_stored);
    job.start_sent = has(was_start_sent);
    job.is_started = has(was_started);
    job.has_ended = has(had_ended);
    if (has(had_verdict)) job.start_outcome = event.start_outcome;
    job.is_settled = has(was_settled);
    job.is_forgotten = has(was_forgotten);
    job.is_exported = true;
    return job;
}

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
    if (event.kind == head) note_head(history, event);
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

const JournalJob* JournalHistory::last_start_at(const WireTicket& place, bool counts_restarts) const {
    const auto found = std::find_if(jobs.rbegin(), jobs.rend(), [&](const JournalJob& job) {
        if (!job.may_have_started()) return false;
        const Decoded<WireTicket> ticket = decode<WireTicket>(job.ticket);
        const WireTicket& own = ticket.value;
        return ticket.is_ok() && own.project_id == place.project_id && own.piece_no == place.piece_no &&
               own.part == place.part && own.parts == place.parts && (counts_restarts || !own.is_restart());
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

JournalEvent exported_event(const JournalJob& job) {
    JournalEvent event;
    event.kind = JournalKind::exported;
    event.job_id = job.job_id;
    event.file_sha256 = job.file_sha256;
    event.ticket = job.ticket;
    event.job_result = job.job_result;
    event.start_outcome = job.start_outcome.value_or(StartOutcome::unknown);
    event.created_ms = job.created_ms;
    event.started_ms = job.started_ms;
    event.ended_ms = job.ended_ms;
    const std::pair<bool, std::uint16_t> marks[] = {
        {job.is_stored, was_stored},      {job.start_sent, was_start_sent},   {job.is_started, was_started},
        {job.has_ended, had_ended},       {!!job.start_outcome, had_verdict}, {job.is_settled, was_settled},
        {job.is_forgotten, was_forgotten}};
    for (const auto& [is_so, mark] : marks) {
        if (is_so) event.marks = static_cast<std::uint16_t>(event.marks | mark);
    }
    return event;
}

JournalEvent head_event(const JournalHistory& history, const JournalHead& head) {
    JournalEvent event;
    event.kind = JournalKind::head;
    event.rows = static_cast<std::uint32_t>(head.number);
    event.file_sha256 = sha256_from_hex(head.hash).value_or(Sha256{});
    event.epoch = history.epoch;
    event.seq = history.seq;
    event.owner = history.owner;
    event.secret = history.secret;
    event.grant = history.grant;
    event.marks = static_cast<std::uint16_t>((history.lease_may_live ? lease_may_have_lived : 0) |
                                             (history.store_is_lost ? store_was_lost : 0));
    return event;
}

JournalHistory history_of(std::span<const JournalRow> rows) {
    JournalHistory history;
    std::ptrdiff_t exported_jobs = 0;
    bool is_releasing = false;
    for (const JournalRow& row : rows) {
        const JournalEvent& event = row.event;
        note_of_cell(history, event);
        if (event.kind == claim) is_releasing = false;
        if (event.kind == command && event.command == CellCommand::release) is_releasing = true;
        if (event.kind == closed && is_releasing) history.lease_may_live = false;
        if (event.kind == exported) {  // older than all jobs that have rows
            if (const JournalJob* known = job_of(history, event.job_id); known == nullptr) {
                history.jobs.insert(history.jobs.begin() + exported_jobs++, exported_job(event));
            }
        } else if (event.kind == created) {
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
