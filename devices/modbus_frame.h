// One request of Modbus TCP and its answer, as bytes.
//
// Pure. An answer is held against its request field by field: transaction, protocol, length, unit, function, and byte
// count or echoed address and count (tests/devices/modbus_frame_test.cpp changes every one of them).

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "base/file.h"
#include "devices/bus.h"

namespace qchopper {

enum class ModbusFunction : std::uint8_t { read_holding = 3, read_input = 4, write_holding = 16 };

constexpr std::uint16_t most_read_registers = 125;
constexpr std::uint16_t most_written_registers = 123;

struct ModbusRequest {
    std::uint16_t transaction = 0;
    std::uint8_t unit = 255;
    ModbusFunction function = ModbusFunction::read_input;
    std::uint16_t address = 0;
    std::uint16_t count = 1;                     // of registers, 1 to what the function allows
    std::span<const std::uint16_t> registers{};  // write_holding: `count` of them
};

Bytes frame_of(const ModbusRequest& request);

// What can be said of the bytes that have come so far.
struct AnswerSoFar {
    std::size_t wanted = 0;  // as long as this it must become, as far as is known by now
    std::string wrong;       // if not empty: this is no answer to the request, and why
};
AnswerSoFar check_answer(const ModbusRequest& request, std::span<const std::uint8_t> bytes);

// Of bytes that are as many as wanted, with nothing wrong.
BusAnswer take_answer(const ModbusRequest& request, std::span<const std::uint8_t> bytes);

}  // namespace qchopper
