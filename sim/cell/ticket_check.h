// Checks the values of a ticket, and whether its job fits the cell.
//
// The detail of an answer is the address of the first wrong field in the register map
// (tests/sim/cell/stored_job_test.cpp, tests/sim/cell/preparation_test.cpp).

#pragma once

#include <optional>
#include <span>

#include "sim/cell/machine.h"

namespace qchopper {

// For STORE. `block` holds the registers that `ticket` was decoded from, all of TICKET.
std::optional<CommandAnswer> wrong_field(const WireTicket& ticket, std::span<const std::uint16_t> block,
                                         const CellLimits& limits);

// For PREPARE and REHEARSE, before the operator is asked: reach, stock, tool and its speeds.
std::optional<CommandAnswer> does_not_fit(const WireTicket& ticket, const CellLimits& limits);

}  // namespace qchopper
