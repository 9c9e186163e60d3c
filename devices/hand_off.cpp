#include "devices/hand_off.h"

#include <algorithm>
#include <iterator>

#include "devices/first_contact.h"
#include "devices/hand_off_context.h"

namespace qchopper::hand_off {

HandOffAction plain(Kind kind, std::string journal) {
    HandOffAction action;
    action.kind = kind;
    action.journal = std::move(journal);
    return action;
}

HandOffAction pause(StepContext& context) {
    HandOffAction action = plain(Kind::wait);
    constexpr double leaving_poll_s = 0.1;
    const double poll_s = context.timings().poll_s;
    action.until_s = context.now_s + (context.is_leaving() ? std::min(poll_s, leaving_poll_s) : poll_s);
    if (context.is_leaving()) action.until_s = std::min(action.until_s, context.h.leave_by_s);
    if (context.h.is_owner) action.until_s = std::min(action.until_s, context.h.beat_s + context.timings().heartbeat_s);
    return action;
}

HandOffAction send(StepContext& context, CellCommand command, std::string journal) {
    HandOff& h = context.h;
    h.command.epoch = h.epoch;
    h.command.seq = ++h.seq;
    h.command.command = command;
    h.command.owner = context.plan.owner;
    h.waits_for_ack = true;
    h.has_pending = false;
    h.sent_s = context.now_s;
    h.step_since_s = context.now_s;
    HandOffAction action = plain(Kind::write_command, std::move(journal));
    action.command = h.command;
    return action;
}

HandOffAction finish(StepContext& context, StartVerdict verdict, const std::string& why, const std::string& to_do) {
    context.h.verdict = verdict;
    if (context.h.why.empty()) {
        context.h.why = why;
        context.h.to_do = to_do;
    }
    if (context.h.is_cancelled && verdict == StartVerdict::not_started && context.h.claim_sent &&
        !context.h.is_given_back) {
        context.h.why += "; the cell did not confirm that it dropped the job";
        context.h.to_do = "It cannot start: the cell holds no valid START for it.";
    }
    context.h.step = HandOffStep::finished;
    context.say(std::string(describe(verdict)) + ": " + context.h.why);
    return plain(Kind::finish, "CLOSED " + std::string(describe(verdict)));
}

HandOffAction give_up(StepContext& context, const std::string& why, const std::string& to_do) {
    if (context.h.contradicts_itself) return finish(context, StartVerdict::unknown, why, to_do);
    if (context.h.is_started) return finish(context, StartVerdict::started, why, to_do);
    if (context.h.start_sent)
        return finish(context, StartVerdict::unknown, why, "Look at the cell before anything else.");
    return finish(context, StartVerdict::not_started, why, to_do);
}

HandOffAction fail(StepContext& context, DeviceFault fault, const std::string& why, const std::string& to_do) {
    context.h.fault = fault;
    return finish(context, StartVerdict::not_started, why, to_do);
}

HandOffAction withdraw(StepContext& context, const std::string& why, const std::string& to_do) {
    context.h.why = why;
    context.h.to_do = to_do;
    context.say(why);
    if (context.h.is_stored) return enter(context, HandOffStep::cancel);
    if (context.h.claim_sent) return enter(context, HandOffStep::release);
    return finish(context, StartVerdict::not_started, why, to_do);
}

HandOffAction fence(StepContext& context, const std::string& why) {
    if (context.is_leaving()) return leave_at_once(context);
    if (++context.h.fences > most_fences) return give_up(context, why + ", again and again");
    context.say(why + "; claiming the cell anew, then asking it what it knows of the job");
    return enter(context, HandOffStep::claim);
}

namespace {

constexpr double back_off_s[] = {0.25, 0.5, 1, 2, 4, 5};
constexpr int most_busy_answers = 10;
constexpr double busy_pause_s = 0.5;

HandOffAction try_contact_again(StepContext& context) {
    HandOff& h = context.h;
    if (h.lost_since_s < 0) {
        h.lost_since_s = context.now_s;
        h.lost_times = 0;
    }
    const std::optional<double> pause_s =
        pause_before_next_contact(context.in, h.lost_times++, context.now_s - h.lost_since_s);
    if (!pause_s) {
        const ContactFailure failure = why_no_contact(context.in);
        return fail(context, failure.fault, failure.why, failure.to_do);
    }
    HandOffAction action = plain(Kind::wait);
    action.until_s = context.now_s + *pause_s;
    return action;
}

// After a refusal that has nothing to do with the job: takes it out of the cell as far as that can still be done.
HandOffAction back_out(StepContext& context, const std::string& why, const std::string& to_do) {
    HandOff& h = context.h;
    if (h.step == HandOffStep::release || !h.claim_sent) return give_up(context, why, to_do);
    const bool is_withdrawn = !h.why.empty();
    if (!is_withdrawn && !h.is_started) return withdraw(context, why, to_do);
    if (!is_withdrawn) {
        h.why = why;
        h.to_do = to_do;
        context.say(why);
    }
    return enter(context, HandOffStep::release);
}

HandOffAction on_lost(StepContext& context) {
    HandOff& h = context.h;
    h.deferred.reset();
    if (!h.status) return try_contact_again(context);
    if (h.step == HandOffStep::release) return give_up(context, "the link was lost while giving the cell back");
    if (context.is_leaving() && (h.is_started || h.start_sent)) return leave_at_once(context);
    if (h.lost_since_s < 0) {
        h.lost_since_s = context.now_s;
        h.lost_times = 0;
        context.say("the link to the cell is lost (" + context.in.why + "); trying again");
    }
    if (context.now_s - h.lost_since_s > context.timings().link_patience_s) {
        return give_up(context, h.is_started ? "the link to the cell was lost; the job runs on by itself"
                                             : "the link to the cell was lost and did not come back");
    }
    HandOffAction action = plain(Kind::wait);
    action.until_s = context.now_s + back_off_s[std::min<std::size_t>(h.lost_times++, std::size(back_off_s) - 1)];
    if (context.is_leaving()) action.until_s = std::min(context.now_s + back_off_s[0], h.leave_by_s);
    return action;
}

HandOffAction on_exception(StepContext& context) {
    HandOff& h = context.h;
    const bool is_busy = context.in.exception == 5 || context.in.exception == 6;
    if (is_busy && ++h.busy_times <= most_busy_answers) {
        if (!h.deferred) h.deferred = h.last;
        HandOffAction action = plain(Kind::wait);
        action.until_s = context.now_s + busy_pause_s;
        if (context.is_leaving()) action.until_s = std::min(action.until_s, h.leave_by_s);
        return action;
    }
    h.deferred.reset();
    if (!h.status) return try_contact_again(context);
    const std::string why =
        "the cell refused a request: exception " + std::to_string(context.in.exception) + " (" + context.in.why + ")";
    const bool may_have_started = h.start_sent && !h.is_started;
    if (may_have_started && h.fences < most_fences) return fence(context, why);
    return back_out(context, why, "Tell the integrator of the cell.");
}

// Keeps what every good STATUS tells, whatever the step.
void note_status(StepContext& context) {
    HandOff& h = context.h;
    const Status& fresh = *context.in.status;
    if (h.lost_since_s >= 0) context.say("the link to the cell is back");
    if (!h.status || fresh.heartbeat != h.status->heartbeat || h.lost_since_s >= 0) {
        h.cell_beat_s = context.now_s;
        if (h.is_frozen) context.say("the cell's heartbeat moves again");
        h.is_frozen = false;
    }
    if (h.status && h.step == HandOffStep::run && fresh.state != h.status->state) {
        context.say(std::string("the cell is in ") + name(fresh.state));
    }
    if (has_started(fresh.job_state) && fresh.job_id == context.job_id() && !h.is_started) {
        h.is_started = true;
        if (h.start_sent) context.say("the job has started");
    }
    if (fresh.job_id == context.job_id()) h.elapsed_s = fresh.elapsed_s;
    h.status = fresh;
}

HandOffAction wait_for_ack(StepContext& context) {
    HandOff& h = context.h;
    const Status& status = context.status();
    const double waited_s = context.now_s - h.step_since_s;
    const bool asks_person = h.command.command == CellCommand::prepare || h.command.command == CellCommand::clear;
    const bool works_long = h.command.command == CellCommand::verify || h.command.command == CellCommand::rehearse;
    const double bound_s = works_long ? 10 * context.timings().answer_s : context.timings().answer_s;
    if (status.ack_owner == context.plan.owner && status.ack_seq == h.seq) {
        if (status.ack_command != h.command.command) {
            const std::string what = std::string("it acknowledged number ") + std::to_string(h.seq) + " as " +
                                     name(status.ack_command) + ", and that was " + name(h.command.command);
            return h.start_sent || h.is_started ? contradict(context, what) : back_out(context, what, "");
        }
        if (is_refusal(status.ack_result)) return refused(context, status.ack_result);
        if (status.ack_result == AckResult::ok || status.ack_result == AckResult::already) return acknowledged(context);
        if (!h.has_pending && asks_person) context.say("waiting for consent at the cell");
        h.has_pending = true;
        if (waited_s > (asks_person ? context.timings().consent_s : bound_s)) {
            return withdraw(context, std::string(name(h.command.command)) + " was not settled at the cell in time",
                            "Is somebody at the cell?");
        }
        return pause(context);
    }
    // The acknowledgement of somebody else may have come in between; the job itself tells.
    if (h.step == HandOffStep::start && h.is_started) return acknowledged(context);
    if (waited_s > bound_s && !(h.has_pending && asks_person)) {
        if (h.step == HandOffStep::start) return fence(context, "the cell does not acknowledge START");
        return give_up(context, std::string("the cell does not acknowledge ") + name(h.command.command));
    }
    double resend_s = context.timings().resend_s;
    if (context.is_leaving()) resend_s = std::min(resend_s, context.timings().leave_s / 4);
    if (context.now_s - h.sent_s <= resend_s) return pause(context);
    h.sent_s = context.now_s;  // the very same frame: it is done once, however often it arrives
    HandOffAction again = plain(Kind::write_command);
    again.command = h.command;
    return again;
}

HandOffAction on_status(StepContext& context) {
    HandOff& h = context.h;
    if (h.step == HandOffStep::check_cell) return look_at_cell(context);
    // Whoever leaves does not wait for the heartbeat: CANCEL and RELEASE do no harm, whenever they are taken.
    if (!context.is_leaving() && context.now_s - h.cell_beat_s > context.timings().frozen_s) {
        if (!h.is_frozen)
            context.say("CELL FROZEN: the cell answers, but its heartbeat stands still; no command is sent");
        h.is_frozen = true;
        if (!h.is_started && context.now_s - h.cell_beat_s > context.timings().link_patience_s) {
            return give_up(context, "the cell is frozen: it answers, but its heartbeat stands still");
        }
        return pause(context);
    }
    if (h.waits_for_ack) return wait_for_ack(context);
    switch (h.step) {
        case HandOffStep::make_ready:
            return get_ready(context);
        case HandOffStep::deliver:
            return send_file(context);
        case HandOffStep::run:
            return watch(context);
        default:
            return enter(context, h.step);
    }
}

HandOffAction after_answer(StepContext& context) {
    HandOff& h = context.h;
    switch (h.last.kind) {
        case Kind::stage_file:
            h.file_is_staged = true;
            return enter(context, HandOffStep::claim);
        case Kind::write_ticket:
            return enter(context, HandOffStep::write_signature);
        case Kind::write_signature:
            return enter(context, HandOffStep::store);
        case Kind::put_file:
            if (!context.in.why.empty()) return withdraw(context, context.in.why, "Is the drop folder still there?");
            return enter(context, HandOffStep::verify);
        case Kind::write_chunk:
            return send_file(context);
        case Kind::read_status:
            return context.in.status ? on_status(context) : plain(Kind::read_status);
        case Kind::read_result:
            return context.in.result ? take_result(context) : pause(context);
        default:
            return plain(Kind::read_status);
    }
}

}  // namespace

HandOffAction next_action(StepContext& context) {
    HandOff& h = context.h;
    if (!h.has_begun) {
        h.has_begun = true;
        if (!context.in.cancelled) return plain(Kind::read_status);
    }
    const std::uint32_t boots = h.status ? h.status->boot_count : 0;
    const bool was_lost = h.lost_since_s >= 0;
    if (context.in.status) note_status(context);
    if (context.in.cancelled || context.is_leaving()) {
        if (const std::optional<HandOffAction> way_out = leave(context)) return *way_out;
    }
    if (context.in.end == BusEnd::lost) return on_lost(context);
    if (context.in.end == BusEnd::exception) return on_exception(context);
    if (h.last.kind != Kind::wait && h.last.kind != Kind::heartbeat) h.busy_times = 0;
    if (h.deferred && (h.last.kind == Kind::heartbeat || h.last.kind == Kind::wait)) {
        HandOffAction action = *h.deferred;
        h.deferred.reset();
        return action;
    }
    if (context.in.status && h.step > HandOffStep::claim && !context.is_leaving()) {
        if (was_lost) {
            h.lost_since_s = -1;
            if (h.step != HandOffStep::release) return fence(context, "what was under way is not known");
        }
        if (context.in.status->boot_count != boots && h.step != HandOffStep::release) {
            return fence(context, "the cell was switched off and on in between");
        }
    }
    if (context.in.status && was_lost) {
        h.lost_since_s = -1;
        if (!context.is_leaving()) h.waits_for_ack = false;  // lost during CLAIM: claim with a higher number
    }
    return after_answer(context);
}

}  // namespace qchopper::hand_off

