// One turn of the hand-off under way: shared by hand_off.cpp (what every step has in common) and hand_off_steps.cpp
// (what each step does). Not for others.

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "devices/hand_off_input.h"
#include "devices/hand_off_state.h"

namespace qchopper::hand_off {

struct StepContext {
    const HandOffPlan& plan;
    HandOff& h;
    const HandOffInput& in;
    double now_s;
    std::vector<std::string>& lines;

    void say(const std::string& line) { lines.push_back(line); }
    const HandOffTimings& timings() const { return plan.options.timings; }
    const Uuid& job_id() const { return plan.ticket.job_id; }
    const Status& status() const { return *h.status; }
    bool is_leaving() const { return h.leave_by_s >= 0; }
    bool shows_our_job() const { return h.status && h.status->job_id == plan.ticket.job_id; }
};

using Kind = HandOffAction::Kind;

constexpr int most_fences = 3;
constexpr int most_claims = 10;
constexpr int most_odd_answers = 10;    // in a row: of somebody else, or of no use
constexpr int most_ready_commands = 8;  // Reset, Clear, CANCEL and CLEAR_RESULT until the cell is idle
constexpr int most_tokenless = 3;       // PREPAREs

// The states of a job that has been started once.
constexpr bool has_started(JobState state) {
    return state == JobState::running || state == JobState::interrupted || state == JobState::ended ||
           state == JobState::aborted;
}

// hand_off.cpp
HandOffAction next_action(StepContext& context);
HandOffAction plain(Kind kind, std::string journal = {});
HandOffAction pause(StepContext& context);
HandOffAction send(StepContext& context, CellCommand command, std::string journal = {});
HandOffAction finish(StepContext& context, StartVerdict verdict, const std::string& why, const std::string& to_do = {});
// What is known decides the word: STARTED, UNKNOWN if a START may have arrived, else NOT STARTED.
HandOffAction give_up(StepContext& context, const std::string& why, const std::string& to_do = {});
HandOffAction fail(StepContext& context, DeviceFault fault, const std::string& why, const std::string& to_do);
// The job will not be started: takes it out of the cell, gives the cell back, and ends with what was said here.
HandOffAction withdraw(StepContext& context, const std::string& why, const std::string& to_do);
// A new epoch voids everything that may still be on its way; then the cell is asked.
HandOffAction fence(StepContext& context, const std::string& why);

// hand_off_leave.cpp
// The caller has asked to stop: what that changes now, or nothing if the hand-off is on its way out already.
std::optional<HandOffAction> leave(StepContext& context);
// Asked to stop while the job runs: stops watching it, or stops the machine if that was ordered.
HandOffAction leave_running_job(StepContext& context);
// The end of a hand-off that was asked to stop and can wait no longer.
HandOffAction leave_at_once(StepContext& context);

// hand_off_result.cpp
HandOffAction take_result(StepContext& context);
// What the cell has said cannot all be true: UNKNOWN, with `what` it was.
HandOffAction contradict(StepContext& context, const std::string& what);

// hand_off_steps.cpp
HandOffAction enter(StepContext& context, HandOffStep step);
HandOffAction look_at_cell(StepContext& context);
HandOffAction get_ready(StepContext& context);
HandOffAction send_file(StepContext& context);
HandOffAction watch(StepContext& context);
HandOffAction acknowledged(StepContext& context);
HandOffAction refused(StepContext& context, AckResult result);

}  // namespace qchopper::hand_off
