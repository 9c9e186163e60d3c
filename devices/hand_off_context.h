// What the sources of the hand-off share: one turn of it, and the functions that each of them defines for the others.
//
// For hand_off.cpp, hand_off_leave.cpp, hand_off_result.cpp and hand_off_steps.cpp only. Every function that returns an
// action changes context.h to the state that the action belongs to.

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "devices/hand_off_input.h"
#include "devices/hand_off_state.h"

namespace qchopper::hand_off {

struct StepContext {
    const HandOffPlan& plan;
    HandOff& h;              // changed in place
    const HandOffInput& in;  // the answer to h.last
    double now_s;
    std::vector<std::string>& lines;  // for the operator

    void report(const std::string& line) { lines.push_back(line); }
    void set_reason(const std::string& why, const std::string& to_do) {
        h.why = why;
        h.to_do = to_do;
        report(why);
    }
    const HandOffTimings& timings() const { return plan.options.timings; }
    const Uuid& job_id() const { return plan.ticket.job_id; }
    const Status& status() const { return *h.status; }  // after the first one only
    bool is_leaving() const { return h.leave_by_s >= 0; }
    bool shows_our_job() const { return h.status && h.status->job_id == plan.ticket.job_id; }
};

using Kind = HandOffAction::Kind;

constexpr const char* look_first = "Look at the cell before anything else.";  // to_do of UNKNOWN

constexpr int most_fences = 3;
constexpr int most_claims = 10;
constexpr int most_odd_answers = 10;    // RESULTs in a row that do not help
constexpr int most_ready_commands = 8;  // Reset, Clear, CANCEL and CLEAR_RESULT until the cell is idle
constexpr int most_tokenless = 3;       // acknowledged PREPAREs without a token

// The states of a job that has been started.
constexpr bool has_started(JobState state) {
    return state == JobState::running || state == JobState::interrupted || state == JobState::ended ||
           state == JobState::aborted;
}

// hand_off.cpp
HandOffAction next_action(StepContext& context);
HandOffAction plain(Kind kind, std::string journal = {});
HandOffAction wait_until(double until_s);
// Until the next read of STATUS, or the next heartbeat if that is due first.
HandOffAction pause(StepContext& context);
// `command` with the members of h.command that were set before, under a new CMD_SEQ.
HandOffAction send(StepContext& context, CellCommand command, std::string journal = {});
HandOffAction finish(StepContext& context, StartVerdict verdict, const std::string& why, const std::string& to_do = {});
// Finishes with the verdict that the state proves: STARTED, UNKNOWN if a START may have arrived, else NOT STARTED.
HandOffAction give_up(StepContext& context, const std::string& why, const std::string& to_do = {});
// Finishes with an error, before anything was started.
HandOffAction fail(StepContext& context, DeviceFault fault, const std::string& why, const std::string& to_do);
// The job will not be started: CANCEL if the cell may hold it, RELEASE, and the end with this `why`.
HandOffAction withdraw(StepContext& context, const std::string& why, const std::string& to_do);
// CLAIM with a new epoch, which makes every earlier command void, then QUERY. Gives up after most_fences.
HandOffAction fence(StepContext& context, const std::string& why);

// hand_off_leave.cpp
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