namespace qchopper {

HandOffTransition advance(const HandOffPlan& plan, HandOff state, const HandOffInput& input, double now_s) {
    HandOffTransition result;
    hand_off::StepContext context{plan, state, input, now_s, result.lines};
    HandOffAction action = hand_off::next_action(context);
    const bool beat_due = state.is_owner && now_s - state.beat_s >= plan.options.timings.heartbeat_s;
    if (beat_due && action.kind != HandOffAction::Kind::finish && action.kind != HandOffAction::Kind::wait &&
        state.lost_since_s < 0) {
        state.deferred = action;
        action = hand_off::plain(HandOffAction::Kind::heartbeat);
        action.beat = {state.epoch, plan.owner, ++state.beat_counter};
        state.beat_s = now_s;
    }
    state.last = action;
    result.state = std::move(state);
    result.action = std::move(action);
    return result;
}

const char* name(HandOffStep step) {
    constexpr const char* names[] = {"check the cell", "stage the file",  "claim",  "ask before", "make ready",
                                     "write ticket",   "write signature", "store",  "deliver",    "verify",
                                     "rehearse",       "prepare",         "start",  "run",        "ask after",
                                     "clear result",   "reset",           "cancel", "release",    "finished"};
    return names[static_cast<std::size_t>(step)];
}

}  // namespace qchopper
