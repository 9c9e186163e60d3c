// What the hand-off of one job is at: its steps, its actions, and all that it knows.
//
// Seconds of a clock that never jumps. Values only; hand_off.h says how they change.

#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "devices/blocks.h"
#include "devices/device_error.h"
#include "devices/dispatch_options.h"
#include "devices/job_outcome.h"

namespace qchopper {

enum class HandOffStep : std::uint8_t {
    check_cell,
    stage_file,
    claim,
    ask_before,
    make_ready,
    write_ticket,
    write_signature,
    store,
    deliver,
    verify,
    rehearse,
    prepare,
    start,
    run,
    ask_after,
    clear_result,
    reset,
    cancel,
    release,
    finished
};

// All that is fixed before the first contact.
struct HandOffPlan {
    WireTicket ticket;
    std::uint32_t owner = 0;   // random, not 0
    std::uint32_t secret = 0;  // random, never shown
    DispatchOptions options;
};

struct HandOffAction {
    enum class Kind : std::uint8_t {
        read_status,
        read_result,
        write_command,
        write_ticket,
        write_signature,
        write_chunk,
        heartbeat,
        stage_file,  // the job file to the drop folder under a name that the cell does not look at
        put_file,    // and from there to its name
        wait,
        finish
    };
    Kind kind = Kind::read_status;
    Command command;           // write_command
    Heartbeat beat;            // heartbeat
    std::uint32_t offset = 0;  // write_chunk
    double until_s = 0;        // wait
    std::string journal;       // a row to be kept before the action is done; empty: none
};

// What the hand-off knows. Begin with HandOff{}.
struct HandOff {
    HandOffStep step = HandOffStep::check_cell;
    HandOffAction last;  // what was asked for last
    bool has_begun = false;
    std::optional<HandOffAction> deferred;  // to be done after a heartbeat, or again after "busy"

    Command command;  // under way
    bool waits_for_ack = false;
    std::uint32_t epoch = 0;
    std::uint32_t seq = 0;
    std::uint32_t receipt = 0;
    std::uint32_t chunk_next = 0;
    std::uint32_t chunk_done = 0;  // as the cell said last
    int chunks_in_flight = 0;

    std::optional<Status> status;  // last good one
    double step_since_s = 0;
    double sent_s = 0;
    double beat_s = 0;
    std::uint16_t beat_counter = 0;
    double cell_beat_s = 0;  // when the cell's heartbeat moved last
    double lost_since_s = -1;
    int lost_times = 0;
    int busy_times = 0;
    int fences = 0;    // repeated CLAIMs
    int attempts = 0;  // STARTs that turned out not to have arrived
    int claims = 0;
    int ready_commands = 0;  // acknowledged since the cell was to be made ready
    int odd_answers = 0;     // since the last one of use
    int tokenless = 0;       // PREPAREs that were acknowledged without a token

    bool claim_sent = false;  // and not refused: the cell may hold a lease of ours
    bool is_owner = false;    // CLAIM was granted
    bool file_is_staged = false;
    bool is_stored = false;   // STORE was sent: the cell may hold our job
    bool start_sent = false;  // under the present epoch; the start may have happened
    bool start_acknowledged = false;
    bool is_started = false;          // STATUS or RESULT has shown it
    bool contradicts_itself = false;  // the cell: nothing that it says of the start is believed
    bool has_pending = false;         // PENDING was told
    bool is_frozen = false;           // was told
    bool is_cancelled = false;        // ends as it does because the caller asked to stop
    bool is_given_back = false;       // the cell has answered to CANCEL or RELEASE
    double leave_by_s = -1;           // once the caller has asked to stop: when the hand-off is over at the latest
    bool reset_sent = false;          // at the end

    double elapsed_s = 0;                // of the job, as the cell said last
    std::optional<ResultRecord> result;  // of the query at the end
    StartVerdict verdict = StartVerdict::unknown;
    AckResult refusal = AckResult::none;
    std::optional<DeviceFault> fault;  // finished by an error before anything was started
    std::string why;
    std::string to_do;
};

}  // namespace qchopper
