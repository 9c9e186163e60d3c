// The register blocks. An input is: which block, which bit is changed (2 bytes), then its registers.

#include <optional>

#include "devices/wire/codec.h"
#include "tests/fuzz/demand.h"

namespace qchopper {
namespace {

std::size_t crc_at(const Block& block, const char* name) {
    const Field* field = field_named(block, name);
    demand(field != nullptr && field->count == 2);
    return field->address - block.base;
}

// Any registers are accepted or refused. With magic number, version and checksum made right they are accepted, and
// encoding and decoding returns the same values; with one bit of what the checksum covers, or of itself, changed they
// are refused.
template <class Decode, class Right>
void try_block(const Block& block, const char* crc_name, Registers registers, unsigned bit, const Decode& decode,
               const Right& make_right) {
    const std::size_t crc = crc_at(block, crc_name);
    const auto checksum = [&] { return crc32_of_registers(std::span(registers).first(crc)); };
    const auto raw = decode(registers);
    if (raw.is_ok()) {
        demand(registers.size() == block.count);
        demand(registers[crc] == checksum() >> 16 && registers[crc + 1] == (checksum() & 0xFFFF));
    }
    registers.resize(block.count);
    if (is_all_zero(registers)) {
        demand(decode(registers).fault == BlockFault::empty);
        registers[crc - 1] = 1;
    }
    make_right(registers);
    const std::uint32_t right = checksum();
    registers[crc] = static_cast<std::uint16_t>(right >> 16);
    registers[crc + 1] = static_cast<std::uint16_t>(right & 0xFFFF);
    const auto decoded = decode(registers);
    demand(decoded.is_ok());
    const auto again = decode(encode(decoded.value));
    demand(again.is_ok() && again.value == decoded.value);
    const std::size_t at = bit % (16 * (crc + 2));
    registers[at / 16] = static_cast<std::uint16_t>(registers[at / 16] ^ 1U << at % 16);
    demand(!decode(registers).is_ok());
}

void try_registers(unsigned which, unsigned bit, const Registers& registers) {
    const auto as_it_is = [](Registers&) {};
    const auto named = [](Registers& w) {
        w[0] = cell_magic;
        w[1] = static_cast<std::uint16_t>(map_version | (w[1] & 0xFF));
    };
    const auto named_twice = [&named](Registers& w) {
        named(w);
        w.back() = w[2];  // SNAPSHOT stands at both ends
    };
    switch (which % 7) {
        case 0:
            return try_block(status_block, "STATUS_CRC", registers, bit, decode<Status>, named_twice);
        case 1:
            return try_block(result_block, "CRC", registers, bit, decode<ResultRecord>, as_it_is);
        case 2:
            return try_block(command_block, "CRC", registers, bit, decode<Command>, named);
        case 3:
            return try_block(ticket_block, "CRC", registers, bit, decode<WireTicket>, as_it_is);
        case 4: {
            const Decoded<Heartbeat> heartbeat = decode<Heartbeat>(registers);
            if (heartbeat.is_ok()) demand(encode(heartbeat.value) == registers);
            return;
        }
        case 6:
            return try_block(identity_block, "CRC", registers, bit, decode<Identity>, named);
        default: {
            const Decoded<Chunk> chunk = decode<Chunk>(registers);
            if (!chunk.is_ok()) return;
            demand(!chunk.value.data.empty() && chunk.value.data.size() <= max_chunk_bytes);
            demand(decode<Chunk>(encode(chunk.value)).value == chunk.value);
        }
    }
}

}  // namespace
}  // namespace qchopper

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    qchopper::Input input(data, size);
    const unsigned which = input.u8();
    const unsigned bit = input.u16();
    qchopper::Registers registers;
    while (!input.is_empty() && registers.size() < 200) registers.push_back(input.u16());
    qchopper::try_registers(which, bit, registers);
    return 0;
}
