// The values of the blocks of the register map: a struct for each block, a member for each field.
//
// Units are those of the map (docs/developer/formats/registers.md): lengths in 0.01 mm, shares in 0.01 %, times in s or
// in ms since 1970 (UTC). An id or a hash of zeros means none. That every member has the type and size of its field is
// checked when registers.cpp is compiled (layout.h).

#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "cam/job/ticket.h"
#include "devices/wire/codes.h"
#include "devices/wire/ed25519.h"
#include "devices/wire/packml.h"

namespace qchopper {

// STATUS: the state of the cell, its last acknowledgement and its job.
struct Status {
    std::uint16_t version = map_version;
    std::uint16_t snapshot = 0;
    std::uint16_t heartbeat = 0;
    std::uint32_t boot_count = 0;
    UnitMode unit_mode = UnitMode::production;
    PackState state = PackState::undefined;
    PackState state_before = PackState::undefined;
    std::uint16_t flags = 0;
    std::uint32_t epoch_held = 0;
    std::uint16_t lease_left_ds = 0;  // tenths of a second
    std::uint16_t cell_id = 0;
    std::uint32_t ack_seq = 0;
    CellCommand ack_command = CellCommand::none;
    AckResult ack_result = AckResult::none;
    std::uint32_t ack_detail = 0;
    Uuid job_id{};
    std::uint32_t token = 0;
    JobState job_state = JobState::none;
    JobResult job_result = JobResult::none;
    std::uint16_t progress = 0;  // 0.01 %
    std::uint32_t elapsed_s = 0;
    static constexpr std::uint32_t unknown_s = 0xFFFFFFFF;  // of remaining_s
    std::uint32_t remaining_s = 0;
    std::uint32_t block_no = 0;
    std::uint16_t tool_no = 0;
    std::array<std::int32_t, 3> tip{};  // 0.01 mm
    std::uint16_t feed_override = 0;    // 0.01 %
    std::uint16_t spindle_rpm = 0;
    std::uint16_t alarms = 0;
    std::uint32_t alarm_code = 0;
    std::uint32_t alarm_block = 0;
    std::string alarm_text;  // 16 bytes go over the wire
    TransferState transfer_state = TransferState::idle;
    std::uint32_t transfer_next = 0;
    AckResult transfer_result = AckResult::none;
    std::uint32_t store_free_kib = 0;
    std::uint32_t event_no = 0;
    Sha256 file_sha256{};
    std::uint32_t starts_total = 0;
    std::uint64_t cell_time_ms = 0;
    std::uint32_t owner_held = 0;
    std::uint32_t ack_owner = 0;
    std::uint16_t bad_frames = 0;
    AckResult bad_reason = AckResult::none;
    bool operator==(const Status&) const = default;
    bool has(std::uint16_t flag_bit) const { return (flags & flag_bit) != 0; }
};

// IDENTITY: which memory the cell has. Another store_id, or a number lower than one seen before, means that the cell
// lost its memory: jobs that it has started may be unknown to it.
struct Identity {
    std::uint16_t version = map_version;
    Uuid store_id{};  // random, drawn when the store was made, and never again
    std::uint32_t boot_count = 0;
    std::uint32_t epoch_held = 0;
    std::uint32_t starts_total = 0;
    std::uint64_t store_created_ms = 0;
    std::uint16_t checks_store = 0;  // 1: it finds an older copy of its store by itself, and draws another store_id
    bool operator==(const Identity&) const = default;
};

// What a cell keeps of a job for ever, also without power.
struct JobRecord {
    JobState state = JobState::none;
    JobResult result = JobResult::none;
    std::uint32_t starts = 0;  // 0 or 1
    std::uint32_t start_epoch = 0;
    std::uint32_t start_seq = 0;
    std::uint64_t start_time_ms = 0;
    std::uint64_t end_time_ms = 0;
    Sha256 file_sha256{};
    std::uint32_t last_block = 0;
    bool operator==(const JobRecord&) const = default;
};

// RESULT: the answer to the last QUERY or QUERY_FILE.
struct ResultRecord : JobRecord {
    Uuid job_id{};
    std::uint32_t query_seq = 0;  // CMD_SEQ of that command
    std::uint32_t query_owner = 0;
    std::uint32_t grant_epoch = 0;  // of the CLAIM whose number is ARG0 of the query
    bool operator==(const ResultRecord&) const = default;
};

// COMMAND: one command of a dispatcher.
struct Command {
    std::uint32_t epoch = 0;
    std::uint32_t seq = 0;
    CellCommand command = CellCommand::none;
    Uuid job_id{};
    std::uint32_t token = 0;
    std::uint32_t arg0 = 0;
    std::uint32_t arg1 = 0;
    Sha256 file_sha256{};
    std::uint32_t owner = 0;
    bool operator==(const Command&) const = default;
};

// TICKET: the job as integers; wire_ticket() in codec.h makes it from a JobTicket in mm.
struct WireTicket {
    std::uint16_t ticket_version = 1;
    Uuid job_id{};
    Sha256 file_sha256{};
    std::uint32_t file_size = 0;
    Transfer transfer = Transfer::drop_folder;
    std::string file_name;   // 1 to 32 bytes, a portable name
    std::uint16_t unit = 1;  // mm
    std::array<std::int32_t, 3> box_min{};
    std::array<std::int32_t, 3> box_max{};
    std::array<std::int32_t, 3> stock{};
    std::uint16_t material = 0;
    std::uint16_t tool_no = 0;
    std::uint32_t tool_diameter_um = 0;
    std::uint16_t spindle_max_rpm = 0;
    std::uint32_t feed_max_mm_per_min = 0;
    std::uint32_t estimated_time_s = 0;
    std::uint16_t base_plane = 0xFFFF;
    std::uint16_t piece_no = 0;
    std::uint16_t piece_count = 0;
    Uuid project_id{};
    std::uint64_t created_ms = 0;
    LinkLoss on_link_loss = LinkLoss::go_on;
    std::uint16_t requirements = 0;  // b0 rehearsal required
    std::uint16_t part = 0;          // 1..parts of the programs of one piece; both 0: undivided
    std::uint16_t parts = 0;
    std::uint16_t cell_id = 0;
    std::uint16_t made_for = 0;  // b0: made for a simulated cell
    std::uint32_t key_id = 0;
    // Whether FILE_NAME is that of a restart: it ends with .rN.qjob, N a number.
    bool is_restart() const;
    bool operator==(const WireTicket&) const = default;
};

// SIGNATURE: of the ticket that was written before; ticket_signature.h makes and checks it.
struct TicketSignature {
    Ed25519Signature signature;  // zeros: the ticket is not signed
    bool operator==(const TicketSignature&) const = default;
};

// HEARTBEAT: keeps the lease of a dispatcher.
struct Heartbeat {
    std::uint32_t epoch = 0;
    std::uint32_t owner = 0;
    std::uint16_t counter = 0;  // differs from the one before
    bool operator==(const Heartbeat&) const = default;
};

// CHUNK: a slice of the job file.
struct Chunk {
    std::uint32_t offset = 0;        // of its first byte in the file
    std::vector<std::uint8_t> data;  // 1..232 bytes
    std::uint32_t crc = 0;           // chunk_crc() in codec.h
    bool operator==(const Chunk&) const = default;
};

}  // namespace qchopper
