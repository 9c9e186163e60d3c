// How a job is handed to a cell: what the caller chooses, and how long the hand-off waits for what.

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
    double poll_s = 0.5;          // between two readings of STATUS
    double heartbeat_s = 0.5;     // the cell's watchdog expires at 2.5
    double answer_s = 10;         // until a command that needs nobody's consent is settled (VERIFY: 10 times this)
    double resend_s = 1;          // the same command again if it was not acknowledged
    double consent_s = 600;       // how long the operator at the cell may take
    double link_patience_s = 30;  // how long to try to get a lost link back
    double frozen_s = 2.5;        // the cell's heartbeat stands still for so long: frozen
    double leave_s = 2;           // from the request to stop to the end of the hand-off, whatever the cell does
};

struct DispatchOptions {
    std::uint16_t cell_id = 0xFFFF;     // any other cell is refused
    bool want_simulated = true;         // a cell that says otherwise of itself is refused
    std::filesystem::path drop_folder;  // where the cell fetches job files; empty: sent in chunks over the bus
    LinkLoss on_link_loss = LinkLoss::go_on;
    bool rehearse = false;             // ask for a rehearsal inside the cell before PREPARE
    bool stop_when_cancelled = false;  // Ctrl-C while the job runs also stops the machine
    HandOffTimings timings;
    std::optional<Uuid> job_id;  // empty: a fresh random one (always, outside tests and replays)
    // Called with one line before each command is sent; if it throws, that command is not sent and the throw goes on.
    std::function<void(const std::string& row)> journal;
};

}  // namespace qchopper
