// The first STATUS: how often it is asked for, and what it means if it does not come.
//
// The pause and the reason are pure; the hand-off uses them too (tests/devices/hand_off_test.cpp).

#pragma once

#include <optional>
#include <string>

#include "base/context.h"
#include "devices/bus.h"
#include "devices/device_error.h"
#include "devices/hand_off_input.h"

namespace qchopper {

// Seconds until STATUS is worth another try after `tries` that failed before this one, the first of them `since_s` ago;
// nothing if it is not, or no longer.
std::optional<double> pause_before_next_contact(const HandOffInput& failed, int tries, double since_s);

struct ContactFailure {
    DeviceFault fault = DeviceFault::unreachable;
    std::string why;
    std::string to_do;
};
// protocol only if somebody has answered who is not a cell of ours.
ContactFailure why_no_contact(const HandOffInput& failed);

// A block that came torn or damaged is read again, twice, and never acted on.
HandOffInput read_status_block(RegisterBus& bus);
HandOffInput read_result_block(RegisterBus& bus);
// The end of a call without what was read.
HandOffInput input_from(const BusAnswer& answer);

// Asks who answers, before anything is sent. Nothing if the caller asked to stop; throws DeviceError, with `where` in
// front.
std::optional<Status> read_first_status(RegisterBus& bus, const std::string& where, const Context& context);

}  // namespace qchopper
