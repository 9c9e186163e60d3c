// Functions, limits and exceptions after the Modbus Application Protocol Specification V1.1b3 (2012); that a block is
// read and written as a whole is a rule of the register map. Shares no framing with devices/wire/modbus_frame.cpp.
// O(registers).

#include "sim/cell/modbus_pdu.h"

#include <algorithm>

namespace qchopper {
namespace {

constexpr std::uint8_t read_holding = 3;
constexpr std::uint8_t read_input = 4;
constexpr std::uint8_t write_holding = 16;

constexpr std::uint8_t illegal_function = 1;
constexpr std::uint8_t illegal_address = 2;
constexpr std::uint8_t illegal_value = 3;
constexpr std::uint8_t no_such_unit = 0x0B;  // gateway target device failed to respond

constexpr std::size_t max_read = 125;
constexpr std::size_t max_written = 123;

std::uint16_t u16_at(std::span<const std::uint8_t> bytes, std::size_t at) {
    return static_cast<std::uint16_t>((bytes[at] << 8U) | bytes[at + 1]);
}

// Two bytes: the function code with its high bit set, and the exception code.
Bytes exception_pdu(std::uint8_t function, std::uint8_t code) {
    return {static_cast<std::uint8_t>(function | 0x80U), code};
}

// Nothing if the cell has no such block.
const Block* block_around(Side side, std::uint32_t address, std::uint32_t count) {
    for (const Block* block : all_blocks()) {
        if (block->side == side && block->contains(address, count)) return block;
    }
    return nullptr;
}

Registers right_registers(const Block& block, const CellState& cell, CellTime now) {
    if (&block == &status_block) return encode(status_of(cell, now));
    if (&block == &identity_block) return encode(identity_of(cell));
    if (&block == &result_block && cell.has_answer) return encode(cell.answer);
    return Registers(block.count, 0);  // what was written is never read back: it may hold a secret
}

Registers read_block(const Block& block, CellState& cell, CellTime now) {
    Registers registers = right_registers(block, cell, now);
    spoil_read(cell.faults, block, registers);
    return registers;
}

Bytes answer_read(Side side, std::span<const std::uint8_t> pdu, CellState& cell, CellTime now, const CellHooks& hooks) {
    if (pdu.size() != 5) return exception_pdu(pdu[0], illegal_value);
    const std::uint16_t address = u16_at(pdu, 1);
    const std::uint16_t count = u16_at(pdu, 3);
    if (count < 1 || count > max_read) return exception_pdu(pdu[0], illegal_value);
    const Block* block = block_around(side, address, count);
    if (block == nullptr) return exception_pdu(pdu[0], illegal_address);
    pass_time(cell, now, hooks);
    const Registers registers = read_block(*block, cell, now);
    Bytes answer{pdu[0], static_cast<std::uint8_t>(2 * count)};
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint16_t value = registers[address - block->base + i];
        answer.push_back(static_cast<std::uint8_t>(value >> 8));
        answer.push_back(static_cast<std::uint8_t>(value & 0xFF));
    }
    return answer;
}

// Returns 0 or the exception code.
std::uint8_t write_block(const Block& block, const Registers& registers, CellState& cell, CellTime now,
                         const CellHooks& hooks) {
    if (&block == &chunk_block) {
        const Decoded<Chunk> chunk = decode<Chunk>(registers);
        if (!chunk.is_ok()) return illegal_value;
        pass_time(cell, now, hooks);
        receive_chunk(cell, chunk.value);
        return 0;
    }
    if (&block == &command_block) receive_command(cell, registers, now, hooks);
    if (&block == &heartbeat_block) {
        pass_time(cell, now, hooks);
        receive_heartbeat(cell, registers, now);
    }
    if (&block == &ticket_block) cell.ticket_draft = is_all_zero(registers) ? Registers{} : registers;
    if (&block == &signature_block) cell.signature_draft = is_all_zero(registers) ? Registers{} : registers;
    return 0;
}

// What a PLC does whose time for its clients has run out.
void write_zeros(CellState& cell, CellTime now, const CellHooks& hooks) {
    for (const Block* block : all_blocks()) {
        if (block->side == Side::holding) write_block(*block, Registers(block->count, 0), cell, now, hooks);
    }
}

// Precondition: `pdu` has 6 bytes, and 2 more for each register.
Registers registers_in(std::span<const std::uint8_t> pdu) {
    Registers registers;
    for (std::size_t at = 6; at < pdu.size(); at += 2) registers.push_back(u16_at(pdu, at));
    return registers;
}

Bytes answer_write(std::span<const std::uint8_t> pdu, CellState& cell, CellTime now, const CellHooks& hooks) {
    if (pdu.size() < 6) return exception_pdu(pdu[0], illegal_value);
    const std::uint16_t address = u16_at(pdu, 1);
    const std::uint16_t count = u16_at(pdu, 3);
    const bool fits = count >= 1 && count <= max_written && pdu[5] == 2 * count && pdu.size() == 6U + 2U * count;
    if (!fits) return exception_pdu(pdu[0], illegal_value);
    const Block* block = block_around(Side::holding, address, count);
    if (block == nullptr || address != block->base) return exception_pdu(pdu[0], illegal_address);
    const bool is_whole = block == &chunk_block ? count > chunk_head : count == block->count;
    if (!is_whole) return exception_pdu(pdu[0], illegal_address);
    Registers registers = registers_in(pdu);
    spoil_written(cell.faults, registers);
    const std::uint8_t code = write_block(*block, registers, cell, now, hooks);
    if (code != 0) return exception_pdu(pdu[0], code);
    if (take(cell.faults, Fault::zero_holding)) write_zeros(cell, now, hooks);
    return {pdu.begin(), pdu.begin() + 5};
}

}  // namespace

