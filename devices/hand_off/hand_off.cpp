// What every step of the hand-off has in common: lost links, exceptions, acknowledgements, heartbeats.
//
// Every CLAIM has a higher epoch than the one before, and the cell refuses commands of a lower one: a lease (C. Gray,
// D. Cheriton: Leases: An Efficient Fault-Tolerant Mechanism for Distributed File Cache Consistency, 1989) with a
// fencing number. What is in transit when the link is lost is void after the next CLAIM, and QUERY after that shows
// whether the job has started. O(1) for each turn.

#include "devices/hand_off/hand_off.h"

#include <algorithm>
#include <iterator>

#include "devices/hand_off/first_contact.h"
#include "devices/hand_off/hand_off_context.h"
#include "devices/hand_off/operator_text.h"

namespace qchopper::hand_off {

HandOffAction plain(Kind kind) {
    HandOffAction action;
    action.kind = kind;
    return action;
}

namespace {

// Not beyond the end of a hand-off that is to end.
HandOffAction wait_for(const StepContext& context, double seconds) {
    HandOffAction action = plain(Kind::wait);
    action.until_s = context.now_s + seconds;
    if (context.is_leaving()) action.until_s = std::min(action.until_s, context.h.leave_by_s);
    return action;
}

void keep_intent(StepContext& context) {
    const Command& command = context.h.command;
    const bool is_claim = command.command == CellCommand::claim;
    const bool is_start = command.command == CellCommand::start;
    JournalEvent& event = context.keep(is_claim   ? JournalKind::claim
                                       : is_start ? JournalKind::start_intent
                                                  : JournalKind::command);
    event.command = command.command;
    event.epoch = command.epoch;
    event.seq = command.seq;
    event.owner = command.owner;
    event.secret = command.arg1;
    event.token = command.token;
}

}  // namespace

HandOffAction pause(StepContext& context) {
    const HandOff& h = context.h;
    constexpr double leaving_poll_s = 0.1;
    const double poll_s = context.timings().poll_s;
    HandOffAction wait = wait_for(context, context.is_leaving() ? std::min(poll_s, leaving_poll_s) : poll_s);
    if (h.is_owner) wait.until_s = std::min(wait.until_s, h.heartbeat_s + context.timings().heartbeat_s);
    return wait;
}

HandOffAction send(StepContext& context, CellCommand command) {
    HandOff& h = context.h;
    h.command.epoch = h.epoch;
    h.command.seq = ++h.seq;
    h.command.command = command;
    h.command.owner = context.plan.owner;
    h.waits_for_ack = true;
    h.has_pending = false;
    h.sent_s = context.now_s;
    h.step_since_s = context.now_s;
    keep_intent(context);
    HandOffAction action = plain(Kind::write_command);
    action.command = h.command;
    return action;
}

HandOffAction send_new(StepContext& context, CellCommand command, const Uuid& job_id) {
    context.h.command = Command{};
    context.h.command.job_id = job_id;
    return send(context, command);
}

HandOffAction fence(StepContext& context, const std::string& why) {
    if (context.is_leaving()) return leave_at_once(context);
    if (++context.h.fences > max_fences) {
        return give_up(context,
                       "the hand-off was interrupted " + std::to_string(context.h.fences) +
                           " times and is given up, the last time because " + why,
                       "Mend the link, or what ends the lease, then dispatch again: first it asks the cell.");
    }
    end_request(context, CommandEnd::unknown, why + "; whether the cell has done it is not known: ask the cell");
    context.report(why + "; claiming the cell again, then querying the job; " + foam(context));
    return enter(context, HandOffStep::claim);
}

namespace {

constexpr const char* mend_drop_folder =
    "See that the drop folder of the cell is there and can be written to (is its share mounted?), then dispatch again.";
constexpr double back_off_s[] = {0.25, 0.5, 1, 2, 4, 5};
constexpr int max_busy_answers = 10;
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
        const ContactFailure failure = contact_failure(context.in);
        return fail(context, failure.fault, failure.why, failure.to_do);
    }
    return wait_for(context, *pause_s);
}

