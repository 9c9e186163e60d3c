// The coded values of the register map: modes, states, results, flag bits, and their names.
//
// The numbers are those on the wire (docs/developer/formats/registers.md). A value read from the wire may be any
// number: name() and describe() return a text for every one, never nullptr.

#pragma once

#include <cstdint>
#include <span>

namespace qchopper {

constexpr std::uint16_t cell_magic = 0x5143;  // first register of STATUS, IDENTITY and COMMAND
// Versions as major.minor: a block of the same major number and of this or a later minor one is taken.
constexpr std::uint16_t map_version = 0x0101;      // of STATUS and IDENTITY
constexpr std::uint16_t command_version = 0x0100;  // the form of COMMAND
constexpr std::uint16_t any_cell_id = 0xFFFF;      // CELL_ID of a simulated cell that was given none

enum class UnitMode : std::uint16_t { production = 1, maintenance = 2, manual = 3, rehearsal = 4 };

// States of a job; beside two of them their names in OPC 10031-4 (ISA-95 job control).
enum class JobState : std::uint16_t {
    none = 0,
    stored = 1,    // NotAllowedToStart
    prepared = 2,  // AllowedToStart
    running = 3,
    interrupted = 4,
    ended = 5,
    aborted = 6,
    cancelled = 7
};

// A job that has been started never leaves these states.
constexpr bool has_started(JobState state) {
    return state >= JobState::running && state <= JobState::aborted;
}
constexpr bool is_over(JobState state) {
    return state == JobState::ended || state == JobState::aborted;
}

enum class JobResult : std::uint16_t {
    none = 0,
    complete = 1,
    stopped = 2,
    aborted = 3,
    power_loss = 4,
    tool = 5,
    envelope = 6,
    rehearsal_passed = 7,
    rehearsal_failed = 8
};

enum class TransferState : std::uint16_t { idle = 0, open = 1, complete = 2, hash_mismatch = 3 };
enum class Transfer : std::uint16_t { drop_folder = 1, chunks = 2 };
enum class LinkLoss : std::uint16_t { go_on = 0, hold = 1 };  // of a running job without heartbeats of the PC

namespace flag {
constexpr std::uint16_t ready_for_ticket = 1U << 0;
constexpr std::uint16_t prepared = 1U << 1;
constexpr std::uint16_t consent_present = 1U << 2;
constexpr std::uint16_t job_active = 1U << 3;
constexpr std::uint16_t result_waiting = 1U << 4;
constexpr std::uint16_t warning = 1U << 5;
constexpr std::uint16_t fault = 1U << 6;
constexpr std::uint16_t safety_open = 1U << 7;
constexpr std::uint16_t local_control = 1U << 8;
constexpr std::uint16_t simulated = 1U << 9;
constexpr std::uint16_t watchdog_expired = 1U << 10;
constexpr std::uint16_t lease_held = 1U << 11;
constexpr std::uint16_t store_full = 1U << 12;
constexpr std::uint16_t block_loaded = 1U << 13;
constexpr std::uint16_t rehearsal_running = 1U << 14;
}  // namespace flag

// ACK_RESULT, XFER_RESULT, BAD_REASON. From 0x100 on: refused, no effect.
enum class AckResult : std::uint16_t {
    none = 0,
    ok = 1,
    already = 2,
    pending = 3,
    bad_magic = 0x101,
    bad_version = 0x102,
    bad_crc = 0x103,
    unknown_cmd = 0x104,
    stale_seq = 0x105,
    not_owner = 0x106,
    stale_epoch = 0x107,
    lease_busy = 0x108,
    wrong_offset = 0x109,
    chunk_crc = 0x10A,
    epoch_jump = 0x10B,
    wrong_state = 0x201,
    wrong_mode = 0x202,
    local_control = 0x203,
    no_consent = 0x204,
    safety_open = 0x205,
    busy_other_job = 0x206,
    wrong_job = 0x207,
    no_ticket = 0x301,
    ticket_crc = 0x302,
    ticket_field = 0x303,
    bad_signature = 0x304,
    unknown_key = 0x305,
    hash_mismatch = 0x306,
    file_missing = 0x307,
    file_size = 0x308,
    envelope = 0x309,
    tool = 0x30A,
    store_full = 0x30B,
    rehearsal_required = 0x30C,
    job_id_reused = 0x30D,
    stock_too_small = 0x30E,
    program_unreadable = 0x30F,
    token_bad = 0x401,
    already_finished = 0x402,
    unknown_job = 0x403,
    cancelled = 0x404,
    token_expired = 0x405,
    internal = 0x501,
    store_io = 0x502,
    power_loss_recovered = 0x503
};
constexpr bool is_refusal(AckResult result) {
    return static_cast<std::uint16_t>(result) >= 0x100;
}

// ACK_DETAIL of a signature that is refused; 0: no more than the result says.
namespace signature_detail {
constexpr std::uint32_t unsigned_ticket = 1;  // of BAD_SIGNATURE
constexpr std::uint32_t revoked_key = 2;      // of UNKNOWN_KEY
}  // namespace signature_detail

// One row of the table of results in docs/developer/formats/registers.md.
struct ResultCode {
    AckResult result;
    const char* name;
    const char* meaning;
};
std::span<const ResultCode> result_codes();
// Per bit of FLAGS, from bit 0.
std::span<const char* const> flag_names();

// The name in the map, "NO_CONSENT"; and for the operator "the operator at the cell did not consent".
const char* name(AckResult result);
const char* describe(AckResult result);
// The same with what ACK_DETAIL says of a signature.
const char* describe(AckResult result, std::uint32_t detail);
const char* name(JobState state);
const char* name(JobResult result);

}  // namespace qchopper