Bytes answer_pdu(std::uint8_t unit, std::span<const std::uint8_t> pdu, CellState& cell, CellTime now,
                 const CellHooks& hooks) {
    if (pdu.empty()) return exception_pdu(0, illegal_function);
    if (unit != 1 && unit != 255) return exception_pdu(pdu[0], no_such_unit);
    if (take(cell.faults, Fault::close_before_effect)) return {};
    if (const auto code = take(cell.faults, Fault::exception)) {
        return exception_pdu(pdu[0], static_cast<std::uint8_t>(*code));
    }
    if (pdu[0] == read_holding) return answer_read(Side::holding, pdu, cell, now, hooks);
    if (pdu[0] == read_input) return answer_read(Side::input, pdu, cell, now, hooks);
    if (pdu[0] == write_holding) return answer_write(pdu, cell, now, hooks);
    return exception_pdu(pdu[0], illegal_function);
}

bool writes_block(std::span<const std::uint8_t> pdu, const Block& block) {
    return pdu.size() == 6U + 2U * block.count && pdu[0] == write_holding && u16_at(pdu, 1) == block.base &&
           u16_at(pdu, 3) == block.count && pdu[5] == 2U * block.count;
}

std::uint64_t lease_number(const CellState& cell) {
    if (!cell.lease) return 0;
    return (std::uint64_t{cell.memory.epoch_held} << 32U) | cell.lease->owner;
}

std::uint64_t lease_named_in(std::span<const std::uint8_t> pdu, const CellState& cell) {
    const auto named = [&](const auto& decoded) {
        if (!decoded.is_ok()) return std::uint64_t{0};
        return (std::uint64_t{decoded.value.epoch} << 32U) | decoded.value.owner;
    };
    std::uint64_t number = 0;
    if (writes_block(pdu, command_block)) number = named(decode<Command>(registers_in(pdu)));
    if (writes_block(pdu, heartbeat_block)) number = named(decode<Heartbeat>(registers_in(pdu)));
    return number == lease_number(cell) ? number : 0;
}

}  // namespace qchopper
