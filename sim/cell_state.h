// All that the simulated cell's controller knows, as plain values: its limits, its memory, its job, its lease.
//
// Milliseconds; lengths in mm in the base frame of the program.

#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/box.h"
#include "base/file.h"
#include "devices/codec.h"

namespace qchopper {

enum class Consent { automatic, ask, never };

struct CellTool {
    std::uint16_t number = 0;
    double diameter = 1000;
    std::uint16_t spindle_max_rpm = 0xFFFF;
    std::uint32_t feed_max_mm_per_min = 0xFFFFFFFF;
};

// What this cell is and can. Its reach and largest stock are far above any bone; cli takes them from the cell file.
struct CellLimits {
    std::uint16_t cell_id = any_cell_id;
    Consent consent = Consent::automatic;
    double speed = 1;  // simulated seconds of a job per second
    Box reach{{-5000, -5000, -5000}, {5000, 5000, 5000}};
    Vec3 max_stock{5000, 5000, 5000};
    std::vector<CellTool> tools;               // in the rack; empty: any
    std::uint32_t takeover_code = 0;           // opens a living lease to another dispatcher; 0: nothing does
    std::uint32_t max_chunk_file = 64U << 20;  // bytes that may come in chunks
    std::int64_t acting_ms = 200;              // an acting state other than Execute, a rehearsal five times that
};

struct CellTime {
    std::int64_t steady_ms = 0;  // of a clock that never jumps: leases, tokens, motion
    std::uint64_t unix_ms = 0;   // only shown
};

// What outlives a power cut.
struct JobRecord {
    JobState state = JobState::none;
    JobResult result = JobResult::none;
    std::uint32_t starts = 0;
    std::uint32_t start_epoch = 0;
    std::uint32_t start_seq = 0;
    std::uint64_t start_time_ms = 0;
    std::uint64_t end_time_ms = 0;
    Sha256 file_sha256{};
    std::uint32_t last_block = 0;
    bool operator==(const JobRecord&) const = default;
};
struct CellMemory {
    std::uint32_t boot_count = 0;
    std::uint32_t epoch_held = 0;
    std::uint32_t starts_total = 0;
    std::map<Uuid, JobRecord> jobs;  // every id ever started or cancelled, for ever
    bool operator==(const CellMemory&) const = default;
};

// One sender's last command and what it got.
struct Acknowledgement {
    std::uint32_t owner = 0;
    std::uint32_t seq = 0;
    std::uint32_t crc = 0;
    CellCommand command = CellCommand::none;
    AckResult result = AckResult::none;
    std::uint32_t detail = 0;
};

struct Lease {
    std::uint32_t owner = 0;
    std::uint32_t secret = 0;
    std::int64_t until_ms = 0;
    std::int64_t beat_ms = 0;  // last heartbeat, or the CLAIM
    std::optional<std::uint16_t> counter;
};

struct CellJob {
    WireTicket ticket;
    Registers ticket_block;  // as it came, for "the same ticket again"
    bool is_signed = false;
    JobState state = JobState::none;
    JobResult result = JobResult::none;
    std::uint32_t token = 0;
    std::uint32_t expired_token = 0;
    std::int64_t token_until_ms = 0;
    std::uint32_t receipt = 0;  // of a rehearsal that passed
    TransferState transfer = TransferState::idle;
    Bytes chunks;
    Sha256 stored_sha256{};
    double run_s = 0;        // carved so far, up to the last time that Execute was left
    bool cut_short = false;  // by the command Complete
    bool is_active() const { return state == JobState::running || state == JobState::interrupted; }
    bool is_waiting() const { return state == JobState::stored || state == JobState::prepared; }
    bool is_finished() const { return state == JobState::ended || state == JobState::aborted; }
};

// A command that was answered PENDING and who is to say how it ends.
struct Pending {
    enum class Waits { consent, file, rehearsal };
    std::uint64_t number = 0;  // names it: a late answer to an older one is not taken
    Waits waits = Waits::consent;
    CellCommand command = CellCommand::none;
    std::uint32_t owner = 0;
    std::uint32_t seq = 0;
    std::string question;     // for consent
    std::int64_t due_ms = 0;  // for a rehearsal
};

struct CellState {
    CellLimits limits;
    CellMemory memory;
    PackState state = PackState::stopped;
    PackState state_before = PackState::stopped;
    UnitMode mode = UnitMode::production;
    std::int64_t state_since_ms = 0;
    CellJob job;  // state none: there is none
    std::optional<Lease> lease;
    bool watchdog_expired = false;
    bool consent_present = false;
    bool warning = false;
    std::optional<Pending> pending;
    std::uint64_t pending_count = 0;
    Registers ticket_draft;               // empty: none
    Registers signature_draft;            // empty: none
    Acknowledgement ack;                  // published
    std::deque<Acknowledgement> senders;  // last one of each owner, bounded
    std::uint16_t bad_frames = 0;
    AckResult bad_reason = AckResult::none;
    AckResult transfer_result = AckResult::none;
    ResultRecord answer;  // RESULT block
    bool has_answer = false;
    std::uint32_t events = 0;
    std::uint32_t store_free_kib = 0;
    std::uint64_t random = 1;  // state of the generator of tokens and receipts
    CellTime booted;
};

}  // namespace qchopper
