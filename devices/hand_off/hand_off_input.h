// The answer to one action of the hand-off.

#pragma once

#include <optional>
#include <string>

#include "devices/wire/blocks.h"
#include "devices/wire/bus.h"
#include "devices/wire/codec.h"

namespace qchopper {

struct HandOffInput {
    BusEnd end = BusEnd::ok;
    int exception = 0;                        // Modbus exception code if end is exception
    BlockFault fault = BlockFault::none;      // with `lost`: registers came, but not a right block
    std::string why;                          // if end is not ok, or if stage_file or put_file failed
    bool is_alien = false;                    // with `lost`: bytes came that are no answer to the request
    std::optional<Status> status;             // after read_status that ended ok
    std::optional<ResultRecord> result;       // after read_result that ended ok
    std::optional<Identity> identity;         // after read_identity that ended ok
    CellCommand request = CellCommand::none;  // Unhold or Clear, which another program asks to pass to the cell
    bool cancelled = false;                   // the caller asks to stop
    double cancelled_for_s = 0;               // since so long, as far as is known
};

}  // namespace qchopper
