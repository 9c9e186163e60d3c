// The ends of a hand-off: with the verdict that its state proves, or on request within leave_s, by CANCEL and RELEASE
// before the start and by RELEASE after it. O(1) for each turn.

#include <cassert>

#include "devices/hand_off/hand_off_context.h"

namespace qchopper::hand_off {

HandOffAction finish(StepContext& context, StartOutcome start_outcome, const std::string& why, const Sentence& to_do) {
    context.h.start_outcome = start_outcome;
    if (context.h.why.empty()) {
        context.h.why = why;
        context.h.to_do = to_do;
    }
    context.h.why += "; " + foam(context);
    if (context.h.to_do.empty()) context.h.to_do = usual_remedy(context, start_outcome);
    if (start_outcome == StartOutcome::unknown) context.h.to_do = look_first(context, context.h.to_do);
    if (context.h.cancelled && start_outcome == StartOutcome::not_started && context.h.claim_sent &&
        !context.h.is_given_back) {
        context.h.why += "; the cell did not confirm that it dropped the job";
        context.h.to_do = "Nothing has to be done: the cell holds no valid START for it.";
    }
    context.h.step = HandOffStep::finished;
    context.report(std::string(describe(start_outcome)) + ": " + context.h.why);
    end_request(context, CommandEnd::unknown, "the dispatcher ended before the cell answered");
    keep_store(context);
    context.keep(JournalKind::closed).start_outcome = start_outcome;
    return plain(Kind::finish);
}

HandOffAction give_up(StepContext& context, const std::string& why, const Sentence& to_do) {
    if (context.h.contradicts_itself) return finish(context, StartOutcome::unknown, why, to_do);
    if (context.h.is_started) return finish(context, StartOutcome::started, why, to_do);
    if (context.may_have_started()) return finish(context, StartOutcome::unknown, why, to_do);
    return finish(context, StartOutcome::not_started, why, to_do);
}

HandOffAction fail(StepContext& context, DeviceFault fault, const std::string& why, const Sentence& to_do) {
    context.h.fault = fault;
    return give_up(context, why, to_do);
}

HandOffAction withdraw(StepContext& context, const std::string& why, const Sentence& to_do) {
    context.set_reason(why, to_do);
    if (context.h.is_stored) return enter(context, HandOffStep::cancel);
    if (context.h.claim_sent) return enter(context, HandOffStep::release);
    return give_up(context, why, to_do);
}

namespace {

Sentence stop_there(const StepContext& context) {
    return Sentence::with_key(
        "stop_there", {context.plan.options.address},
        "If it must not run on: Stop, here or at the panel of the cell. The next dispatch follows it to its end.");
}

void set_reason_of_request(StepContext& context) {
    HandOff& h = context.h;
    h.cancelled = true;
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
    h.cancelled = true;
    h.deferred.reset();
    return withdraw(context, "stopped on request before the start", "");
}

HandOffAction leave_running_job(StepContext& context) {
    HandOff& h = context.h;
    h.cancelled = true;
    if (!context.plan.options.stop_when_cancelled) {
        context.set_reason("stopped monitoring on request; the job runs on by itself", stop_there(context));
        return enter(context, HandOffStep::release);
    }
    context.report("stopping the machine on request");
    h.leave_by_s += context.timings().answer_s - context.timings().leave_s;
    return send_new(context, CellCommand::stop, context.job_id());
}

}  // namespace qchopper::hand_off
