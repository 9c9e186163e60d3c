// Checks the signature of a ticket against the keys that the cell trusts.
//
// BAD_SIGNATURE and UNKNOWN_KEY carry in ACK_DETAIL what signature_detail names (tests/sim/cell/signature_test.cpp).

#pragma once

#include <optional>

#include "sim/cell/machine.h"

namespace qchopper {

// Nothing: the ticket may be taken. A ticket without signature may, unless the cell requires one or the ticket names a
// key. A signed one needs a trusted key; a cell that has no list of keys and requires no signature takes it as
// unsigned.
std::optional<CommandAnswer> wrong_signature(const Registers& ticket, const Registers& signature,
                                             const CellLimits& limits, const CellHooks& hooks);

}  // namespace qchopper