// After a refusal that does not concern the job: CANCEL and RELEASE as far as that is still possible.
HandOffAction back_out(StepContext& context, const std::string& why, const Sentence& to_do) {
    HandOff& h = context.h;
    if (h.step == HandOffStep::release || !h.claim_sent) return give_up(context, why, to_do);
    const bool is_withdrawn = !h.why.empty();
    if (!is_withdrawn && !h.is_started) return withdraw(context, why, to_do);
    if (!is_withdrawn) context.set_reason(why, to_do);
    return enter(context, HandOffStep::release);
}

// A factor of 1 to 1.25, another one for each dispatcher, so that two do not come back in step.
double jitter(const StepContext& context) {
    const std::uint32_t mixed = (context.plan.owner ^ static_cast<std::uint32_t>(context.h.lost_times)) * 2654435761U;
    return 1 + 0.25 * static_cast<double>(mixed >> 16U) / 65536;
}

HandOffAction on_lost(StepContext& context) {
    HandOff& h = context.h;
    h.deferred.reset();
    if (!h.status) return try_contact_again(context);
    if (h.last.kind == Kind::read_identity && context.in.fault != BlockFault::none) {
        if (const std::optional<HandOffAction> end = on_bad_identity(context)) return *end;
    }
    if (h.step == HandOffStep::release) return give_up(context, "the link was lost during RELEASE");
    if (context.is_leaving() && (h.is_started || context.may_have_started())) return leave_at_once(context);
    if (h.lost_since_s < 0) {
        h.lost_since_s = context.now_s;
        h.lost_times = 0;
        context.report("the link to the cell is lost (" + context.in.why + "); trying again; " + foam(context));
    }
    if (context.now_s - h.lost_since_s > context.timings().link_patience_s) {
        return give_up(context,
                       h.is_started ? "the link to the cell was lost; the job runs on by itself"
                                    : "the link to the cell was lost and did not come back",
                       "Look at the cell. Dispatch again when the link is back: first it asks the cell what became of "
                       "the job.");
    }
    const double pause_s = back_off_s[std::min<std::size_t>(h.lost_times++, std::size(back_off_s) - 1)];
    return wait_for(context, context.is_leaving() ? back_off_s[0] : pause_s * jitter(context));
}

HandOffAction on_exception(StepContext& context) {
    HandOff& h = context.h;
    if (is_busy(context.in) && ++h.busy_times <= max_busy_answers) {
        if (!h.deferred) h.deferred = h.last;
        return wait_for(context, busy_pause_s);
    }
    h.deferred.reset();
    if (!h.status) return try_contact_again(context);
    if (h.last.kind == Kind::read_identity) {
        return give_up(context,
                       "the cell refuses to show its IDENTITY: exception " + std::to_string(context.in.exception) +
                           " (" + context.in.why + ")",
                       "Tell the integrator of the cell.");
    }
    const std::string why =
        "the cell refused a request: exception " + std::to_string(context.in.exception) + " (" + context.in.why + ")";
    if (h.start_sent && !h.is_started && h.fences < max_fences) return fence(context, why);
    return back_out(context, why, "Tell the integrator of the cell.");
}

// Keeps what every STATUS shows, in all steps.
void note_status(StepContext& context) {
    HandOff& h = context.h;
    const Status& fresh = *context.in.status;
    if (h.lost_since_s >= 0) context.report("the link to the cell is back");
    if (!h.status || fresh.heartbeat != h.status->heartbeat || h.lost_since_s >= 0) {
        h.cell_heartbeat_s = context.now_s;
        if (h.is_frozen) context.report("the cell's heartbeat changes again");
        h.is_frozen = false;
    }
    if (h.status && h.step == HandOffStep::run && fresh.state != h.status->state) {
        context.report(std::string("the cell is in ") + name(fresh.state));
    }
    if (has_started(fresh.job_state) && fresh.job_id == context.job_id() && !h.is_started) {
        h.is_started = true;
        context.keep(JournalKind::started).epoch = h.epoch;
        if (h.start_sent) context.report("the job has started");
    }
    if (fresh.job_id == context.job_id()) h.elapsed_s = fresh.elapsed_s;
    h.status = fresh;
}

HandOffAction drop_request(StepContext& context) {
    end_request(context, CommandEnd::unknown,
                "the cell did not answer in time; whether it has done it is not known: ask the cell");
    context.h.waits_for_ack = false;
    return watch(context);
}

