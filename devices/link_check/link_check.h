// Takes the controller of an integrator through the handshake, up to a prepared job, and says what deviates from the
// register map: rule, register, and what was seen instead.
//
// START is never sent. Before Reset, Clear and PREPARE, after which something at the cell could move, a person is
// asked. What is left in the cell is a higher EPOCH_HELD and one cancelled job id. A controller that is made as
// docs/user/cell-integration.md says deviates nowhere (tests/sim/cell/link_check_test.cpp, tests/interoperation).

#pragma once

#include "base/context.h"
#include "devices/link_check/checked_rules.h"
#include "devices/wire/bus.h"

namespace qchopper {

// Throws DeviceError (busy) if the cell has a lease or a job, and Cancelled. That nothing answers is a rule that does
// not hold. O(s): about 25 s of the clock, without consent.
LinkCheck check_link(RegisterBus& bus, const LinkCheckOptions& options, const Context& context);

}  // namespace qchopper
