// Hands one job to a cell and follows it to its end, over any bus of registers.
//
// Seconds. The report is one of three words and never a guess: STARTED only if the cell has started the job, NOT
// STARTED only if it never can start it any more, UNKNOWN otherwise (tests/sim/hand_off_over_tcp_test.cpp). What to do
// next is decided by the pure state machine of hand_off.h; this drives it.

#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/context.h"
#include "base/file.h"
#include "cam/job/ticket.h"
#include "devices/bus.h"
#include "devices/registers.h"

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

enum class StartVerdict { started, not_started, unknown };

// STARTED, NOT STARTED, UNKNOWN: ask the cell.
const char* words(StartVerdict verdict);

struct JobOutcome {
    StartVerdict verdict = StartVerdict::unknown;
    JobState job_state = JobState::none;     // last known
    JobResult job_result = JobResult::none;  // complete: the cell carved the job to its end
    Uuid job_id{};
    std::uint32_t starts = 0;             // STARTS of the cell's own RESULT for this job: 0 or 1
    bool starts_known = false;            // the RESULT was read at the end
    AckResult refusal = AckResult::none;  // what the cell answered when it refused
    bool cancelled = false;               // ended because the caller asked
    std::uint16_t cell_id = 0;
    bool simulated = false;
    double elapsed_s = 0;          // of the job, as the cell counts
    double took_s = 0;             // of the whole hand-off, by our clock
    std::string why;               // one sentence: how it ended
    std::string to_do;             // one sentence, may be empty
    std::vector<std::string> log;  // the steps, one line each

    bool is_complete() const {
        return verdict == StartVerdict::started && job_state == JobState::ended && job_result == JobResult::complete;
    }
};

// Throws DeviceError while nothing was started: unreachable, not a cell of ours, another cell, busy; InputError if
// `file`, the bytes of the job file, does not match the ticket or cannot be put into the drop folder. Refusals of the
// job and everything after START are a JobOutcome. With context.cancelled this returns within leave_s: before START the
// job is cancelled and the cell given back, confirmed if the cell answers in time; afterwards it is left to run by
// itself.
JobOutcome dispatch_job(RegisterBus& bus, const JobTicket& ticket, const Bytes& file, const DispatchOptions& options,
                        const Context& context);

}  // namespace qchopper
