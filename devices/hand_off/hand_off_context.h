// What the sources of the hand-off share: one turn of it, and the functions that each of them defines for the others.
//
// For the sources hand_off*.cpp only. Every function that returns an
// action changes context.h to the state that the action belongs to.

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "devices/hand_off/hand_off_state.h"

namespace qchopper::hand_off {

struct StepContext {
    const HandOffPlan& plan;
    HandOff& h;              // changed in place
    const HandOffInput& in;  // the answer to h.last
    double now_s;
    HandOffTransition& turn;  // its lines, events and answer are added to

    void report(const std::string& line) { turn.lines.push_back(line); }
    // The event to be filled in; of this job.
    JournalEvent& keep(JournalKind kind) {
        turn.journal.emplace_back();
        turn.journal.back().kind = kind;
        turn.journal.back().job_id = plan.ticket.job_id;
        return turn.journal.back();
    }
    void set_reason(const std::string& why, const Sentence& to_do) {
        h.why = why;
        h.to_do = to_do;
        report(why);
    }
    const HandOffTimings& timings() const { return plan.options.timings; }
    const Uuid& job_id() const { return plan.ticket.job_id; }
    const Status& status() const { return *h.status; }  // after the first one only
    bool is_leaving() const { return h.leave_by_s >= 0; }
    // START may have arrived. Of a job that is taken up that holds until QUERY has answered after a CLAIM, whatever the
    // journal says: it may have lost its last rows.
    bool may_have_started() const { return !h.is_started && (h.start_sent || (plan.adopts && !h.is_excluded)); }
    bool shows_our_job() const { return h.status && h.status->job_id == plan.ticket.job_id; }
};

using Kind = HandOffAction::Kind;

constexpr int max_fences = 3;
constexpr int max_claims = 10;
constexpr int max_bad_identities = 4;  // in a row, each read three times
constexpr int max_odd_answers = 10;    // RESULTs in a row that do not help
constexpr int max_ready_commands = 8;  // Reset, Clear, CANCEL and CLEAR_RESULT until the cell is idle
constexpr int max_tickets_lost = 10;   // STOREs that did not find the TICKET as it was written
constexpr int max_tokenless = 3;       // acknowledged PREPAREs without a token

// hand_off_text.cpp
// What is known of the foam now, as a clause: "the cell may be cutting foam".
std::string foam(const StepContext& context);
// The cell has shown our job as ended or aborted.
bool has_ended(const StepContext& context);
// What to do at UNKNOWN: look at the cell, and then this.
Sentence look_first(const StepContext& context, Sentence then);
// What to do where asking the cell again would give the same answer.
Sentence accept_memory(const StepContext& context);
// What to do after this verdict where nothing better is known; "" after a complete end.
Sentence usual_remedy(const StepContext& context, StartOutcome start_outcome);

// hand_off.cpp
HandOffAction plain(Kind kind);
// Until the next read of STATUS, or the next heartbeat if that is due first.
HandOffAction pause(StepContext& context);
// `command` with the members of h.command that were set before, under a new CMD_SEQ.
HandOffAction send(StepContext& context, CellCommand command);
// The same with no member set but the job.
HandOffAction send_new(StepContext& context, CellCommand command, const Uuid& job_id = {});
// CLAIM with a new epoch, which makes every earlier command void, then QUERY. Gives up after max_fences.
HandOffAction fence(StepContext& context, const std::string& why);

// hand_off_claim.cpp
// CLAIM with a higher epoch than any before.
HandOffAction send_claim(StepContext& context);
// Whether the acknowledgement of our last CMD_SEQ is that of CLAIM.
bool answers_claim(const StepContext& context);
// CLAIM under a higher CMD_SEQ if the cell took the last one for an old command; else nothing.
std::optional<HandOffAction> claim_past_stale_number(StepContext& context);
HandOffAction claim_refused(StepContext& context, AckResult result, const std::string& answer);

// hand_off_identity.cpp
// IDENTITY has come: continues with the step, or claims the cell again if context.h.claim_reason is set.
HandOffAction on_identity(StepContext& context);
// IDENTITY came damaged, several times: the end, if that was so max_bad_identities times in a row.
std::optional<HandOffAction> on_bad_identity(StepContext& context);
// The end, if the STATUS that has come is of another cell than the one before: CELL_ID or "simulated" differ. Nothing
// more is sent then. To be called before it is noted.
std::optional<HandOffAction> compare_cell(StepContext& context);
// CELL_STORE_LOST, if the counters of the last STATUS are lower than those seen before; otherwise they are noted.
std::optional<HandOffAction> compare_counters(StepContext& context);
// CELL_STORE_LOST, if the answer to QUERY shows that the cell does not know the CLAIM before, or the job that has
// started. Else the number of the present CLAIM is kept, if the cell has granted it.
std::optional<HandOffAction> compare_grant(StepContext& context);
// Keeps the counters as they were last seen.
void keep_store(StepContext& context);

// hand_off_request.cpp
// The command that another program asks for: sent now, or answered why not.
std::optional<HandOffAction> take_request(StepContext& context);
// The request that is under way has ended. Does nothing without one.
void end_request(StepContext& context, CommandEnd end, const std::string& why = {});

// hand_off_end.cpp
HandOffAction finish(StepContext& context, StartOutcome start_outcome, const std::string& why,
                     const Sentence& to_do = {});
// Finishes with the verdict that the state proves: STARTED, UNKNOWN if a START may have arrived, else NOT STARTED. The
// reason is completed by what is known of the foam, and by what to do if `to_do` is empty.
HandOffAction give_up(StepContext& context, const std::string& why, const Sentence& to_do = {});
// Finishes with an error, before anything was started.
HandOffAction fail(StepContext& context, DeviceFault fault, const std::string& why, const Sentence& to_do);
// The job will not be started: CANCEL if the cell may hold it, RELEASE, and the end with this `why`.
HandOffAction withdraw(StepContext& context, const std::string& why, const Sentence& to_do);
// The caller has asked to stop: the action that follows from that, or nothing if the hand-off ends already.
std::optional<HandOffAction> leave(StepContext& context);
// Asked to stop while the job runs: RELEASE, or Stop if the options order it.
HandOffAction leave_running_job(StepContext& context);
// The end of a hand-off that was asked to stop and has no time left. Precondition: context.is_leaving().
HandOffAction leave_at_once(StepContext& context);

// hand_off_result.cpp
// context.in.result has come.
HandOffAction on_result(StepContext& context);
// The answers of the cell contradict each other: the verdict becomes UNKNOWN, with `what` as the reason.
HandOffAction contradict(StepContext& context, const std::string& what);

// hand_off_steps.cpp
// Goes to `step` and returns its first action.
HandOffAction enter(StepContext& context, HandOffStep step);
// The first STATUS: the right cell, simulated or real as ordered.
HandOffAction check_identity(StepContext& context);
// Until the machine is in Idle without another job.
HandOffAction make_idle(StepContext& context);
HandOffAction send_file(StepContext& context);
// Follows the job until it ends.
HandOffAction watch(StepContext& context);
// h.command was acknowledged: OK or ALREADY, or a refusal.
HandOffAction acknowledged(StepContext& context);
HandOffAction refused(StepContext& context, AckResult result);

}  // namespace qchopper::hand_off
