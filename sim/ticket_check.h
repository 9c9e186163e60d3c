// Whether a ticket makes sense, and whether its job fits this cell.
//
// The detail of a refusal is the address of the first field that is wrong (tests/sim/machine_test.cpp).

#pragma once

#include <optional>
#include <span>

#include "sim/machine.h"

namespace qchopper {

struct TicketFault {
    AckResult result = AckResult::ticket_field;
    std::uint16_t address = 0;
};

// Field by field, when the ticket is stored.
std::optional<TicketFault> wrong_field(const WireTicket& ticket, std::span<const std::uint16_t> block,
                                       const CellLimits& limits);

// Reach, stock, tool and its speeds, before the operator is asked for consent.
std::optional<TicketFault> does_not_fit(const WireTicket& ticket, const CellLimits& limits);

}  // namespace qchopper
