// Reads blocks of a cell, and decides what a failed read of the first STATUS means.
//
// Nothing here writes to the cell. The state machine of hand_off.h uses the pure functions too
// (tests/devices/hand_off/hand_off_test.cpp).

#pragma once

#include <optional>
#include <string>

#include "base/context.h"
#include "devices/hand_off/hand_off_state.h"
#include "devices/wire/bus.h"
#include "devices/wire/device_error.h"

namespace qchopper {

// The cell answered with exception 5 (acknowledge) or 6 (server device busy): the same request may succeed later.
bool is_busy(const HandOffInput& failed);

// Seconds until the next read of STATUS. `tries` reads failed before `failed`; the first failed since_s seconds ago.
// Nothing if another read cannot help, or if it would begin more than 2 s after the first failure.
std::optional<double> pause_before_next_contact(const HandOffInput& failed, int tries, double since_s);

struct ContactFailure {
    DeviceFault fault = DeviceFault::unreachable;
    std::string why;
    Sentence to_do;
};
// `failed` has ended without a STATUS. Fault `protocol` only if something has answered that is no cell of this map.
ContactFailure contact_failure(const HandOffInput& failed);

// One read of the whole block, decoded. A damaged or torn block is read again, at most three times in all; after that
// it counts as lost, with the fault found.
HandOffInput read_status_block(RegisterBus& bus);
HandOffInput read_result_block(RegisterBus& bus);
HandOffInput read_identity_block(RegisterBus& bus);
// How a call ended, without the registers that were read.
HandOffInput input_from(const BusAnswer& answer);

// Reads STATUS before anything is written, with the pauses above. Nothing if context.cancelled is set before one has
// come. Throws DeviceError, its text beginning with `where`, if none comes. Removes the limit of bus.leave_when().
std::optional<Status> read_first_status(RegisterBus& bus, const std::string& where, const Context& context);

}  // namespace qchopper
