#include <cassert>

#include "devices/hand_off_context.h"

namespace qchopper::hand_off {

namespace {

void note_what_is_known(HandOff& h) {
    h.is_cancelled = true;
    if (!h.is_started && h.start_sent) {
        h.why = "stopped on request; START was sent, and the cell has not said whether it started the job";
        h.to_do = "Look at the cell before anything else.";
    }
    if (h.is_started && h.why.empty()) {
        h.why = std::string("stopped watching on request; the cell showed the job last as ") +
                name(h.status->job_state) + ", and what is still to be done goes on by itself";
        h.to_do = "Stop it at the cell if it must not run.";
    }
}

}  // namespace

HandOffAction leave_at_once(StepContext& context) {
    assert(context.is_leaving());
    note_what_is_known(context.h);
    return give_up(context, "stopped on request");
}

std::optional<HandOffAction> leave(StepContext& context) {
    HandOff& h = context.h;
    if (!context.is_leaving()) h.leave_by_s = context.now_s + context.timings().leave_s;
    if (context.now_s >= h.leave_by_s) return leave_at_once(context);
    const bool half_over = context.now_s >= h.leave_by_s - context.timings().leave_s / 2;
    const bool may_have_started = h.start_sent && !h.is_started;
    if (half_over && h.claim_sent && h.step < HandOffStep::release && !may_have_started) {
        // A cell that answers to nothing else may still take RELEASE, which voids the token of a job just as well.
        note_what_is_known(h);
        h.deferred.reset();
        return enter(context, HandOffStep::release);
    }
    if (h.start_sent || h.is_started || !h.why.empty()) return std::nullopt;
    h.is_cancelled = true;
    h.deferred.reset();
    return withdraw(context, "stopped on request before the start", "");
}

HandOffAction leave_running_job(StepContext& context) {
    HandOff& h = context.h;
    h.is_cancelled = true;
    if (!context.plan.options.stop_when_cancelled) {
        h.why = "stopped watching on request; the job runs on by itself";
        h.to_do = "Stop it at the cell if it must not run.";
        context.say(h.why);
        return enter(context, HandOffStep::release);
    }
    context.say("stopping the machine on request");
    h.leave_by_s = context.now_s + context.timings().answer_s;
    h.command = Command{};
    h.command.job_id = context.job_id();
    return send(context, CellCommand::stop, "STOP job=" + to_text(context.job_id()));
}

}  // namespace qchopper::hand_off
