// Answers one Modbus request to the cell: bytes to bytes, without sockets.
//
// Unit 1 and 255 (else exception 0x0B), functions 3, 4 and 16 (else exception 1); first count and length are checked
// (exception 3), then the address: one block, and a whole one to write (exception 2). A request that is answered with
// an exception changes nothing, whatever its bytes are (tests/sim/cell/pdu_test.cpp).

#pragma once

#include <cstdint>
#include <span>

#include "sim/cell/machine.h"

namespace qchopper {

// `pdu` begins with the function code; it may be empty. The answer has 2 to 253 bytes; it is empty, and the connection
// is to be closed, only by the fault close-before-effect.
Bytes answer_pdu(std::uint8_t unit, std::span<const std::uint8_t> pdu, CellState& cell, CellTime now,
                 const CellHooks& hooks);

}  // namespace qchopper
