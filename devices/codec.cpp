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
    return WordReader(block.subspan(offset_of<T>(Part::crc))).u32();
}

template <class T>
bool has(Part part) {
    return offset_of<T>(part) != std::string::npos;
}

template <class T>
WordFault fault_of(const Block& block, std::span<const std::uint16_t> words) {
    if (words.size() != block.count) return WordFault::length;
    if (is_all_zero(words)) return WordFault::empty;
    const auto at = [&](Part part) { return words[offset_of<T>(part)]; };
    if (has<T>(Part::magic) && at(Part::magic) != cell_magic) return WordFault::magic;
    if (has<T>(Part::version) && !is_our_major(at(Part::version))) return WordFault::version;
    if (has<T>(Part::snap_end) && at(Part::snap_begin) != at(Part::snap_end)) return WordFault::torn;
    if (!has<T>(Part::crc)) return WordFault::none;
    return crc32_of_words(words.first(offset_of<T>(Part::crc))) == crc_of<T>(words) ? WordFault::none : WordFault::crc;
}

template <class T>
Words encoded(const T& value) {
    const std::span<const Row<T>> rows = rows_of<T>();
    WordWriter writer;
    for (const Row<T>& row : rows) {
        assert(writer.words().size() == static_cast<std::size_t>(row.field.address - rows.front().field.address));
        row.put(value, row.field, writer);
    }
    return writer.words();
}

template <class T>
T taken(std::span<const std::uint16_t> words) {
    T value;
    WordReader reader(words);
    for (const Row<T>& row : rows_of<T>()) row.take(value, row.field, reader);
    return value;
}

template <class T>
Decoded<T> decoded(const Block& block, std::span<const std::uint16_t> words) {
    const WordFault fault = fault_of<T>(block, words);
    if (fault != WordFault::none) return {fault, {}};
    return {WordFault::none, taken<T>(words)};
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

Words encode(const Status& status) {
    return encoded(status);
}
Decoded<Status> decode_status(std::span<const std::uint16_t> block) {
    return decoded<Status>(status_block, block);
}

Words encode(const ResultWords& result) {
    return encoded(result);
}
Decoded<ResultWords> decode_result(std::span<const std::uint16_t> block) {
    return decoded<ResultWords>(result_block, block);
}

Words encode(const Command& command) {
    return encoded(command);
}
Decoded<Command> decode_command(std::span<const std::uint16_t> block) {
    return decoded<Command>(command_block, block);
}
std::uint32_t command_crc(std::span<const std::uint16_t> block) {
    assert(block.size() == command_block.count);
    return crc_of<Command>(block);
}

Words encode(const TicketWords& ticket) {
    return encoded(ticket);
}
Decoded<TicketWords> decode_ticket(std::span<const std::uint16_t> block) {
    return decoded<TicketWords>(ticket_block, block);
}

Words encode(const Heartbeat& heartbeat) {
    return encoded(heartbeat);
}
Decoded<Heartbeat> decode_heartbeat(std::span<const std::uint16_t> block) {
    return decoded<Heartbeat>(heartbeat_block, block);
}

Words encode(const Chunk& chunk) {
    return encoded(chunk);
}
Decoded<Chunk> decode_chunk(std::span<const std::uint16_t> block) {
    if (block.size() <= chunk_head) return {WordFault::length, {}};
    Chunk chunk = taken<Chunk>(block);
    const std::size_t length = chunk.data.size();
    if (length < 1 || length > max_chunk_bytes || block.size() != chunk_head + (length + 1) / 2) {
        return {WordFault::length, {}};
    }
    return {WordFault::none, std::move(chunk)};
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
