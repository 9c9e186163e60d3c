// What the outside world answers to an action of the hand-off.

#pragma once

#include <optional>
#include <string>

#include "devices/blocks.h"
#include "devices/bus.h"
#include "devices/codec.h"

namespace qchopper {

// The answer to the last action.
struct HandOffInput {
    BusEnd end = BusEnd::ok;
    int exception = 0;
    BlockFault fault = BlockFault::none;  // with `lost`: somebody answered, but not like a cell
    std::string why;                      // if end is not ok, or if put_file failed
    bool is_alien = false;                // with `lost`: what came is no answer to the request
    std::optional<Status> status;
    std::optional<ResultRecord> result;
    bool cancelled = false;  // the caller asks to stop
};

}  // namespace qchopper
