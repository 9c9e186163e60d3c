// What a journal says about its cell and its jobs, for the next dispatcher.
//
// A pure function of the rows (tests/devices/hand_off/journal_history_test.cpp). It says what the rows say: where the
// last ones were lost, an open job may have started all the same, and the numbers are too low. adopt_job() reckons with
// that.

#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "devices/hand_off/dispatch_options.h"
#include "devices/journal/journal.h"
#include "devices/wire/blocks.h"

namespace qchopper {

struct JournalJob : JobPast {
    Uuid job_id{};
    Sha256 file_sha256{};
    std::vector<std::uint16_t> ticket;  // the block TICKET
    std::uint64_t created_ms = 0;       // by the clock of the PC, as the following
    std::uint64_t started_ms = 0;       // when the cell showed it; 0: it did not
    std::uint64_t ended_ms = 0;         // 0: it has not ended in the cell
    bool has_ended = false;             // ended or aborted in the cell
    JobResult job_result = JobResult::none;
    std::optional<StartOutcome> start_outcome;  // of the last hand-off that came to its end
    bool is_settled = false;    // it was open when the cell lost its memory: what became of it is UNKNOWN
    bool is_forgotten = false;  // it is older than the memory of the cell
    bool is_exported = false;   // its rows were exported and removed
    bool operator==(const JournalJob&) const = default;

    bool may_have_started() const {
        return is_started || is_settled || start_outcome == StartOutcome::unknown ||
               (start_sent && start_outcome != StartOutcome::not_started);
    }
    bool is_complete() const { return has_ended && job_result == JobResult::complete; }
    // Its hand-off did not come to an end: the cell is to be asked.
    bool is_open() const { return !has_ended && !is_settled && start_outcome != StartOutcome::not_started; }
};

// Epoch and grant are those for the store as it is now.
struct JournalHistory : CellPast {
    bool lease_may_live = false;  // of owner and secret
    std::vector<JournalJob> jobs;

    // The last job with this file that has started or may have; nullptr if none.
    const JournalJob* last_start_of(const Sha256& file) const;
    // The last one of the same PROJECT_ID, PIECE_NO, PART and PARTS, with restarts or without.
    const JournalJob* last_start_at(const WireTicket& place, bool counts_restarts = true) const;
};

// What a hand-off to this cell has to know; of `job` if it is taken up (nullptr: a new job). `owner_held` as STATUS
// shows it: the last owner goes on too if the cell has not got its RELEASE.
HandOffPast past_of(const JournalHistory& history, const JournalJob* job, std::uint32_t owner_held = 0);

// Why part `part` of `parts` of a piece must not be milled yet, or "": the part before it has not ended complete. Parts
// of one piece have the same PROJECT_ID, PIECE_NO and PARTS.
std::string why_part_must_wait(const JournalHistory& history, const WireTicket& ticket);

JournalHistory history_of(std::span<const JournalRow> rows);

// Rows from which history_of() makes the same job again, with is_exported, and the same past of the cell but for its
// store; `head` is the last row that was removed.
JournalEvent exported_event(const JournalJob& job);
JournalEvent head_event(const JournalHistory& history, const JournalHead& head);

}  // namespace qchopper
