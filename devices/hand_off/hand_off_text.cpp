// What the operator is told: whether foam is being cut, and what to do. O(1).

#include "devices/hand_off/hand_off_context.h"
#include "devices/hand_off/operator_text.h"

namespace qchopper::hand_off {
namespace {

constexpr bool is_over(JobState state) {
    return state == JobState::ended || state == JobState::aborted;
}

bool is_complete(const StepContext& context) {
    const HandOff& h = context.h;
    const JobResult result = h.result                  ? h.result->result
                             : context.shows_our_job() ? context.status().job_result
                                                       : JobResult::none;
    return has_ended(context) && result == JobResult::complete;
}

}  // namespace

bool has_ended(const StepContext& context) {
    const HandOff& h = context.h;
    return (h.result && is_over(h.result->state)) || (context.shows_our_job() && is_over(context.status().job_state));
}

std::string foam(const StepContext& context) {
    const HandOff& h = context.h;
    const bool is_uncertain = h.contradicts_itself || context.may_have_started();
    if (!is_uncertain && !h.is_started) return "the cell cuts no foam for this job";
    if (!is_uncertain && has_ended(context)) return "the cell no longer cuts foam for this job";
    const bool is_seen = context.shows_our_job() && h.lost_since_s < 0 && !h.is_frozen && !h.store_is_lost;
    const std::string clause = is_uncertain ? "the cell may be cutting foam"
                               : is_seen    ? foam_in(context.status().state)
                                            : "the cell may still be cutting foam";
    const bool is_simulated = h.status && h.status->has(flag::simulated);
    return clause + (is_simulated ? " (it is SIMULATED: nothing moves)" : "");
}

std::string cell_command(const StepContext& context, const std::string& words) {
    return qchopper::cell_command(context.plan.options.address, words);
}

std::string look_first(const StepContext& context) {
    return "Go to the cell and look whether it cuts. Ask it: " + cell_command(context, "status") + ".";
}

std::string accept_memory(const StepContext& context) {
    return "Look at the cell and what it has cut, then accept its memory: " + cell_command(context, "accept-store");
}

std::string usual_remedy(const StepContext& context, StartOutcome start_outcome) {
    switch (start_outcome) {
        case StartOutcome::not_started:
            return "Look at the panel of the cell, mend the cause, and dispatch again.";
        case StartOutcome::unknown:
            return "The next dispatch asks the cell before it sends a job.";
        case StartOutcome::started:
            break;
    }
    if (is_complete(context)) return {};
    if (has_ended(context)) return "Look at the cell and at the piece before the next dispatch.";
    return "Look at the cell: " + cell_command(context, "status") + ". The next dispatch follows the job to its end.";
}

}  // namespace qchopper::hand_off
