#include "devices/codec.h"

#include <cassert>
#include <utility>

#include "devices/layout.h"

namespace qchopper {
namespace {

bool is_our_major(std::uint16_t version) {
    return version >> 8 == map_version >> 8;
}

// Words before the first field of that part, or the size of the block without one.
template <class T>
std::size_t offset_of(Part part) {
    const std::span<const Row<T>> rows = rows_of<T>();
    for (const Row<T>& row : rows) {
        if (row.part == part) return static_cast<std::size_t>(row.field.address - rows.front().field.address);
    }
    return std::string::npos;
}

template <class T>
std::uint32_t crc_of(std::span<const std::uint16_t> block) {
    return RegisterReader(block.subspan(offset_of<T>(Part::crc))).u32();
}

template <class T>
bool has(Part part) {
    return offset_of<T>(part) != std::string::npos;
}

template <class T>
BlockFault fault_of(const Block& block, std::span<const std::uint16_t> registers) {
    if (registers.size() != block.count) return BlockFault::length;
    if (is_all_zero(registers)) return BlockFault::empty;
    const auto at = [&](Part part) { return registers[offset_of<T>(part)]; };
    if (has<T>(Part::magic) && at(Part::magic) != cell_magic) return BlockFault::magic;
    if (has<T>(Part::version) && !is_our_major(at(Part::version))) return BlockFault::version;
    if (has<T>(Part::snap_end) && at(Part::snap_begin) != at(Part::snap_end)) return BlockFault::torn;
    if (!has<T>(Part::crc)) return BlockFault::none;
    return crc32_of_registers(registers.first(offset_of<T>(Part::crc))) == crc_of<T>(registers) ? BlockFault::none
                                                                                                : BlockFault::crc;
}

template <class T>
Registers encoded(const T& value) {
    const std::span<const Row<T>> rows = rows_of<T>();
    RegisterWriter writer;
    for (const Row<T>& row : rows) {
        assert(writer.registers().size() == static_cast<std::size_t>(row.field.address - rows.front().field.address));
        row.put(value, row.field, writer);
    }
    return writer.registers();
}

template <class T>
T taken(std::span<const std::uint16_t> registers) {
    T value;
    RegisterReader reader(registers);
    for (const Row<T>& row : rows_of<T>()) row.take(value, row.field, reader);
    return value;
}

template <class T>
Decoded<T> decoded(const Block& block, std::span<const std::uint16_t> registers) {
    const BlockFault fault = fault_of<T>(block, registers);
    if (fault != BlockFault::none) return {fault, {}};
    return {BlockFault::none, taken<T>(registers)};
}

}  // namespace

const char* describe(BlockFault fault) {
    constexpr const char* texts[] = {"right",
                                     "of the wrong length",
                                     "all zero",
                                     "without the mark of a cell of ours",
                                     "of another version of the register map",
                                     "damaged (checksum)",
                                     "torn (two snapshots in one)"};  // in the order of BlockFault
    return texts[static_cast<std::size_t>(fault)];
}

Registers encode(const Status& status) {
    return encoded(status);
}
Decoded<Status> decode_status(std::span<const std::uint16_t> block) {
    return decoded<Status>(status_block, block);
}

Registers encode(const ResultRecord& result) {
    return encoded(result);
}
Decoded<ResultRecord> decode_result(std::span<const std::uint16_t> block) {
    return decoded<ResultRecord>(result_block, block);
}

Registers encode(const Command& command) {
    return encoded(command);
}
Decoded<Command> decode_command(std::span<const std::uint16_t> block) {
    return decoded<Command>(command_block, block);
}
std::uint32_t command_crc(std::span<const std::uint16_t> block) {
    assert(block.size() == command_block.count);
    return crc_of<Command>(block);
}

Registers encode(const WireTicket& ticket) {
    return encoded(ticket);
}
Decoded<WireTicket> decode_ticket(std::span<const std::uint16_t> block) {
    return decoded<WireTicket>(ticket_block, block);
}

Registers encode(const Heartbeat& heartbeat) {
    return encoded(heartbeat);
}
Decoded<Heartbeat> decode_heartbeat(std::span<const std::uint16_t> block) {
    return decoded<Heartbeat>(heartbeat_block, block);
}

Registers encode(const Chunk& chunk) {
    return encoded(chunk);
}
Decoded<Chunk> decode_chunk(std::span<const std::uint16_t> block) {
    if (block.size() <= chunk_head) return {BlockFault::length, {}};
    Chunk chunk = taken<Chunk>(block);
    const std::size_t length = chunk.data.size();
    if (length < 1 || length > max_chunk_bytes || block.size() != chunk_head + (length + 1) / 2) {
        return {BlockFault::length, {}};
    }
    return {BlockFault::none, std::move(chunk)};
}

std::uint32_t chunk_crc(std::uint32_t epoch, std::uint32_t owner, const Uuid& job_id, std::uint32_t offset,
                        std::span<const std::uint8_t> data) {
    // As bytes, not as words: an odd chunk has no padding byte in its sum.
    std::vector<std::uint8_t> bytes;
    const Registers head = RegisterWriter()
                               .u32(epoch)
                               .u32(owner)
                               .bytes(job_id)
                               .u32(offset)
                               .u16(static_cast<std::uint16_t>(data.size()))
                               .registers();
    for (const std::uint16_t word : head) {
        bytes.push_back(static_cast<std::uint8_t>(word >> 8));
        bytes.push_back(static_cast<std::uint8_t>(word & 0xFF));
    }
    bytes.insert(bytes.end(), data.begin(), data.end());
    return crc32_of(bytes);
}

}  // namespace qchopper
