// Walks the rows of a block's table (layout.h), once to encode or decode and once for each mark to check. O(registers
// of the block), at most 125; the checksum is CRC-32 of IEEE 802.3.

#include "devices/wire/codec.h"

#include <cassert>
#include <type_traits>

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
BlockFault fault_of(std::span<const std::uint16_t> registers) {
    const Field& last = rows_of<T>().back().field;
    const int count = last.address + last.count - rows_of<T>().front().field.address;
    if (registers.size() != static_cast<std::size_t>(count)) return BlockFault::length;
    if (is_all_zero(registers)) return BlockFault::empty;
    const auto at = [&](FieldRole role) { return registers[offset_of<T>(role)]; };
    if (has<T>(FieldRole::magic) && at(FieldRole::magic) != cell_magic) return BlockFault::magic;
    if (has<T>(FieldRole::version) && !is_taken(at(FieldRole::version), oldest_version<T>)) return BlockFault::version;
    if (has<T>(FieldRole::snap_end) && at(FieldRole::snap_begin) != at(FieldRole::snap_end)) return BlockFault::torn;
    if (!has<T>(FieldRole::crc)) return BlockFault::none;
    return crc32_of_registers(registers.first(offset_of<T>(FieldRole::crc))) == crc_of<T>(registers) ? BlockFault::none
                                                                                                     : BlockFault::crc;
}

// As many registers as its LEN says.
BlockFault fault_of_chunk(std::span<const std::uint16_t> registers) {
    constexpr std::size_t place_of_length = 2;
    const std::size_t length = registers.size() <= chunk_head ? 0U : registers[place_of_length];
    const bool is_right = length >= 1 && length <= max_chunk_bytes && registers.size() == chunk_head + (length + 1) / 2;
    return is_right ? BlockFault::none : BlockFault::length;
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

template <class T>
Registers encode(const T& value) {
    const std::span<const LayoutRow<T>> rows = rows_of<T>();
    RegisterWriter writer;
    for (const LayoutRow<T>& row : rows) {
        assert(writer.registers().size() == static_cast<std::size_t>(row.field.address - rows.front().field.address));
        row.write(value, row.field, writer);
    }
    return writer.registers();
}

template <class T>
Decoded<T> decode(std::span<const std::uint16_t> block) {
    Decoded<T> decoded;
    if constexpr (std::is_same_v<T, Chunk>) {
        decoded.fault = fault_of_chunk(block);
    } else {
        decoded.fault = fault_of<T>(block);
    }
    RegisterReader reader(block);
    for (const LayoutRow<T>& row : rows_of<T>()) {
        if (decoded.is_ok()) row.read(decoded.value, row.field, reader);
    }
    return decoded;
}

template <class T>
std::optional<std::uint16_t> used_reserved(std::span<const std::uint16_t> block) {
    const std::span<const LayoutRow<T>> rows = rows_of<T>();
    for (const LayoutRow<T>& row : rows) {
        if (row.role != FieldRole::reserved) continue;
        for (std::uint16_t at = row.field.address; at < row.field.address + row.field.count; ++at) {
            if (block[at - rows.front().field.address] != 0) return at;
        }
    }
    return std::nullopt;
}

template Registers encode(const Status&);
template Registers encode(const ResultRecord&);
template Registers encode(const Identity&);
template Registers encode(const Command&);
template Registers encode(const WireTicket&);
template Registers encode(const TicketSignature&);
template Registers encode(const Heartbeat&);
template Registers encode(const Chunk&);
template Decoded<Status> decode(std::span<const std::uint16_t>);
template Decoded<ResultRecord> decode(std::span<const std::uint16_t>);
template Decoded<Identity> decode(std::span<const std::uint16_t>);
template Decoded<Command> decode(std::span<const std::uint16_t>);
template Decoded<WireTicket> decode(std::span<const std::uint16_t>);
template Decoded<TicketSignature> decode(std::span<const std::uint16_t>);
template Decoded<Heartbeat> decode(std::span<const std::uint16_t>);
template Decoded<Chunk> decode(std::span<const std::uint16_t>);
template std::optional<std::uint16_t> used_reserved<Command>(std::span<const std::uint16_t>);
template std::optional<std::uint16_t> used_reserved<WireTicket>(std::span<const std::uint16_t>);

std::uint32_t command_crc(std::span<const std::uint16_t> block) {
    assert(block.size() == command_block.count);
    return crc_of<Command>(block);
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
