// Encodes the values of blocks.h as registers, and decodes registers to values.
//
// encode() returns the whole block (a chunk: 5 + ceil(LEN/2) registers) with magic number, version, zeros where the map
// is reserved, and the right checksum; text that is longer than its field is cut at a UTF-8 character. decode() never
// throws, whatever the registers are: a block is right, or the first fault found is returned and the value is a default
// one. Decoding what was encoded gives it back, except text that was cut. No value crosses the wire as a float. Both
// are compared with registers written by hand (tests/devices/wire/codec_test.cpp).

#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "cam/job/ticket.h"
#include "devices/wire/blocks.h"
#include "devices/wire/register_writer.h"
#include "devices/wire/registers.h"

namespace qchopper {

// empty: all registers are zero; version: another major number, or an older minor one; torn: SNAP_BEGIN and SNAP_END
// differ.
enum class BlockFault : std::uint8_t { none, length, empty, magic, version, crc, torn };
// Completes "STATUS is ...".
const char* describe(BlockFault fault);

template <class T>
struct Decoded {
    BlockFault fault = BlockFault::none;
    T value{};
    bool is_ok() const { return fault == BlockFault::none; }
};

// T: Status, ResultRecord, Identity, Command, WireTicket, TicketSignature, Heartbeat, Chunk.
template <class T>
Registers encode(const T& value);
// Of a chunk: fault `length` if LEN is not 1..232 or does not fit the number of registers, and the checksum is not
// compared.
template <class T>
Decoded<T> decode(std::span<const std::uint16_t> block);

// Address of the first register of the block that the map reserves and that is not zero. T: Command or WireTicket.
template <class T>
std::optional<std::uint16_t> used_reserved(std::span<const std::uint16_t> block);

// The checksum that stands in `block`, which must have the size of COMMAND.
std::uint32_t command_crc(std::span<const std::uint16_t> block);
// CRC-32 over EPOCH, OWNER, JOB_ID, OFFSET, LEN and the data: a chunk of another dispatcher or job does not match.
std::uint32_t chunk_crc(std::uint32_t epoch, std::uint32_t owner, const Uuid& job_id, std::uint32_t offset,
                        std::span<const std::uint8_t> data);

// The ticket of a job. Of `order` stays what the dispatcher decides: job id, transfer, time of creation, what to do on
// a lost link, requirements, the cell and whether it is a simulated one. Lengths are rounded to the nearest 0.01 mm
// (the tool's diameter to 0.001 mm). Throws InputError (use) naming the piece if a length is not a number or does not
// fit, or if the file name is not portable (base/files/portable_name.h).
WireTicket wire_ticket(const JobTicket& ticket, const WireTicket& order);

}  // namespace qchopper
