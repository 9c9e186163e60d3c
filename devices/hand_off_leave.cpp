#include <cassert>

#include "devices/hand_off_turn.h"

namespace qchopper::turning {

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

HandOffAction leave_at_once(TurnUnderWay& turn) {
    assert(turn.is_leaving());
    note_what_is_known(turn.h);
    return give_up(turn, "stopped on request");
}

std::optional<HandOffAction> leave(TurnUnderWay& turn) {
    HandOff& h = turn.h;
    if (!turn.is_leaving()) h.leave_by_s = turn.now_s + turn.timings().leave_s;
    if (turn.now_s >= h.leave_by_s) return leave_at_once(turn);
    const bool half_over = turn.now_s >= h.leave_by_s - turn.timings().leave_s / 2;
    const bool may_have_started = h.start_sent && !h.is_started;
    if (half_over && h.claim_sent && h.step < HandOffStep::release && !may_have_started) {
        // A cell that answers to nothing else may still take RELEASE, which voids the token of a job just as well.
        note_what_is_known(h);
        h.deferred.reset();
        return enter(turn, HandOffStep::release);
    }
    if (h.start_sent || h.is_started || !h.why.empty()) return std::nullopt;
    h.is_cancelled = true;
    h.deferred.reset();
    return withdraw(turn, "stopped on request before the start", "");
}

HandOffAction leave_running_job(TurnUnderWay& turn) {
    HandOff& h = turn.h;
    h.is_cancelled = true;
    if (!turn.plan.options.stop_when_cancelled) {
        h.why = "stopped watching on request; the job runs on by itself";
        h.to_do = "Stop it at the cell if it must not run.";
        turn.say(h.why);
        return enter(turn, HandOffStep::release);
    }
    turn.say("stopping the machine on request");
    h.leave_by_s = turn.now_s + turn.timings().answer_s;
    h.command = Command{};
    h.command.job_id = turn.job_id();
    return send(turn, CellCommand::stop, "STOP job=" + to_text(turn.job_id()));
}

}  // namespace qchopper::turning