HandOffAction wait_for_ack(StepContext& context) {
    HandOff& h = context.h;
    const Status& status = context.status();
    const double waited_s = context.now_s - h.step_since_s;
    const bool asks_person = h.command.command == CellCommand::prepare || h.command.command == CellCommand::clear ||
                             h.command.command == CellCommand::unhold;
    const bool works_long = h.command.command == CellCommand::verify || h.command.command == CellCommand::rehearse;
    const double bound_s = works_long ? 10 * context.timings().answer_s : context.timings().answer_s;
    const bool is_claim = h.command.command == CellCommand::claim;
    const bool has_our_number = status.ack_owner == context.plan.owner && status.ack_seq == h.seq;
    if (has_our_number && (!is_claim || answers_claim(context))) {
        if (status.ack_command != h.command.command) {
            const std::string what = std::string("it acknowledged command ") + std::to_string(h.seq) + " as " +
                                     name(status.ack_command) + ", and that was " + name(h.command.command);
            return h.start_sent || h.is_started ? contradict(context, what) : back_out(context, what, "");
        }
        if (is_refusal(status.ack_result)) return refused(context, status.ack_result);
        if (status.ack_result == AckResult::ok || status.ack_result == AckResult::already) return acknowledged(context);
        if (!h.has_pending && asks_person) context.report("waiting for consent at the cell; nothing moves before");
        h.has_pending = true;
        if (waited_s > (asks_person ? context.timings().consent_s : bound_s)) {
            if (h.request != CellCommand::none) return drop_request(context);
            const std::string waited = " within " + std::to_string(static_cast<int>(waited_s)) + " s";
            return asks_person ? back_out(context, "nobody at the cell consented" + waited,
                                          "Make sure that an operator is at the cell, then dispatch again.")
                               : back_out(context, "the cell did not complete " + in_words(h.command.command) + waited,
                                          "Look at the panel of the cell, then dispatch again.");
        }
        return pause(context);
    }
    if (is_claim) {
        if (std::optional<HandOffAction> again = claim_past_stale_number(context)) return *again;
    }
    // STATUS may hold the acknowledgement of another client by now; the state of the job proves the start as well.
    if (h.step == HandOffStep::start && h.is_started) return acknowledged(context);
    if (waited_s > bound_s && !(h.has_pending && asks_person)) {
        if (h.request != CellCommand::none) return drop_request(context);
        const std::string waited = " for " + std::to_string(static_cast<int>(waited_s)) + " s";
        if (h.step == HandOffStep::start) return fence(context, "the cell has not acknowledged START" + waited);
        return give_up(context,
                       "the cell shows its state, but has not acknowledged " + in_words(h.command.command) + waited,
                       "Look at the panel of the cell for a fault, then dispatch again.");
    }
    double resend_s = context.timings().resend_s;
    if (context.is_leaving()) resend_s = std::min(resend_s, context.timings().leave_s / 4);
    if (context.now_s - h.sent_s <= resend_s) return pause(context);
    h.sent_s = context.now_s;  // the same frame: the cell executes it once, however often it arrives
    HandOffAction again = plain(Kind::write_command);
    again.command = h.command;
    return again;
}

// The heartbeat of the cell stands still although STATUS is read: nothing is sent. A job that runs is followed all the
// same; one that STATUS shows as ended, and one that was not started, are waited for no longer than for a lost link.
HandOffAction wait_for_heartbeat(StepContext& context) {
    HandOff& h = context.h;
    const double unchanged_s = context.now_s - h.cell_heartbeat_s;
    const bool is_new = !h.is_frozen;
    h.is_frozen = true;
    const std::string what = has_ended(context) ? "the job has ended, and then the heartbeat of the cell stopped"
                                                : "CELL FROZEN: the heartbeat of the cell has stopped";
    if (is_new) context.report(what + "; no command is sent while it stands still; " + foam(context));
    const bool is_followed = h.is_started && !has_ended(context);
    if (is_followed || unchanged_s <= context.timings().link_patience_s) return pause(context);
    return give_up(context, what + " and did not go on within " + std::to_string(static_cast<int>(unchanged_s)) + " s",
                   "Look at the controller of the cell: it answers, but its program stands still.");
}

