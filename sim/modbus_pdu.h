// The cell's answer to one Modbus request: bytes in, bytes out, no sockets.
//
// Strict: functions 3, 4 and 16 only; first count and length (exception 3), then address, gaps and atomic blocks
// (exception 2). A request that is answered with an exception changes nothing, whatever its bytes are
// (tests/sim/pdu_test.cpp).

#pragma once

#include <cstdint>
#include <span>

#include "sim/machine.h"

namespace qchopper {

// `pdu` begins with the function code. The answer is never empty and never longer than 253 bytes.
Bytes answer_pdu(std::uint8_t unit, std::span<const std::uint8_t> pdu, CellState& cell, CellTime now,
                 const CellHooks& hooks);

// Function code with the high bit, and the code.
Bytes exception_pdu(std::uint8_t function, std::uint8_t code);

}  // namespace qchopper
