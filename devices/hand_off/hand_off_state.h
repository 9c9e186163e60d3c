// The state of the hand-off of one job, its steps, its actions and the answers to them.
//
// Seconds of a monotonic clock. Plain values; advance() in hand_off.h changes them.

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "devices/hand_off/dispatch_options.h"
#include "devices/journal/job_outcome.h"
#include "devices/wire/blocks.h"
#include "devices/wire/bus.h"
#include "devices/wire/codec.h"
#include "devices/wire/device_error.h"

namespace qchopper {

enum class HandOffStep : std::uint8_t {
    check_cell,
    stage_file,
    claim,
    ask_before,
    ask_file,
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
    std::uint32_t secret = 0;  // random; proves to the cell that a second CLAIM is of the same owner
    DispatchOptions options;
    // The job of an earlier dispatcher: followed if it has started, else cancelled, never started.
    bool adopts = false;
};

struct HandOffAction {
    enum class Kind : std::uint8_t {
        read_status,
        read_result,
        read_identity,
        write_command,
        write_ticket,
        write_signature,
        write_chunk,
        heartbeat,
        stage_file,  // write the job file into the drop folder under its staging name
        put_file,    // rename it to its name
        wait,
        finish
    };
    Kind kind = Kind::read_status;
    Command command;           // of write_command
    Heartbeat heartbeat;       // of heartbeat
    std::uint32_t offset = 0;  // of write_chunk, in bytes
    double until_s = 0;        // of wait
};

// The answer to one action.
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

// The state. The first is HandOff{}. start_sent: under the present epoch.
struct HandOff : HandOffEnd, JobPast {
    HandOffStep step = HandOffStep::check_cell;
    HandOffAction last;  // the action of the turn before
    bool has_begun = false;
    std::optional<HandOffAction> deferred;  // to be done after a heartbeat, or again after "busy"

    Command command;  // the last one sent
    bool waits_for_ack = false;
    std::uint32_t epoch = 0;
    std::uint32_t seq = 0;
    std::uint16_t bad_frames = 0;  // BAD_FRAMES of the cell when CLAIM was sent
    std::uint32_t receipt = 0;     // of the rehearsal
    std::uint32_t chunk_next = 0;  // offset of the next chunk, in bytes
    std::uint32_t chunk_done = 0;  // XFER_NEXT of the last STATUS that was used
    int chunks_in_flight = 0;      // since then

    std::optional<Status> status;         // last good one
    std::optional<SeenStore> store;       // as last seen
    std::optional<SeenStore> kept_store;  // as in the journal
    bool checks_store = false;            // the cell finds an older copy of its store by itself (IDENTITY)
    std::uint32_t grant = 0;              // of the last CLAIM after which the cell knew the one before
    std::uint32_t new_grant = 0;          // of the last CLAIM
    std::string claim_reason;             // why the cell is to be claimed again, once its IDENTITY is read
    double step_since_s = 0;              // start of the step, of its last command or of its last progress
    double sent_s = 0;                    // when the command was sent last
    double heartbeat_s = 0;               // when the last heartbeat was sent
    std::uint16_t heartbeat_counter = 0;
    double cell_heartbeat_s = 0;  // when the cell's heartbeat changed last
    double lost_since_s = -1;     // -1: the link is not lost
    int lost_times = 0;           // since then
    int busy_times = 0;           // answers in a row
    int fences = 0;               // repeated CLAIMs
    int attempts = 0;             // STARTs that turned out not to have arrived
    int claims = 0;
    int ready_commands = 0;  // acknowledged since the cell was to be made ready
    int bad_identities = 0;  // since the last good one
    int odd_answers = 0;     // RESULTs since the last one that helped
    int tickets_lost = 0;    // STOREs that did not find the TICKET as it was written
    int tokenless = 0;       // PREPAREs that were acknowledged without a token
    double progress_s = -1;  // when progress was last kept

    bool claim_sent = false;  // and not refused: the cell may hold a lease of ours
    bool is_owner = false;    // CLAIM was granted
    bool file_is_staged = false;
    bool is_excluded = false;  // QUERY after a CLAIM has shown that an adopted job has not started
    bool start_acknowledged = false;
    bool contradicts_itself = false;            // the cell: the verdict is UNKNOWN
    bool has_pending = false;                   // PENDING was answered
    bool is_frozen = false;                     // and reported
    bool is_given_back = false;                 // the cell has answered CANCEL or RELEASE
    double leave_by_s = -1;                     // once the caller has asked to stop: the latest end of the hand-off
    bool reset_sent = false;                    // at the end
    bool is_taken_over = false;                 // another dispatcher holds the lease
    CellCommand request = CellCommand::none;    // of another program; sent, and not yet answered
    std::optional<ResultRecord> milled_before;  // the last job of this file, if that is why it is not started

    std::optional<ResultRecord> result;  // of a job that has started
    std::optional<DeviceFault> fault;    // finished with an error before anything was started
};

// One turn of advance().
struct HandOffTransition {
    HandOff state;
    HandOffAction action;
    std::vector<std::string> lines;               // for the operator
    std::vector<JournalEvent> journal;            // to be kept before the action is done
    std::optional<RequestAnswer> request_answer;  // how a request ended; nothing: it has not
};

}  // namespace qchopper