HandOffAction on_status(StepContext& context) {
    HandOff& h = context.h;
    if (h.step == HandOffStep::check_cell) return check_identity(context);
    // A hand-off that is to end does not wait for the heartbeat: CANCEL and RELEASE do no harm, whenever they take
    // effect.
    if (!context.is_leaving() && context.now_s - h.cell_heartbeat_s > context.timings().frozen_s) {
        return wait_for_heartbeat(context);
    }
    if (h.waits_for_ack) return wait_for_ack(context);
    if (h.step == HandOffStep::make_ready) return make_idle(context);
    if (h.step == HandOffStep::deliver) return send_file(context);
    if (h.step == HandOffStep::run) return watch(context);
    return enter(context, h.step);
}

HandOffAction after_answer(StepContext& context) {
    HandOff& h = context.h;
    switch (h.last.kind) {
        case Kind::stage_file:
            if (!context.in.why.empty()) return give_up(context, context.in.why, mend_drop_folder);
            h.file_is_staged = true;
            return enter(context, HandOffStep::claim);
        case Kind::write_ticket:
            return enter(context, HandOffStep::write_signature);
        case Kind::write_signature:
            return enter(context, HandOffStep::store);
        case Kind::put_file:
            if (!context.in.why.empty()) return withdraw(context, context.in.why, mend_drop_folder);
            return enter(context, HandOffStep::verify);
        case Kind::write_chunk:
            return send_file(context);
        case Kind::read_status:
            return context.in.status ? on_status(context) : plain(Kind::read_status);
        case Kind::read_result:
            return context.in.result ? on_result(context) : pause(context);
        case Kind::read_identity:
            return context.in.identity ? on_identity(context) : plain(Kind::read_identity);
        default:
            return plain(Kind::read_status);
    }
}

HandOffAction next_action(StepContext& context) {
    HandOff& h = context.h;
    if (!h.has_begun) {
        h.has_begun = true;
        const HandOffPast& past = context.plan.options.past;
        h.epoch = past.epoch;
        h.seq = past.seq;
        h.store = h.kept_store = past.store;
        h.grant = past.grant;
        static_cast<JobPast&>(h) = past;
        if (!context.in.cancelled) return plain(Kind::read_status);
    }
    const std::uint32_t boots = h.status ? h.status->boot_count : 0;
    const bool was_lost = h.lost_since_s >= 0;
    if (context.in.status) {
        if (const std::optional<HandOffAction> end = compare_cell(context)) return *end;
        note_status(context);
    }
    if (context.in.status && h.step > HandOffStep::check_cell) {
        if (const std::optional<HandOffAction> end = compare_counters(context)) return *end;
    }
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
            h.claim_reason = "the link to the cell was lost";
            if (h.step != HandOffStep::release) return plain(Kind::read_identity);
        }
        if (context.in.status->boot_count != boots && h.step != HandOffStep::release) {
            h.claim_reason = "the cell was restarted";
            return plain(Kind::read_identity);
        }
    }
    if (context.in.status && was_lost) {
        h.lost_since_s = -1;
        if (!context.is_leaving()) h.waits_for_ack = false;  // lost during CLAIM: claim with a higher number
        if (h.step == HandOffStep::claim && !context.is_leaving()) return plain(Kind::read_identity);
    }
    if (context.in.request != CellCommand::none) {
        if (const std::optional<HandOffAction> action = take_request(context)) return *action;
    }
    return after_answer(context);
}

}  // namespace
}  // namespace qchopper::hand_off

namespace qchopper {

HandOffTransition advance(const HandOffPlan& plan, HandOff state, const HandOffInput& input, double now_s) {
    HandOffTransition result;
    hand_off::StepContext context{plan, state, input, now_s, result};
    HandOffAction action = hand_off::next_action(context);
    // Never two in a row: over a link slower than the period of the heartbeats nothing else would be sent.
    const bool is_due = state.is_owner && state.last.kind != HandOffAction::Kind::heartbeat &&
                        now_s - state.heartbeat_s >= plan.options.timings.heartbeat_s;
    if (is_due && action.kind != HandOffAction::Kind::finish && action.kind != HandOffAction::Kind::wait &&
        action.kind != HandOffAction::Kind::read_identity && state.lost_since_s < 0) {
        state.deferred = action;
        action = hand_off::plain(HandOffAction::Kind::heartbeat);
        action.heartbeat = {state.epoch, plan.owner, ++state.heartbeat_counter};
        state.heartbeat_s = now_s;
    }
    state.last = action;
    result.state = std::move(state);
    result.action = action;
    return result;
}

}  // namespace qchopper
