#include "devices/codec.h"

namespace qchopper {
namespace {

bool is_our_major(std::uint16_t version) {
    return version >> 8 == map_version >> 8;
}

std::uint32_t crc_at(std::span<const std::uint16_t> block, std::size_t at) {
    return WordReader(block.subspan(at)).u32();
}

Uuid read_id(WordReader& reader) {
    Uuid id{};
    reader.bytes(id);
    return id;
}

Sha256 read_digest(WordReader& reader) {
    Sha256 digest{};
    reader.bytes(digest);
    return digest;
}

std::array<std::int32_t, 3> read_three(WordReader& reader) {
    std::array<std::int32_t, 3> three{};
    for (std::int32_t& value : three) value = reader.i32();
    return three;
}

WordFault fault_of(std::span<const std::uint16_t> block, std::uint16_t count, std::size_t crc_address) {
    if (block.size() != count) return WordFault::length;
    if (is_all_zero(block)) return WordFault::empty;
    return crc32_of_words(block.first(crc_address)) == crc_at(block, crc_address) ? WordFault::none : WordFault::crc;
}

}  // namespace

const char* words(WordFault fault) {
    switch (fault) {
        case WordFault::none:
            return "right";
        case WordFault::length:
            return "of the wrong length";
        case WordFault::empty:
            return "all zero";
        case WordFault::magic:
            return "without the mark of a cell of ours";
        case WordFault::version:
            return "of another version of the register map";
        case WordFault::crc:
            return "damaged (checksum)";
        case WordFault::torn:
            return "torn (two snapshots in one)";
    }
    return "";
}

Words encode(const Status& s) {
    WordWriter w;
    w.u16(cell_magic).u16(s.version).u16(s.snapshot).u16(s.heartbeat).u32(s.boot_count);
    w.u16(static_cast<std::uint16_t>(s.unit_mode)).u16(static_cast<std::uint16_t>(s.state));
    w.u16(static_cast<std::uint16_t>(s.state_before)).u16(s.flags).u32(s.epoch_held).u16(s.lease_left_ds);
    w.u16(s.cell_id).u32(s.ack_seq).u16(static_cast<std::uint16_t>(s.ack_command));
    w.u16(static_cast<std::uint16_t>(s.ack_result)).u32(s.ack_detail).bytes(s.job_id).u32(s.token);
    w.u16(static_cast<std::uint16_t>(s.job_state)).u16(static_cast<std::uint16_t>(s.job_result)).u16(s.progress);
    w.u32(s.elapsed_s).u32(s.remaining_s).u32(s.block_no).u16(s.tool_no);
    w.i32(s.tip[0]).i32(s.tip[1]).i32(s.tip[2]).u16(s.feed_override).u16(s.spindle_rpm);
    w.u16(s.alarms).u32(s.alarm_code).u32(s.alarm_block).text(s.alarm_text, 8);
    w.u16(static_cast<std::uint16_t>(s.transfer_state)).u32(s.transfer_next);
    w.u16(static_cast<std::uint16_t>(s.transfer_result)).u32(s.store_free_kib).u32(s.event_no).bytes(s.file_sha256);
    w.u32(s.starts_total).u64(s.cell_time_ms).u32(s.owner_held).u32(s.ack_owner).u16(s.bad_frames).crc();
    w.u16(static_cast<std::uint16_t>(s.bad_reason)).u16(s.snapshot);
    return w.words();
}

Decoded<Status> decode_status(std::span<const std::uint16_t> block) {
    Decoded<Status> decoded;
    if (block.size() != status_block.count) return {WordFault::length, {}};
    if (is_all_zero(block)) return {WordFault::empty, {}};
    if (block[0] != cell_magic) return {WordFault::magic, {}};
    if (!is_our_major(block[1])) return {WordFault::version, {}};
    if (block[2] != block[99]) return {WordFault::torn, {}};
    if (crc32_of_words(block.first(96)) != crc_at(block, 96)) return {WordFault::crc, {}};
    WordReader r(block);
    Status& s = decoded.value;
    r.skip(1);
    s.version = r.u16();
    s.snapshot = r.u16();
    s.heartbeat = r.u16();
    s.boot_count = r.u32();
    s.unit_mode = static_cast<UnitMode>(r.u16());
    s.state = static_cast<PackState>(r.u16());
    s.state_before = static_cast<PackState>(r.u16());
    s.flags = r.u16();
    s.epoch_held = r.u32();
    s.lease_left_ds = r.u16();
    s.cell_id = r.u16();
    s.ack_seq = r.u32();
    s.ack_command = static_cast<CellCommand>(r.u16());
    s.ack_result = static_cast<AckResult>(r.u16());
    s.ack_detail = r.u32();
    s.job_id = read_id(r);
    s.token = r.u32();
    s.job_state = static_cast<JobState>(r.u16());
    s.job_result = static_cast<JobResult>(r.u16());
    s.progress = r.u16();
    s.elapsed_s = r.u32();
    s.remaining_s = r.u32();
    s.block_no = r.u32();
    s.tool_no = r.u16();
    s.tip = read_three(r);
    s.feed_override = r.u16();
    s.spindle_rpm = r.u16();
    s.alarms = r.u16();
    s.alarm_code = r.u32();
    s.alarm_block = r.u32();
    s.alarm_text = r.text(8);
    s.transfer_state = static_cast<TransferState>(r.u16());
    s.transfer_next = r.u32();
    s.transfer_result = static_cast<AckResult>(r.u16());
    s.store_free_kib = r.u32();
    s.event_no = r.u32();
    s.file_sha256 = read_digest(r);
    s.starts_total = r.u32();
    s.cell_time_ms = r.u64();
    s.owner_held = r.u32();
    s.ack_owner = r.u32();
    s.bad_frames = r.u16();
    r.skip(2);
    s.bad_reason = static_cast<AckResult>(r.u16());
    return decoded;
}

Words encode(const ResultWords& result) {
    WordWriter w;
    w.bytes(result.job_id).u16(static_cast<std::uint16_t>(result.job_state));
    w.u16(static_cast<std::uint16_t>(result.job_result)).u32(result.starts).u32(result.start_epoch);
    w.u32(result.start_seq).u64(result.start_time_ms).u64(result.end_time_ms).bytes(result.file_sha256);
    w.u32(result.last_block).u32(result.query_seq).u32(result.query_owner).zeros(12).crc();
    return w.words();
}

Decoded<ResultWords> decode_result(std::span<const std::uint16_t> block) {
    Decoded<ResultWords> decoded{fault_of(block, result_block.count, 58), {}};
    if (!decoded.is_ok()) return decoded;
    WordReader r(block);
    ResultWords& result = decoded.value;
    result.job_id = read_id(r);
    result.job_state = static_cast<JobState>(r.u16());
    result.job_result = static_cast<JobResult>(r.u16());
    result.starts = r.u32();
    result.start_epoch = r.u32();
    result.start_seq = r.u32();
    result.start_time_ms = r.u64();
    result.end_time_ms = r.u64();
    result.file_sha256 = read_digest(r);
    result.last_block = r.u32();
    result.query_seq = r.u32();
    result.query_owner = r.u32();
    return decoded;
}

Words encode(const Command& command) {
    WordWriter w;
    w.u16(cell_magic).u16(map_version).u32(command.epoch).u32(command.seq);
    w.u16(static_cast<std::uint16_t>(command.command)).u16(0).bytes(command.job_id).u32(command.token);
    w.u32(command.arg0).u32(command.arg1).bytes(command.file_sha256).u32(command.owner).zeros(18).crc();
    return w.words();
}

Decoded<Command> decode_command(std::span<const std::uint16_t> block) {
    if (block.size() != command_block.count) return {WordFault::length, {}};
    if (is_all_zero(block)) return {WordFault::empty, {}};
    if (block[0] != cell_magic) return {WordFault::magic, {}};
    if (!is_our_major(block[1])) return {WordFault::version, {}};
    if (crc32_of_words(block.first(58)) != crc_at(block, 58)) return {WordFault::crc, {}};
    Decoded<Command> decoded;
    WordReader r(block);
    Command& command = decoded.value;
    r.skip(2);
    command.epoch = r.u32();
    command.seq = r.u32();
    command.command = static_cast<CellCommand>(r.u16());
    r.skip(1);
    command.job_id = read_id(r);
    command.token = r.u32();
    command.arg0 = r.u32();
    command.arg1 = r.u32();
    command.file_sha256 = read_digest(r);
    command.owner = r.u32();
    return decoded;
}

Words encode(const TicketWords& t) {
    WordWriter w;
    w.u16(t.ticket_version).bytes(t.job_id).bytes(t.file_sha256).u32(t.file_size);
    w.u16(static_cast<std::uint16_t>(t.transfer)).text(t.file_name, 16).u16(t.unit);
    for (const auto* three : {&t.box_min, &t.box_max, &t.stock}) {
        for (const std::int32_t value : *three) w.i32(value);
    }
    w.u16(t.material).u16(t.tool_no).u32(t.tool_diameter_um).u16(t.spindle_max_rpm).u32(t.feed_max_mm_per_min);
    w.u32(t.estimated_time_s).u16(t.base_plane).u16(t.piece_no).u16(t.piece_count).bytes(t.project_id);
    w.u64(t.created_ms).u16(static_cast<std::uint16_t>(t.on_link_loss)).u16(t.requirements).zeros(4);
    w.u16(t.cell_id).u16(t.made_for).u32(t.key_id).zeros(1).crc();
    return w.words();
}

Decoded<TicketWords> decode_ticket(std::span<const std::uint16_t> block) {
    Decoded<TicketWords> decoded{fault_of(block, ticket_block.count, 98), {}};
    if (!decoded.is_ok()) return decoded;
    WordReader r(block);
    TicketWords& t = decoded.value;
    t.ticket_version = r.u16();
    t.job_id = read_id(r);
    t.file_sha256 = read_digest(r);
    t.file_size = r.u32();
    t.transfer = static_cast<Transfer>(r.u16());
    t.file_name = r.text(16);
    t.unit = r.u16();
    t.box_min = read_three(r);
    t.box_max = read_three(r);
    t.stock = read_three(r);
    t.material = r.u16();
    t.tool_no = r.u16();
    t.tool_diameter_um = r.u32();
    t.spindle_max_rpm = r.u16();
    t.feed_max_mm_per_min = r.u32();
    t.estimated_time_s = r.u32();
    t.base_plane = r.u16();
    t.piece_no = r.u16();
    t.piece_count = r.u16();
    t.project_id = read_id(r);
    t.created_ms = r.u64();
    t.on_link_loss = static_cast<LinkLoss>(r.u16());
    t.requirements = r.u16();
    r.skip(4);
    t.cell_id = r.u16();
    t.made_for = r.u16();
    t.key_id = r.u32();
    return decoded;
}

Words encode(const Heartbeat& heartbeat) {
    return WordWriter().u32(heartbeat.epoch).u32(heartbeat.owner).u16(heartbeat.counter).words();
}

Decoded<Heartbeat> decode_heartbeat(std::span<const std::uint16_t> block) {
    if (block.size() != heartbeat_block.count) return {WordFault::length, {}};
    if (is_all_zero(block)) return {WordFault::empty, {}};
    WordReader r(block);
    Decoded<Heartbeat> decoded;
    decoded.value.epoch = r.u32();
    decoded.value.owner = r.u32();
    decoded.value.counter = r.u16();
    return decoded;
}

Words encode(const Chunk& chunk) {
    WordWriter w;
    w.u32(chunk.offset).u16(static_cast<std::uint16_t>(chunk.data.size())).u32(chunk.crc).bytes(chunk.data);
    return w.words();
}

Decoded<Chunk> decode_chunk(std::span<const std::uint16_t> block) {
    if (block.size() <= chunk_head) return {WordFault::length, {}};
    WordReader r(block);
    Decoded<Chunk> decoded;
    decoded.value.offset = r.u32();
    const std::size_t length = r.u16();
    decoded.value.crc = r.u32();
    if (length < 1 || length > max_chunk_bytes || block.size() != chunk_head + (length + 1) / 2) {
        return {WordFault::length, {}};
    }
    decoded.value.data.resize(length);
    r.bytes(decoded.value.data);
    return decoded;
}

std::uint32_t chunk_crc(std::uint32_t epoch, std::uint32_t owner, const Uuid& job_id, std::uint32_t offset,
                        std::span<const std::uint8_t> data) {
    // As bytes, not as words: an odd chunk has no padding byte in its sum.
    std::vector<std::uint8_t> bytes;
    const Words head = WordWriter()
                           .u32(epoch)
                           .u32(owner)
                           .bytes(job_id)
                           .u32(offset)
                           .u16(static_cast<std::uint16_t>(data.size()))
                           .words();
    for (const std::uint16_t word : head) {
        bytes.push_back(static_cast<std::uint8_t>(word >> 8));
        bytes.push_back(static_cast<std::uint8_t>(word & 0xFF));
    }
    bytes.insert(bytes.end(), data.begin(), data.end());
    return crc32_of(bytes);
}

}  // namespace qchopper
