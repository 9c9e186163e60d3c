// The events of the journal of a cell: their kinds, what each kind holds, and one grammar for all of their rows.
//
// A row's text is the fields of its kind in the order of devices/journal/journal_event.cpp, as "name=value" with one
// space between them. Numbers are decimal without sign or leading zeros, ids and hashes lower-case hexadecimal digits;
// no value holds a space. text_of() and event_from() are inverse to each other for every text that event_from() accepts
// (tests/devices/journal/journal_event_test.cpp).

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/sha256.h"
#include "base/uuid.h"
#include "devices/journal/job_outcome.h"
#include "devices/wire/codes.h"
#include "devices/wire/packml.h"

namespace qchopper {

enum class JournalKind : std::uint8_t {
    created,         // a job id was drawn for a file; the ticket is kept as registers
    resumed,         // a dispatcher takes up a job of an earlier one
    identity,        // store and counters of the cell, as it last showed them
    claim,           // about to send CLAIM
    command,         // about to send any other command but START
    start_intent,    // about to send START
    start_void,      // the START of the last intent had no effect and can have none any more
    started,         // the cell has shown that the job has started
    receipt,         // of a rehearsal that passed
    progress,        // of a running job
    refused,         // the cell refused a command
    result,          // how the job ended in the cell
    closed,          // the hand-off ended with a verdict
    store_lost,      // the cell has another memory than before
    store_accepted,  // the operator accepts the memory that the cell has now
    granted,         // the cell has granted a CLAIM and drawn a number for it, and knew the number of the one before
    exported,        // what the next dispatcher must know of a job whose rows were exported and removed
    head             // rows up to a number were exported and removed, and what they had said of the cell
};
constexpr std::size_t journal_kinds = 18;

// What the cell shows of its memory.
struct SeenStore {
    Uuid store_id{};
    std::uint16_t version = 0;  // of its map
    std::uint32_t boot_count = 0;
    std::uint32_t epoch_held = 0;
    std::uint32_t starts_total = 0;
    bool operator==(const SeenStore&) const = default;
};

// Which members an event of a kind holds is stated by the table in journal_event.cpp; the others are not kept.
struct JournalEvent {
    JournalKind kind = JournalKind::created;
    Uuid job_id{};
    Sha256 file_sha256{};
    std::vector<std::uint16_t> ticket;  // the block TICKET
    std::uint32_t epoch = 0;
    std::uint32_t seq = 0;  // CMD_SEQ
    std::uint32_t owner = 0;
    std::uint32_t secret = 0;
    CellCommand command = CellCommand::none;
    std::uint32_t token = 0;
    std::uint32_t receipt = 0;
    std::uint32_t grant = 0;     // number of the CLAIM
    std::uint16_t progress = 0;  // 0.01 %
    AckResult refusal = AckResult::none;
    JobState job_state = JobState::none;
    JobResult job_result = JobResult::none;
    std::uint32_t starts = 0;
    StartOutcome start_outcome = StartOutcome::unknown;
    std::uint64_t created_ms = 0;
    std::uint64_t started_ms = 0;
    std::uint64_t ended_ms = 0;
    std::uint16_t marks = 0;  // what else is known of an exported job: devices/hand_off/journal_history.cpp
    std::uint32_t rows = 0;   // number of the last row that was removed
    SeenStore store;
    bool operator==(const JournalEvent&) const = default;
};

// "START_INTENT"; unique.
const char* name(JournalKind kind);
std::optional<JournalKind> journal_kind_from(std::string_view name);

std::string text_of(const JournalEvent& event);
// Nothing unless `text` is one that text_of() gives for an event of this kind.
std::optional<JournalEvent> event_from(JournalKind kind, std::string_view text);

// One sentence for the operator, without job id.
std::string describe(const JournalEvent& event);

}  // namespace qchopper
