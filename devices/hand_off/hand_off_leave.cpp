// The end of a hand-off on request, within leave_s: CANCEL and RELEASE before the start, RELEASE after it. O(1) for
// each turn.

#include <cassert>

#include "devices/hand_off/hand_off_context.h"

namespace qchopper::hand_off {
namespace {

std::string stop_there(const StepContext& context) {
    return "If it must not run on: " + cell_command(context, "stop") +
           ", or the panel of the cell. The next dispatch follows it to its end.";
}

void set_reason_of_request(StepContext& context) {
    HandOff& h = context.h;
    h.is_cancelled = true;
    if (context.may_have_started()) {
        h.why = h.start_sent
                    ? "stopped on request; START was sent, and the cell has not reported whether it started the job"
                    : "stopped on request before the cell reported what became of the job of the earlier dispatcher";
        h.to_do = {};
    }
    if (h.is_started && h.why.empty()) {
        h.why = std::string("stopped monitoring on request; the last job state read is ") + name(h.status->job_state) +
                ", and the cell continues by itself";
        h.to_do = stop_there(context);
    }
}

}  // namespace

HandOffAction leave_at_once(StepContext& context) {
    assert(context.is_leaving());
    set_reason_of_request(context);
    return give_up(context, "stopped on request");
}

std::optional<HandOffAction> leave(StepContext& context) {
    HandOff& h = context.h;
    if (!context.is_leaving()) h.leave_by_s = context.now_s - context.in.cancelled_for_s + context.timings().leave_s;
    if (context.now_s >= h.leave_by_s) return leave_at_once(context);
    const bool half_over = context.now_s >= h.leave_by_s - context.timings().leave_s / 2;
    const bool may_have_started = context.may_have_started();
    if (half_over && h.claim_sent && h.step < HandOffStep::release && !may_have_started) {
        // A cell that answers nothing else may still execute RELEASE, which makes the token of a job void as well.
        set_reason_of_request(context);
        h.deferred.reset();
        return enter(context, HandOffStep::release);
    }
    if (may_have_started || h.is_started || !h.why.empty()) return std::nullopt;
    h.is_cancelled = true;
    h.deferred.reset();
    return withdraw(context, "stopped on request before the start", "");
}

HandOffAction leave_running_job(StepContext& context) {
    HandOff& h = context.h;
    h.is_cancelled = true;
    if (!context.plan.options.stop_when_cancelled) {
        context.set_reason("stopped monitoring on request; the job runs on by itself", stop_there(context));
        return enter(context, HandOffStep::release);
    }
    context.report("stopping the machine on request");
    h.leave_by_s += context.timings().answer_s - context.timings().leave_s;
    h.command = Command{};
    h.command.job_id = context.job_id();
    return send(context, CellCommand::stop);
}

}  // namespace qchopper::hand_off
