// Walks the rows of a block's table (layout.h), once to encode or decode and once for each mark to check. O(registers
// of the block), at most 125; the checksum is CRC-32 of IEEE 802.3.

#include "devices/wire/codec.h"

#include <cassert>
#include <utility>

#include "devices/wire/layout.h"

namespace qchopper {
namespace {

// The oldest version of a block that is taken.
template <class T>
constexpr std::uint16_t oldest_version = map_version;
template <>
constexpr std::uint16_t oldest_version<Command> = command_version;

bool is_taken(std::uint16_t version, std::uint16_t oldest) {
    return version >> 8 == oldest >> 8 && version >= oldest;
}

// Registers before the first field of that role; npos if the block has none.
template <class T>
std::size_t offset_of(FieldRole role) {
    const std::span<const LayoutRow<T>> rows = rows_of<T>();
    for (const LayoutRow<T>& row : rows) {
        if (row.role == role) return static_cast<std::size_t>(row.field.address - rows.front().field.address);
    }
    return std::string::npos;
}

template <class T>
std::uint32_t crc_of(std::span<const std::uint16_t> block) {
    return RegisterReader(block.subspan(offset_of<T>(FieldRole::crc))).u32();
}

template <class T>
bool has(FieldRole role) {
    return offset_of<T>(role) != std::string::npos;
}

template <class T>
BlockFault fault_of(const Block& block, std::span<const std::uint16_t> registers) {
    if (registers.size() != block.count) return BlockFault::length;
    if (is_all_zero(registers)) return BlockFault::empty;
    const auto at = [&](FieldRole role) { return registers[offset_of<T>(role)]; };
    if (has<T>(FieldRole::magic) && at(FieldRole::magic) != cell_magic) return BlockFault::magic;
    if (has<T>(FieldRole::version) && !is_taken(at(FieldRole::version), oldest_version<T>)) return BlockFault::version;
    if (has<T>(FieldRole::snap_end) && at(FieldRole::snap_begin) != at(FieldRole::snap_end)) return BlockFault::torn;
    if (!has<T>(FieldRole::crc)) return BlockFault::none;
    return crc32_of_registers(registers.first(offset_of<T>(FieldRole::crc))) == crc_of<T>(registers) ? BlockFault::none
                                                                                                     : BlockFault::crc;
}

template <class T>
Registers encoded(const T& value) {
    const std::span<const LayoutRow<T>> rows = rows_of<T>();
    RegisterWriter writer;
    for (const LayoutRow<T>& row : rows) {
        assert(writer.registers().size() == static_cast<std::size_t>(row.field.address - rows.front().field.address));
        row.write(value, row.field, writer);
    }
    return writer.registers();
}

template <class T>
T read_values(std::span<const std::uint16_t> registers) {
    T value;
    RegisterReader reader(registers);
    for (const LayoutRow<T>& row : rows_of<T>()) row.read(value, row.field, reader);
    return value;
}

template <class T>
Decoded<T> decoded(const Block& block, std::span<const std::uint16_t> registers) {
    const BlockFault fault = fault_of<T>(block, registers);
    if (fault != BlockFault::none) return {fault, {}};
    return {BlockFault::none, read_values<T>(registers)};
}

template <class T>
std::optional<std::uint16_t> used_reserved(std::span<const std::uint16_t> registers) {
    const std::span<const LayoutRow<T>> rows = rows_of<T>();
    for (const LayoutRow<T>& row : rows) {
        if (row.role != FieldRole::reserved) continue;
        for (std::uint16_t at = row.field.address; at < row.field.address + row.field.count; ++at) {
            if (registers[at - rows.front().field.address] != 0) return at;
        }
    }
    return std::nullopt;
}

}  // namespace

const char* describe(BlockFault fault) {
    constexpr const char* texts[] = {"right",
                                     "of the wrong length",
                                     "all zero",
                                     "without the magic number of a QChopper cell",
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

Registers encode(const Identity& identity) {
    return encoded(identity);
}
Decoded<Identity> decode_identity(std::span<const std::uint16_t> block) {
    return decoded<Identity>(identity_block, block);
}

Registers encode(const Command& command) {
    return encoded(command);
}
Decoded<Command> decode_command(std::span<const std::uint16_t> block) {
    return decoded<Command>(command_block, block);
}
std::optional<std::uint16_t> used_reserved_of_command(std::span<const std::uint16_t> block) {
    assert(block.size() == command_block.count);
    return used_reserved<Command>(block);
}
std::optional<std::uint16_t> used_reserved_of_ticket(std::span<const std::uint16_t> block) {
    assert(block.size() == ticket_block.count);
    return used_reserved<WireTicket>(block);
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
    Chunk chunk = read_values<Chunk>(block);
    const std::size_t length = chunk.data.size();
    if (length < 1 || length > max_chunk_bytes || block.size() != chunk_head + (length + 1) / 2) {
        return {BlockFault::length, {}};
    }
    return {BlockFault::none, std::move(chunk)};
}

std::uint32_t chunk_crc(std::uint32_t epoch, std::uint32_t owner, const Uuid& job_id, std::uint32_t offset,
                        std::span<const std::uint8_t> data) {
    RegisterWriter head;
    head.u32(epoch).u32(owner).bytes(job_id).u32(offset).u16(static_cast<std::uint16_t>(data.size()));
    // Over bytes, not registers: the padding byte of an odd chunk is not covered.
    std::vector<std::uint8_t> bytes = bytes_of(head.registers());
    bytes.insert(bytes.end(), data.begin(), data.end());
    return crc32_of(bytes);
}

}  // namespace qchopper
