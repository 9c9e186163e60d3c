// The register map as tables: one row for every field of every block, in the order of addresses. The tables are
// constants; field_named() searches a block linearly, O(fields).

#include "devices/wire/registers.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstring>
#include <tuple>

#include "devices/wire/layout.h"

namespace qchopper {
namespace {

using enum FieldType;
using namespace layout;

constexpr LayoutRow<Status> status_rows[] = {
    fixed<Status, cell_magic>({0, 1, u16, "MAGIC", "0x5143"}, FieldRole::magic),
    bound<&Status::version>({1, 1, u16, "VERSION", "0x0101, major.minor"}, FieldRole::version),
    bound<&Status::snapshot>(
        {2, 1, u16, "SNAP_BEGIN", "number of the snapshot; if it differs from SNAP_END: read again"},
        FieldRole::snap_begin),
    bound<&Status::heartbeat>({3, 1, u16, "CELL_HB", "+1 each 500 ms, wraps"}),
    bound<&Status::boot_count>({4, 2, u32, "BOOT_COUNT", "+1 at each start of the controller, persistent"}),
    bound<&Status::unit_mode>({6, 1, u16, "UNIT_MODE", "1 production, 2 maintenance, 3 manual, 4 rehearsal"}),
    bound<&Status::state>({7, 1, u16, "STATE", "PackML number, see below"}),
    bound<&Status::state_before>({8, 1, u16, "STATE_PREV", "PackML number"}),
    bound<&Status::flags>({9, 1, u16, "FLAGS", "bits, see below"}),
    bound<&Status::epoch_held>({10, 2, u32, "EPOCH_HELD", "highest epoch ever granted, 0 none"}),
    bound<&Status::lease_left_ds>({12, 1, u16, "LEASE_LEFT", "0.1 s"}),
    bound<&Status::cell_id>({13, 1, u16, "CELL_ID", "configured identity"}),
    bound<&Status::ack_seq>({14, 2, u32, "ACK_SEQ", "CMD_SEQ of the command answered last"}),
    bound<&Status::ack_command>({16, 1, u16, "ACK_CMD", "its command"}),
    bound<&Status::ack_result>({17, 1, u16, "ACK_RESULT", "see the table of results"}),
    bound<&Status::ack_detail>({18, 2, u32, "ACK_DETAIL", "an address, an offset, a receipt, a grant"}),
    bound<&Status::job_id>(
        {20, 8, bytes, "JOB_ID", "job stored, prepared, active, or finished and not cleared; 0 none"}),
    bound<&Status::token>({28, 2, u32, "TOKEN", "one-shot start token, never 0 when prepared"}),
    bound<&Status::job_state>({30, 1, u16, "JOB_STATE", "see below"}),
    bound<&Status::job_result>({31, 1, u16, "JOB_RESULT", "see below"}),
    bound<&Status::progress>({32, 1, u16, "PROGRESS", "0..10000 = 0.01 %"}),
    bound<&Status::elapsed_s>({33, 2, u32, "ELAPSED", "s"}),
    bound<&Status::remaining_s>({35, 2, u32, "REMAINING", "s, 0xFFFFFFFF unknown"}),
    bound<&Status::block_no>({37, 2, u32, "BLOCK_NO", "program line being executed: 1000000 * chunk + line"}),
    bound<&Status::tool_no>({39, 1, u16, "TOOL_NO", "in the spindle"}),
    bound_axis<&Status::tip, 0>({40, 2, i32, "TIP_X", "0.01 mm, base frame of the program"}),
    bound_axis<&Status::tip, 1>({42, 2, i32, "TIP_Y", "0.01 mm"}),
    bound_axis<&Status::tip, 2>({44, 2, i32, "TIP_Z", "0.01 mm"}),
    bound<&Status::feed_override>({46, 1, u16, "FEED_OVR", "0.01 %"}),
    bound<&Status::spindle_rpm>({47, 1, u16, "SPINDLE", "rpm"}),
    bound<&Status::alarms>({48, 1, u16, "ALARMS", "number active"}),
    bound<&Status::alarm_code>({49, 2, u32, "ALARM_CODE", "of the first alarm"}),
    bound<&Status::alarm_block>({51, 2, u32, "ALARM_BLOCK", "program block of the first alarm"}),
    bound<&Status::alarm_text>({53, 8, text, "ALARM_TEXT", "of the first alarm"}),
    bound<&Status::transfer_state>({61, 1, u16, "XFER_STATE", "0 idle, 1 open, 2 complete, 3 hash mismatch"}),
    bound<&Status::transfer_next>({62, 2, u32, "XFER_NEXT", "bytes accepted so far, the next OFFSET"}),
    bound<&Status::transfer_result>({64, 1, u16, "XFER_RESULT", "result of the last chunk"}),
    bound<&Status::store_free_kib>({65, 2, u32, "STORE_FREE", "KiB"}),
    bound<&Status::event_no>({67, 2, u32, "EVENT_NO", "head of the cell's event log"}),
    bound<&Status::file_sha256>({69, 16, bytes, "FILE_SHA256", "computed by the cell over what it stored"}),
    bound<&Status::starts_total>({85, 2, u32, "STARTS_TOTAL", "starts since first boot, persistent"}),
    bound<&Status::cell_time_ms>({87, 4, u64, "CELL_TIME", "unix ms"}),
    bound<&Status::owner_held>({91, 2, u32, "OWNER_HELD", "owner of the lease, 0 without one"}),
    bound<&Status::ack_owner>({93, 2, u32, "ACK_OWNER", "whose command ACK_* answer"}),
    bound<&Status::bad_frames>({95, 1, u16, "BAD_FRAMES", "commands that could not be trusted, wraps"}),
    checksum<Status>({96, 2, u32, "STATUS_CRC", "CRC-32 over 0..95"}),
    bound<&Status::bad_reason>({98, 1, u16, "BAD_REASON", "why the last of BAD_FRAMES"}),
    bound<&Status::snapshot>({99, 1, u16, "SNAP_END", "equals SNAP_BEGIN"}, FieldRole::snap_end),
};

constexpr LayoutRow<ResultRecord> result_rows[] = {
    bound<&ResultRecord::job_id>({200, 8, bytes, "JOB_ID", "that was asked for; of QUERY_FILE the job found"}),
    bound<&ResultRecord::state, ResultRecord>({208, 1, u16, "JOB_STATE", "0: the cell does not know it"}),
    bound<&ResultRecord::result, ResultRecord>({209, 1, u16, "JOB_RESULT", ""}),
    bound<&ResultRecord::starts, ResultRecord>({210, 2, u32, "STARTS", "0 or 1"}),
    bound<&ResultRecord::start_epoch, ResultRecord>({212, 2, u32, "START_EPOCH", ""}),
    bound<&ResultRecord::start_seq, ResultRecord>({214, 2, u32, "START_SEQ", ""}),
    bound<&ResultRecord::start_time_ms, ResultRecord>({216, 4, u64, "START_TIME", "unix ms"}),
    bound<&ResultRecord::end_time_ms, ResultRecord>({220, 4, u64, "END_TIME", "unix ms"}),
    bound<&ResultRecord::file_sha256, ResultRecord>({224, 16, bytes, "FILE_SHA256", "of what was carved"}),
    bound<&ResultRecord::last_block, ResultRecord>({240, 2, u32, "LAST_BLOCK", ""}),
    bound<&ResultRecord::query_seq>({242, 2, u32, "QUERY_SEQ", "CMD_SEQ of the query"}),
    bound<&ResultRecord::query_owner>({244, 2, u32, "QUERY_OWNER", "who asked"}),
    bound<&ResultRecord::grant_epoch>({246, 2, u32, "GRANT_EPOCH", "of the CLAIM with the number in ARG0; 0 unknown"}),
    reserved<ResultRecord>({248, 10, words, "reserved", "0"}),
    checksum<ResultRecord>({258, 2, u32, "CRC", "CRC-32 over 200..257"}),
};

constexpr LayoutRow<Identity> identity_rows[] = {
    fixed<Identity, cell_magic>({300, 1, u16, "MAGIC", "0x5143"}, FieldRole::magic),
    bound<&Identity::version>({301, 1, u16, "VERSION", "0x0101"}, FieldRole::version),
    bound<&Identity::store_id>({302, 8, bytes, "STORE_ID", "random, drawn when the store was made, never again"}),
    bound<&Identity::boot_count>({310, 2, u32, "BOOT_COUNT", "as in STATUS"}),
    bound<&Identity::epoch_held>({312, 2, u32, "EPOCH_HELD", "as in STATUS"}),
    bound<&Identity::starts_total>({314, 2, u32, "STARTS_TOTAL", "as in STATUS"}),
    bound<&Identity::store_created_ms>({316, 4, u64, "STORE_CREATED", "unix ms"}),
    bound<&Identity::checks_store>({320, 1, u16, "STORE_CHECK", "1: the cell finds an older copy of its store"}),
    reserved<Identity>({321, 1, words, "reserved", "0"}),
    checksum<Identity>({322, 2, u32, "CRC", "CRC-32 over 300..321"}),
};

constexpr LayoutRow<Command> command_rows[] = {
    fixed<Command, cell_magic>({0, 1, u16, "MAGIC", "0x5143"}, FieldRole::magic),
    fixed<Command, command_version>({1, 1, u16, "VERSION", "0x0100, the form of this block"}, FieldRole::version),
    bound<&Command::epoch>({2, 2, u32, "EPOCH", "fencing number"}),
    bound<&Command::seq>({4, 2, u32, "CMD_SEQ", "1.., strictly rising over the owner's life"}),
    bound<&Command::command>({6, 1, u16, "CMD", "see below"}),
    reserved<Command>({7, 1, u16, "CMD_FLAGS", "reserved 0"}),
    bound<&Command::job_id>(
        {8, 8, bytes, "JOB_ID", "0 for Reset, Clear, SET_MODE, QUERY_FILE; all ones: any job (Abort)"}),
    bound<&Command::token>({16, 2, u32, "TOKEN", "for Start"}),
    bound<&Command::arg0>(
        {18, 2, u32, "ARG0", "CLAIM: takeover code; SET_MODE: mode; PREPARE: receipt; QUERY: a grant"}),
    bound<&Command::arg1>({20, 2, u32, "ARG1", "CLAIM: the owner's secret"}),
    bound<&Command::file_sha256>(
        {22, 16, bytes, "FILE_SHA256", "checked by STORE, VERIFY, PREPARE, Start; asked for by QUERY_FILE"}),
    bound<&Command::owner>({38, 2, u32, "OWNER", "random, not 0"}),
    reserved<Command>({40, 18, words, "reserved", "0"}),
    checksum<Command>({58, 2, u32, "CRC", "CRC-32 over 0..57"}),
};

constexpr LayoutRow<WireTicket> ticket_rows[] = {
    bound<&WireTicket::ticket_version>({100, 1, u16, "TICKET_VERSION", "1"}),
    bound<&WireTicket::job_id>({101, 8, bytes, "JOB_ID", "UUID"}),
    bound<&WireTicket::file_sha256>({109, 16, bytes, "FILE_SHA256", ""}),
    bound<&WireTicket::file_size>({125, 2, u32, "FILE_SIZE", "bytes"}),
    bound<&WireTicket::transfer>({127, 1, u16, "TRANSFER", "1 drop folder, 2 chunks"}),
    bound<&WireTicket::file_name>(
        {128, 16, text, "FILE_NAME", "1 to 32 of A-Z a-z 0-9 . _ -, not beginning with a dot"}),
    bound<&WireTicket::unit>({144, 1, u16, "UNIT", "1 mm"}),
    bound_axis<&WireTicket::box_min, 0>({145, 2, i32, "BOX_MIN_X", "0.01 mm, base frame of the program"}),
    bound_axis<&WireTicket::box_min, 1>({147, 2, i32, "BOX_MIN_Y", "0.01 mm"}),
    bound_axis<&WireTicket::box_min, 2>({149, 2, i32, "BOX_MIN_Z", "0.01 mm"}),
    bound_axis<&WireTicket::box_max, 0>({151, 2, i32, "BOX_MAX_X", "0.01 mm"}),
    bound_axis<&WireTicket::box_max, 1>({153, 2, i32, "BOX_MAX_Y", "0.01 mm"}),
    bound_axis<&WireTicket::box_max, 2>({155, 2, i32, "BOX_MAX_Z", "0.01 mm"}),
    bound_axis<&WireTicket::stock, 0>({157, 2, i32, "STOCK_X", "0.01 mm"}),
    bound_axis<&WireTicket::stock, 1>({159, 2, i32, "STOCK_Y", "0.01 mm"}),
    bound_axis<&WireTicket::stock, 2>({161, 2, i32, "STOCK_Z", "0.01 mm"}),
    bound<&WireTicket::material>({163, 1, u16, "MATERIAL", "0 unspecified, 1 PU foam, 2 EPS, 3 XPS, 4 other"}),
    bound<&WireTicket::tool_no>({164, 1, u16, "TOOL_NO", "first tool"}),
    bound<&WireTicket::tool_diameter_um>({165, 2, u32, "TOOL_DIAMETER", "0.001 mm, largest"}),
    bound<&WireTicket::spindle_max_rpm>({167, 1, u16, "SPINDLE_MAX", "rpm"}),
    bound<&WireTicket::feed_max_mm_per_min>({168, 2, u32, "FEED_MAX", "mm/min"}),
    bound<&WireTicket::estimated_time_s>({170, 2, u32, "EST_TIME", "s"}),
    bound<&WireTicket::base_plane>({172, 1, u16, "BASE_PLANE", "index of the cap in the manifest, 0xFFFF none"}),
    bound<&WireTicket::piece_no>({173, 1, u16, "PIECE_NO", "1.."}),
    bound<&WireTicket::piece_count>({174, 1, u16, "PIECE_COUNT", ""}),
    bound<&WireTicket::project_id>({175, 8, bytes, "PROJECT_ID", ""}),
    bound<&WireTicket::created_ms>({183, 4, u64, "CREATED", "unix ms"}),
    bound<&WireTicket::on_link_loss>({187, 1, u16, "ON_LINK_LOSS", "0 continue, 1 hold"}),
    bound<&WireTicket::requirements>({188, 1, u16, "REQUIREMENTS", "b0 rehearsal required"}),
    bound<&WireTicket::part>({189, 1, u16, "PART", "1..PARTS; 0: undivided"}),
    bound<&WireTicket::parts>({190, 1, u16, "PARTS", "parts of the piece; 0 with PART"}),
    reserved<WireTicket>({191, 2, words, "reserved", "0"}),
    bound<&WireTicket::cell_id>({193, 1, u16, "CELL_ID", "of the cell it is made for"}),
    bound<&WireTicket::made_for>({194, 1, u16, "MADE_FOR", "b0 a simulated cell"}),
    bound<&WireTicket::key_id>({195, 2, u32, "KEY_ID", "first 4 bytes of the SHA-256 of the public key"}),
    reserved<WireTicket>({197, 1, words, "reserved", "0"}),
    checksum<WireTicket>({198, 2, u32, "CRC", "CRC-32 over 100..197"}),
};

constexpr LayoutRow<TicketSignature> signature_rows[] = {
    bound<&TicketSignature::signature>(
        {200, 32, bytes, "SIGNATURE",
         "Ed25519 over \"QCHOPPER-TICKET-1\" and the bytes of 100..197; all zero: unsigned"}),
};

void write_length(const Chunk& from, const Field&, RegisterWriter& to) {
    to.u16(static_cast<std::uint16_t>(from.data.size()));
}
void read_length(Chunk& to, const Field&, RegisterReader& from) {
    // One byte more than a chunk holds shows that LEN is too large; a larger LEN need not allocate more.
    to.data.resize(std::min<std::size_t>(from.u16(), max_chunk_bytes + 1U));
}
void write_data(const Chunk& from, const Field&, RegisterWriter& to) {
    to.bytes(from.data);
}
void read_data(Chunk& to, const Field&, RegisterReader& from) {
    from.bytes(to.data);
}

constexpr LayoutRow<Chunk> chunk_rows[] = {
    bound<&Chunk::offset>({300, 2, u32, "OFFSET", "must be XFER_NEXT"}),
    LayoutRow<Chunk>{{302, 1, u16, "LEN", "1..232 bytes"}, FieldRole::value, write_length, read_length},
    bound<&Chunk::crc>({303, 2, u32, "CRC", "CRC-32 over EPOCH, OWNER, JOB_ID, OFFSET, LEN and the data"}),
    LayoutRow<Chunk>{
        {305, 116, bytes, "DATA", "ceil(LEN/2) registers of it are written"}, FieldRole::value, write_data, read_data},
};

constexpr LayoutRow<Heartbeat> heartbeat_rows[] = {
    bound<&Heartbeat::epoch>({500, 2, u32, "EPOCH", ""}),
    bound<&Heartbeat::owner>({502, 2, u32, "OWNER", ""}),
    bound<&Heartbeat::counter>({504, 1, u16, "COUNTER", "any, then it must change"}),
};

template <class... T>
constexpr std::tuple<std::span<const LayoutRow<T>>...> tables_of(std::span<const LayoutRow<T>>... rows) {
    return {rows...};
}
constexpr std::tuple tables =
    tables_of<Status, ResultRecord, Identity, Command, WireTicket, TicketSignature, Chunk, Heartbeat>(
        status_rows, result_rows, identity_rows, command_rows, ticket_rows, signature_rows, chunk_rows, heartbeat_rows);

template <const auto& rows>
constexpr std::array fields = fields_of(rows);
static_assert(fields<chunk_rows>.back().address == fields<chunk_rows>.front().address + chunk_head);

}  // namespace

constexpr Block status_block{"STATUS", Side::input, 0, 100, false, fields<status_rows>, "what the cell says of itself"};
constexpr Block result_block{
    "RESULT", Side::input, 200, 60, false, fields<result_rows>, "the answer to QUERY and QUERY_FILE"};
constexpr Block identity_block{
    "IDENTITY", Side::input, 300, 24, false, fields<identity_rows>, "which memory the cell has"};
constexpr Block command_block{"COMMAND", Side::holding, 0, 60, true, fields<command_rows>, "one command"};
constexpr Block ticket_block{"TICKET", Side::holding, 100, 100, true, fields<ticket_rows>, "the job in numbers"};
constexpr Block signature_block{"SIGNATURE", Side::holding, 200, 32, true, fields<signature_rows>, "of the ticket"};
constexpr Block chunk_block{"CHUNK", Side::holding, 300, 121, true, fields<chunk_rows>, "a slice of the job file"};
constexpr Block heartbeat_block{"HEARTBEAT", Side::holding, 500, 5, true, fields<heartbeat_rows>, "keeps the lease"};

template <class T>
std::span<const LayoutRow<T>> rows_of() {
    return std::get<std::span<const LayoutRow<T>>>(tables);
}
template std::span<const LayoutRow<Status>> rows_of();
template std::span<const LayoutRow<ResultRecord>> rows_of();
template std::span<const LayoutRow<Identity>> rows_of();
template std::span<const LayoutRow<Command>> rows_of();
template std::span<const LayoutRow<WireTicket>> rows_of();
template std::span<const LayoutRow<TicketSignature>> rows_of();
template std::span<const LayoutRow<Chunk>> rows_of();
template std::span<const LayoutRow<Heartbeat>> rows_of();

std::span<const Block* const> all_blocks() {
    static constexpr std::array<const Block*, 8> blocks{&status_block,  &result_block,   &identity_block,
                                                        &command_block, &ticket_block,   &signature_block,
                                                        &chunk_block,   &heartbeat_block};
    return blocks;
}

const Field* field_named(const Block& block, const char* field_name) {
    for (const Field& field : block.fields) {
        if (std::strcmp(field.name, field_name) == 0) return &field;
    }
    return nullptr;
}

std::uint16_t address_of(const Block& block, const char* field_name) {
    const Field* const field = field_named(block, field_name);
    assert(field != nullptr);
    return field->address;
}

}  // namespace qchopper
