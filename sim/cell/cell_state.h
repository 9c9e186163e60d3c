// The state of the simulated cell's controller, as plain values: its limits, its memory, its job, its lease;
// and what it needs from outside.
//
// Times in ms (`_ms`) of the steady clock unless the name says unix; lengths in mm in the base frame of the program.

#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/box.h"
#include "base/files/file.h"
#include "devices/wire/codec.h"
#include "devices/wire/ed25519.h"
#include "sim/cell/faults.h"
#include "sim/cell/program_run.h"

namespace qchopper {

enum class Consent { automatic, ask, never };

struct CellTool {
    std::uint16_t number = 0;
    double diameter = 1000;
    std::uint16_t spindle_max_rpm = 0xFFFF;
    std::uint32_t feed_max_mm_per_min = 0xFFFFFFFF;
};

// A key whose signatures the cell takes, or took.
struct CellKey {
    Ed25519PublicKey key;
    bool is_revoked = false;
};

// What this cell is and can do. The defaults of reach and stock are far above any bone.
struct CellLimits {
    std::uint16_t cell_id = any_cell_id;
    Consent consent = Consent::automatic;
    double speed = 1;  // simulated seconds of a job per second
    Box workspace{{-5000, -5000, -5000}, {5000, 5000, 5000}};
    Vec3 max_stock{5000, 5000, 5000};
    std::vector<CellTool> tools;               // in the rack; empty: any
    std::uint32_t takeover_code = 0;           // with it a CLAIM replaces the lease of another dispatcher; 0: none does
    std::uint32_t max_chunk_file = 64U << 20;  // bytes that may come in chunks
    bool require_signature = false;            // no job without the signature of a trusted key
    std::int64_t acting_ms = 200;              // of an acting state except Execute; a rehearsal takes five times that
};

// The block on the table, as a person sees it. unknown: nobody has said; a consent then says that it is right.
enum class BlockOnTable { unknown, none, fresh, used, moved };

// How far the last job that was started has carved its block. The stock follows from it and the job file.
struct CarvedSoFar {
    Uuid job{};               // 0: nothing was carved
    double run_s = 0;         // of the job
    std::uint32_t block = 0;  // BLOCK_NO there
};

// What a person at the cell sets, and the block; power cuts do not change it.
struct Surroundings {
    bool door_open = false;
    bool e_stop = false;
    bool local_control = false;
    bool tool_broken = false;
    BlockOnTable block = BlockOnTable::unknown;
    CarvedSoFar carved;  // as of the end of a job, or of a power cut
    bool is_safe() const { return !door_open && !e_stop; }
};

// The first alarm, until the machine is cleared; code 0: there is none.
struct CellAlarm {
    std::uint32_t code = 0;
    std::uint32_t block = 0;  // of the program
    std::string text;
};

// How the next power cut ends; `lost` from the event at which power was cut until boot().
struct PowerCut {
    // back: an older copy of the store; all_back: an older copy of store and marks.
    enum class Store { stays, lost, back, all_back };
    std::uint64_t at_event = 0;  // 0: none is due
    Store store = Store::stays;
    bool lost = false;
};

struct CellTime {
    std::int64_t steady_ms = 0;  // of a monotonic clock, for leases, tokens and motion
    std::uint64_t unix_ms = 0;   // for STATUS and the records only
};

// What outlives a power cut.
struct CellMemory {
    Uuid store_id{};  // drawn when the memory was made
    std::uint64_t store_created_ms = 0;
    std::uint32_t boot_count = 0;
    std::uint32_t epoch_held = 0;
    std::uint32_t starts_total = 0;
    std::uint64_t mark = 0;                         // random, another one at each write
    std::map<std::uint32_t, std::uint32_t> grants;  // of every CLAIM ever granted: its random number, its epoch
    std::map<Uuid, JobRecord> jobs;                 // every id ever started or cancelled
    bool operator==(const CellMemory&) const = default;
};

// Kept outside of the store, in a memory that no backup of the store holds: the store that was written last has one of
// these marks. Another one is an older copy.
struct SaveMarks {
    std::uint64_t last = 0;  // of the last write that came to its end
    std::uint64_t next = 0;  // of a write that may have begun
    bool operator==(const SaveMarks&) const = default;
};

// What a command is answered.
struct CommandAnswer {
    AckResult result = AckResult::ok;
    std::uint32_t detail = 0;  // ACK_DETAIL
};

// The last command of one sender and its result.
struct Acknowledgement {
    std::uint32_t owner = 0;
    std::uint32_t seq = 0;
    std::uint32_t crc = 0;  // of its block
    CellCommand command = CellCommand::none;
    AckResult result = AckResult::none;
    std::uint32_t detail = 0;
};

struct Lease {
    std::uint32_t owner = 0;
    std::uint32_t secret = 0;
    std::int64_t until_ms = 0;
    std::int64_t heartbeat_ms = 0;         // of the last heartbeat, or of CLAIM
    std::optional<std::uint16_t> counter;  // of the last heartbeat
};

struct CellJob {
    WireTicket ticket;
    Registers ticket_block;  // as received, to compare a second STORE with
    Registers signature;     // as received with it; empty: it is not signed
    JobState state = JobState::none;
    JobResult result = JobResult::none;
    std::uint32_t token = 0;
    std::uint32_t expired_token = 0;
    std::int64_t token_until_ms = 0;
    std::uint32_t receipt = 0;  // of a rehearsal that passed
    TransferState transfer = TransferState::idle;
    Bytes chunks;             // received so far
    Sha256 stored_sha256{};   // of the copy that VERIFY found
    ReceivedProgram program;  // in that copy; without a run it goes on by the estimated time
    double run_s = 0;         // carved until the state was entered, in seconds of the job
    double stop_s = 0;        // of the job, where a Hold or Suspend that has come stops it: at the end of a line
    bool cut_short = false;   // by the command Complete
    bool is_active() const { return state == JobState::running || state == JobState::interrupted; }
    bool is_waiting() const { return state == JobState::stored || state == JobState::prepared; }
    bool is_finished() const { return is_over(state); }
};

// A command that was answered PENDING, and what it waits for.
struct Pending {
    enum class Waits { consent, file, rehearsal };
    std::uint64_t number = 0;  // of the question; an answer with another number is ignored
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
    bool checks_store = false;     // against marks in another memory
    std::uint64_t saved_mark = 0;  // of the store as it is
    PackState state = PackState::stopped;
    PackState state_before = PackState::stopped;
    UnitMode mode = UnitMode::production;
    std::int64_t state_since_ms = 0;
    CellJob job;  // state none: there is none
    std::optional<Lease> lease;
    bool watchdog_expired = false;
    bool consent_present = false;
    bool warning = false;
    CellAlarm alarm;
    Surroundings surroundings;
    Faults faults;
    PowerCut power;
    std::uint64_t steps = 0;   // lines of the log, and two for each write of the memory
    std::int64_t jump_ms = 0;  // of the time of day
    std::optional<std::uint16_t> frozen_heartbeat;
    std::uint16_t heartbeat_offset = 0;
    std::optional<Pending> pending;
    std::uint64_t pending_count = 0;
    Registers ticket_draft;               // TICKET as written last; empty: none
    Registers signature_draft;            // SIGNATURE as written last; empty: none
    Acknowledgement ack;                  // in STATUS
    std::deque<Acknowledgement> senders;  // the last one of each owner, of at most 256 owners
    std::uint16_t bad_frames = 0;
    AckResult bad_reason = AckResult::none;
    std::uint64_t untold_bad_frames = 0;            // since the last line about one
    std::optional<std::int64_t> bad_frame_told_ms;  // when that line was logged
    AckResult transfer_result = AckResult::none;
    ResultRecord answer;      // RESULT, if has_answer
    bool has_answer = false;  // a QUERY or QUERY_FILE was received
    std::uint32_t events = 0;
    std::uint32_t store_free_kib = 0;
    std::uint64_t random = 1;  // state of the generator of tokens and receipts
    CellTime booted;
};

// The answer to a pending VERIFY.
struct FileCheck {
    enum class End { ok, missing, io_error };
    End end = End::missing;
    std::uint64_t size = 0;        // bytes
    Sha256 sha256{};               // of the copy in the store, if its size is right
    ReceivedProgram program = {};  // in it
};

// Called from the functions of machine.h, in their thread. Any of them may be empty.
struct CellHooks {
    // Writes the memory so that it outlives a power cut. False: it could not, and the command is refused.
    std::function<bool(const CellMemory&)> save;
    std::function<void(const std::string&)> log;
    // Removes copies of finished jobs until so many bytes are free or none is left; returns the free KiB.
    std::function<std::uint32_t(const CellMemory&, std::uint64_t bytes)> remove_old_copies;
    // The marks of the store, in another memory. Both or none; without them the cell does not find an older copy.
    std::function<SaveMarks()> read_marks;
    std::function<bool(const SaveMarks&)> write_marks;  // false: it could not
    // The keys as they are now, asked for at STORE, PREPARE and START. Empty: the cell has no list of keys.
    std::function<std::vector<CellKey>()> trusted_keys;
};

}  // namespace qchopper
