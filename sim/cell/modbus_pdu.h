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

// Whether the PDU writes this whole block, as answer_pdu() accepts it; not for CHUNK, which has many sizes.
bool writes_block(std::span<const std::uint8_t> pdu, const Block& block);

// EPOCH and OWNER of the lease that is alive, as one number; 0: there is none.
std::uint64_t lease_number(const CellState& cell);
// The same, if the PDU writes a sound COMMAND or HEARTBEAT that names this lease, as its holder does; else 0.
std::uint64_t lease_named_in(std::span<const std::uint8_t> pdu, const CellState& cell);

}  // namespace qchopper
