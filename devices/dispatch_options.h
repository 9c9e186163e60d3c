// How a job is handed to a cell: the choices of the caller and the time limits of the hand-off.
//
// Times in seconds.

#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "cam/job/ticket.h"
#include "devices/codes.h"

namespace qchopper {

struct HandOffTimings {
    double poll_s = 0.5;          // between two reads of STATUS
    double heartbeat_s = 0.5;     // between two heartbeats; the cell's watchdog expires at 2.5
    double answer_s = 10;         // for a command without consent (VERIFY and REHEARSE: 10 times this)
    double resend_s = 1;          // until a command without acknowledgement is sent again
    double consent_s = 600;       // for the operator at the cell
    double link_patience_s = 30;  // for a lost link, and for a frozen cell before the start
    double frozen_s = 2.5;        // without a change of the cell's heartbeat: the cell counts as frozen
    double leave_s = 2;           // from the request to stop to the end of the hand-off, whatever the cell does
};

struct DispatchOptions {
    std::uint16_t cell_id = 0xFFFF;     // any other cell is refused
    bool want_simulated = true;         // a cell whose FLAGS differ from this is refused
    std::filesystem::path drop_folder;  // where the cell fetches job files; empty: sent in chunks over the bus
    LinkLoss on_link_loss = LinkLoss::go_on;
    bool rehearse = false;             // REHEARSE before PREPARE
    bool stop_when_cancelled = false;  // a request to stop while the job runs also stops the machine
    HandOffTimings timings;
    std::optional<Uuid> job_id;  // empty: a new random one
    // Called with one line before an action; if it throws, the action is not done. May be empty.
    std::function<void(const std::string& row)> journal;
};

}  // namespace qchopper
