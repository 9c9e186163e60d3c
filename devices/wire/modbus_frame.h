// Encodes a Modbus TCP request as bytes, checks the bytes of its answer, and decodes them.
//
// Pure functions. An answer is compared with its request field by field: transaction, protocol, length, unit, function,
// and byte count or echoed address and count (tests/devices/wire/modbus_frame_test.cpp changes every one of them).

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "base/files/file.h"
#include "devices/wire/bus.h"

namespace qchopper {

enum class ModbusFunction : std::uint8_t { read_holding = 3, read_input = 4, write_holding = 16 };

constexpr std::uint16_t max_read_registers = 125;
constexpr std::uint16_t max_written_registers = 123;

struct ModbusRequest {
    std::uint16_t transaction = 0;
    std::uint8_t unit = 255;
    ModbusFunction function = ModbusFunction::read_input;
    std::uint16_t address = 0;
    std::uint16_t count = 1;                     // of registers: 1 to 125, of write_holding 1 to 123
    std::span<const std::uint16_t> registers{};  // of write_holding: `count` of them; else none
};

// MBAP header and PDU, at most 260 bytes. Precondition: count and registers as stated above.
Bytes frame_of(const ModbusRequest& request);

// What the first bytes of an answer determine.
struct AnswerSoFar {
    std::size_t wanted = 0;  // bytes of the whole answer, or 8 while that is not known yet
    std::string wrong;       // if not empty: why this is no answer to the request
};
// `bytes` may be any beginning of the answer, also empty.
AnswerSoFar check_answer(const ModbusRequest& request, std::span<const std::uint8_t> bytes);

// Precondition: check_answer() finds nothing wrong, and `bytes` are as many as wanted. Never ends as lost.
BusAnswer decode_answer(const ModbusRequest& request, std::span<const std::uint8_t> bytes);

}  // namespace qchopper
