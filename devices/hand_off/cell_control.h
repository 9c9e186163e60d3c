// One command to a cell, outside of any hand-off: what `qchopper cell` sends.
//
// Stop, Hold and Abort need no lease and work beside a dispatcher; the others claim the cell, send the command and give
// the cell back. Times in seconds (tests/sim/cell/cell_control_test.cpp).

#pragma once

#include <functional>
#include <optional>
#include <string>

#include "base/context.h"
#include "devices/hand_off/dispatch_options.h"
#include "devices/wire/blocks.h"
#include "devices/wire/bus.h"

namespace qchopper {

struct ControlOrder {
    CellCommand command = CellCommand::hold;  // Hold, Unhold, Stop, Abort, Clear, Reset; CLAIM: take over, then RELEASE
    std::uint32_t takeover_code = 0;          // of CLAIM, given at the cell's panel
    std::string address;                      // HOST:PORT for the commands that the operator is told to run
    HandOffPast past;                         // of the journal, for commands with a lease
    std::function<void(const JournalEvent&)> journal;  // before each command with a lease; may be empty
    HandOffTimings timings;
};

bool needs_lease(CellCommand command);

struct ControlEnd {
    using Kind = CommandEnd;
    Kind kind = Kind::unknown;
    AckResult result = AckResult::none;  // of the cell, or the one that it would give
    std::string why;                     // one sentence: what happened, and whether foam is being cut
    Sentence to_do;                      // one sentence; empty after `done`
    Status status;                       // the last one read
};

// `status` is what the cell shows now. Refused here, with nothing sent: under local control (LOCAL_CONTROL), a job
// command without an active job (WRONG_STATE), another memory of the cell than in `past` (CELL_STORE_LOST). A lease of
// another dispatcher is named. Waits for consent at the cell as long as order.timings.consent_s; when
// context.cancelled is set it gives the cell back and returns within timings.leave_s.
ControlEnd control_cell(RegisterBus& bus, const Status& status, const ControlOrder& order, const Context& context);

}  // namespace qchopper
