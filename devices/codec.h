// What the registers of a block say, as values; and back.
//
// Encoding never fails. Decoding returns an answer, never throws, whatever the words are. No value crosses the wire as
// a float: lengths are 0.01 mm here. Held to vectors written by hand (tests/devices/codec_test.cpp), so that cell and
// client cannot share a mistake.

#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "cam/job/ticket.h"
#include "devices/blocks.h"
#include "devices/register_writer.h"
#include "devices/registers.h"

namespace qchopper {

enum class BlockFault : std::uint8_t { none, length, empty, magic, version, crc, torn };  // empty: all zero, inert
const char* describe(BlockFault fault);

template <class T>
struct Decoded {
    BlockFault fault = BlockFault::none;
    T value{};
    bool is_ok() const { return fault == BlockFault::none; }
};

Registers encode(const Status& status);
Decoded<Status> decode_status(std::span<const std::uint16_t> block);

Registers encode(const ResultRecord& result);
Decoded<ResultRecord> decode_result(std::span<const std::uint16_t> block);

Registers encode(const Command& command);
Decoded<Command> decode_command(std::span<const std::uint16_t> block);
// The checksum of a whole block as it came.
std::uint32_t command_crc(std::span<const std::uint16_t> block);

Registers encode(const WireTicket& ticket);
Decoded<WireTicket> decode_ticket(std::span<const std::uint16_t> block);

// What only the hand-off knows of a ticket.
struct TicketOrder {
    Uuid job_id{};
    std::uint64_t created_ms = 0;
    std::uint16_t cell_id = 0;
    bool simulated = false;
    bool rehearse = false;
    Transfer transfer = Transfer::drop_folder;
    LinkLoss on_link_loss = LinkLoss::go_on;
};
// Lengths are rounded to the nearest 0.01 mm (the tool's diameter to 0.001 mm). Throws InputError if one is not a
// number or does not fit, or if the file name is not one that a cell takes.
WireTicket wire_ticket(const JobTicket& ticket, const TicketOrder& order);

Registers encode(const Heartbeat& heartbeat);
Decoded<Heartbeat> decode_heartbeat(std::span<const std::uint16_t> block);

Registers encode(const Chunk& chunk);
// fault length: LEN does not fit the number of registers.
Decoded<Chunk> decode_chunk(std::span<const std::uint16_t> block);
// Over EPOCH, OWNER, JOB_ID, OFFSET, LEN and the data: no chunk of somebody else or of another job fits.
std::uint32_t chunk_crc(std::uint32_t epoch, std::uint32_t owner, const Uuid& job_id, std::uint32_t offset,
                        std::span<const std::uint8_t> data);

}  // namespace qchopper
