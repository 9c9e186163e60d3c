#include "devices/hand_off.h"

#include <algorithm>
#include <iterator>

#include "devices/first_contact.h"
#include "devices/hand_off_turn.h"

namespace qchopper::turning {

HandOffAction plain(Kind kind, std::string journal) {
    HandOffAction action;
    action.kind = kind;
    action.journal = std::move(journal);
    return action;
}

HandOffAction pause(TurnUnderWay& turn) {
    HandOffAction action = plain(Kind::wait);
    constexpr double leaving_poll_s = 0.1;
    const double poll_s = turn.timings().poll_s;
    action.until_s = turn.now_s + (turn.is_leaving() ? std::min(poll_s, leaving_poll_s) : poll_s);
    if (turn.is_leaving()) action.until_s = std::min(action.until_s, turn.h.leave_by_s);
    if (turn.h.is_owner) action.until_s = std::min(action.until_s, turn.h.beat_s + turn.timings().heartbeat_s);
    return action;
}

HandOffAction send(TurnUnderWay& turn, CellCommand command, std::string journal) {
    HandOff& h = turn.h;
    h.command.epoch = h.epoch;
    h.command.seq = ++h.seq;
    h.command.command = command;
    h.command.owner = turn.plan.owner;
    h.waits_for_ack = true;
    h.has_pending = false;
    h.sent_s = turn.now_s;
    h.step_since_s = turn.now_s;
    HandOffAction action = plain(Kind::write_command, std::move(journal));
    action.command = h.command;
    return action;
}

HandOffAction finish(TurnUnderWay& turn, StartVerdict verdict, const std::string& why, const std::string& to_do) {
    turn.h.verdict = verdict;
    if (turn.h.why.empty()) {
        turn.h.why = why;
        turn.h.to_do = to_do;
    }
    if (turn.h.is_cancelled && verdict == StartVerdict::not_started && turn.h.claim_sent && !turn.h.is_given_back) {
        turn.h.why += "; the cell did not confirm that it dropped the job";
        turn.h.to_do = "It cannot start: the cell holds no valid START for it.";
    }
    turn.h.step = HandOffStep::finished;
    turn.say(std::string(words(verdict)) + ": " + turn.h.why);
    return plain(Kind::finish, "CLOSED " + std::string(words(verdict)));
}

HandOffAction give_up(TurnUnderWay& turn, const std::string& why, const std::string& to_do) {
    if (turn.h.contradicts_itself) return finish(turn, StartVerdict::unknown, why, to_do);
    if (turn.h.is_started) return finish(turn, StartVerdict::started, why, to_do);
    if (turn.h.start_sent) return finish(turn, StartVerdict::unknown, why, "Look at the cell before anything else.");
    return finish(turn, StartVerdict::not_started, why, to_do);
}

HandOffAction fail(TurnUnderWay& turn, DeviceFault fault, const std::string& why, const std::string& to_do) {
    turn.h.fault = fault;
    return finish(turn, StartVerdict::not_started, why, to_do);
}

HandOffAction withdraw(TurnUnderWay& turn, const std::string& why, const std::string& to_do) {
    turn.h.why = why;
    turn.h.to_do = to_do;
    turn.say(why);
    if (turn.h.is_stored) return enter(turn, HandOffStep::cancel);
    if (turn.h.claim_sent) return enter(turn, HandOffStep::release);
    return finish(turn, StartVerdict::not_started, why, to_do);
}

HandOffAction fence(TurnUnderWay& turn, const std::string& why) {
    if (turn.is_leaving()) return leave_at_once(turn);
    if (++turn.h.fences > most_fences) return give_up(turn, why + ", again and again");
    turn.say(why + "; claiming the cell anew, then asking it what it knows of the job");
    return enter(turn, HandOffStep::claim);
}

namespace {

constexpr double back_off_s[] = {0.25, 0.5, 1, 2, 4, 5};
constexpr int most_busy_answers = 10;
constexpr double busy_pause_s = 0.5;

HandOffAction try_contact_again(TurnUnderWay& turn) {
    HandOff& h = turn.h;
    if (h.lost_since_s < 0) {
        h.lost_since_s = turn.now_s;
        h.lost_times = 0;
    }
    const std::optional<double> pause_s =
        pause_before_next_contact(turn.in, h.lost_times++, turn.now_s - h.lost_since_s);
    if (!pause_s) {
        const ContactFailure failure = why_no_contact(turn.in);
        return fail(turn, failure.fault, failure.why, failure.to_do);
    }
    HandOffAction action = plain(Kind::wait);
    action.until_s = turn.now_s + *pause_s;
    return action;
}

// After a refusal that has nothing to do with the job: takes it out of the cell as far as that can still be done.
HandOffAction back_out(TurnUnderWay& turn, const std::string& why, const std::string& to_do) {
    HandOff& h = turn.h;
    if (h.step == HandOffStep::release || !h.claim_sent) return give_up(turn, why, to_do);
    const bool is_withdrawn = !h.why.empty();
    if (!is_withdrawn && !h.is_started) return withdraw(turn, why, to_do);
    if (!is_withdrawn) {
        h.why = why;
        h.to_do = to_do;
        turn.say(why);
    }
    return enter(turn, HandOffStep::release);
}

HandOffAction on_lost(TurnUnderWay& turn) {
    HandOff& h = turn.h;
    h.deferred.reset();
    if (!h.status) return try_contact_again(turn);
    if (h.step == HandOffStep::release) return give_up(turn, "the link was lost while giving the cell back");
    if (turn.is_leaving() && (h.is_started || h.start_sent)) return leave_at_once(turn);
    if (h.lost_since_s < 0) {
        h.lost_since_s = turn.now_s;
        h.lost_times = 0;
        turn.say("the link to the cell is lost (" + turn.in.why + "); trying again");
    }
    if (turn.now_s - h.lost_since_s > turn.timings().link_patience_s) {
        return give_up(turn, h.is_started ? "the link to the cell was lost; the job runs on by itself"
                                          : "the link to the cell was lost and did not come back");
    }
    HandOffAction action = plain(Kind::wait);
    action.until_s = turn.now_s + back_off_s[std::min<std::size_t>(h.lost_times++, std::size(back_off_s) - 1)];
    if (turn.is_leaving()) action.until_s = std::min(turn.now_s + back_off_s[0], h.leave_by_s);
    return action;
}

HandOffAction on_exception(TurnUnderWay& turn) {
    HandOff& h = turn.h;
    const bool is_busy = turn.in.exception == 5 || turn.in.exception == 6;
    if (is_busy && ++h.busy_times <= most_busy_answers) {
        if (!h.deferred) h.deferred = h.last;
        HandOffAction action = plain(Kind::wait);
        action.until_s = turn.now_s + busy_pause_s;
        if (turn.is_leaving()) action.until_s = std::min(action.until_s, h.leave_by_s);
        return action;
    }
    h.deferred.reset();
    if (!h.status) return try_contact_again(turn);
    const std::string why =
        "the cell refused a request: exception " + std::to_string(turn.in.exception) + " (" + turn.in.why + ")";
    const bool may_have_started = h.start_sent && !h.is_started;
    if (may_have_started && h.fences < most_fences) return fence(turn, why);
    return back_out(turn, why, "Tell the integrator of the cell.");
}

// Keeps what every good STATUS tells, whatever the step.
void note_status(TurnUnderWay& turn) {
    HandOff& h = turn.h;
    const Status& fresh = *turn.in.status;
    if (h.lost_since_s >= 0) turn.say("the link to the cell is back");
    if (!h.status || fresh.heartbeat != h.status->heartbeat || h.lost_since_s >= 0) {
        h.cell_beat_s = turn.now_s;
        if (h.is_frozen) turn.say("the cell's heartbeat moves again");
        h.is_frozen = false;
    }
    if (h.status && h.step == HandOffStep::run && fresh.state != h.status->state) {
        turn.say(std::string("the cell is in ") + name(fresh.state));
    }
    if (has_started(fresh.job_state) && fresh.job_id == turn.job_id() && !h.is_started) {
        h.is_started = true;
        if (h.start_sent) turn.say("the job has started");
    }
    if (fresh.job_id == turn.job_id()) h.elapsed_s = fresh.elapsed_s;
    h.status = fresh;
}

HandOffAction wait_for_ack(TurnUnderWay& turn) {
    HandOff& h = turn.h;
    const Status& status = turn.status();
    const double waited_s = turn.now_s - h.step_since_s;
    const bool asks_person = h.command.command == CellCommand::prepare || h.command.command == CellCommand::clear;
    const bool works_long = h.command.command == CellCommand::verify || h.command.command == CellCommand::rehearse;
    const double bound_s = works_long ? 10 * turn.timings().answer_s : turn.timings().answer_s;
    if (status.ack_owner == turn.plan.owner && status.ack_seq == h.seq) {
        if (status.ack_command != h.command.command) {
            const std::string what = std::string("it acknowledged number ") + std::to_string(h.seq) + " as " +
                                     name(status.ack_command) + ", and that was " + name(h.command.command);
            return h.start_sent || h.is_started ? contradict(turn, what) : back_out(turn, what, "");
        }
        if (is_refusal(status.ack_result)) return refused(turn, status.ack_result);
        if (status.ack_result == AckResult::ok || status.ack_result == AckResult::already) return acknowledged(turn);
        if (!h.has_pending && asks_person) turn.say("waiting for consent at the cell");
        h.has_pending = true;
        if (waited_s > (asks_person ? turn.timings().consent_s : bound_s)) {
            return withdraw(turn, std::string(name(h.command.command)) + " was not settled at the cell in time",
                            "Is somebody at the cell?");
        }
        return pause(turn);
    }
    // The acknowledgement of somebody else may have come in between; the job itself tells.
    if (h.step == HandOffStep::start && h.is_started) return acknowledged(turn);
    if (waited_s > bound_s && !(h.has_pending && asks_person)) {
        if (h.step == HandOffStep::start) return fence(turn, "the cell does not acknowledge START");
        return give_up(turn, std::string("the cell does not acknowledge ") + name(h.command.command));
    }
    double resend_s = turn.timings().resend_s;
    if (turn.is_leaving()) resend_s = std::min(resend_s, turn.timings().leave_s / 4);
    if (turn.now_s - h.sent_s <= resend_s) return pause(turn);
    h.sent_s = turn.now_s;  // the very same frame: it is done once, however often it arrives
    HandOffAction again = plain(Kind::write_command);
    again.command = h.command;
    return again;
}

HandOffAction on_status(TurnUnderWay& turn) {
    HandOff& h = turn.h;
    if (h.step == HandOffStep::check_cell) return look_at_cell(turn);
    // Whoever leaves does not wait for the heartbeat: CANCEL and RELEASE do no harm, whenever they are taken.
    if (!turn.is_leaving() && turn.now_s - h.cell_beat_s > turn.timings().frozen_s) {
        if (!h.is_frozen) turn.say("CELL FROZEN: the cell answers, but its heartbeat stands still; no command is sent");
        h.is_frozen = true;
        if (!h.is_started && turn.now_s - h.cell_beat_s > turn.timings().link_patience_s) {
            return give_up(turn, "the cell is frozen: it answers, but its heartbeat stands still");
        }
        return pause(turn);
    }
    if (h.waits_for_ack) return wait_for_ack(turn);
    switch (h.step) {
        case HandOffStep::make_ready:
            return get_ready(turn);
        case HandOffStep::deliver:
            return send_file(turn);
        case HandOffStep::run:
            return watch(turn);
        default:
            return enter(turn, h.step);
    }
}

HandOffAction after_answer(TurnUnderWay& turn) {
    HandOff& h = turn.h;
    switch (h.last.kind) {
        case Kind::stage_file:
            h.file_is_staged = true;
            return enter(turn, HandOffStep::claim);
        case Kind::write_ticket:
            return enter(turn, HandOffStep::write_signature);
        case Kind::write_signature:
            return enter(turn, HandOffStep::store);
        case Kind::put_file:
            if (!turn.in.why.empty()) return withdraw(turn, turn.in.why, "Is the drop folder still there?");
            return enter(turn, HandOffStep::verify);
        case Kind::write_chunk:
            return send_file(turn);
        case Kind::read_status:
            return turn.in.status ? on_status(turn) : plain(Kind::read_status);
        case Kind::read_result:
            return turn.in.result ? take_result(turn) : pause(turn);
        default:
            return plain(Kind::read_status);
    }
}

}  // namespace

HandOffAction next_action(TurnUnderWay& turn) {
    HandOff& h = turn.h;
    if (!h.has_begun) {
        h.has_begun = true;
        if (!turn.in.cancelled) return plain(Kind::read_status);
    }
    const std::uint32_t boots = h.status ? h.status->boot_count : 0;
    const bool was_lost = h.lost_since_s >= 0;
    if (turn.in.status) note_status(turn);
    if (turn.in.cancelled || turn.is_leaving()) {
        if (const std::optional<HandOffAction> way_out = leave(turn)) return *way_out;
    }
    if (turn.in.end == BusEnd::lost) return on_lost(turn);
    if (turn.in.end == BusEnd::exception) return on_exception(turn);
    if (h.last.kind != Kind::wait && h.last.kind != Kind::heartbeat) h.busy_times = 0;
    if (h.deferred && (h.last.kind == Kind::heartbeat || h.last.kind == Kind::wait)) {
        HandOffAction action = *h.deferred;
        h.deferred.reset();
        return action;
    }
    if (turn.in.status && h.step > HandOffStep::claim && !turn.is_leaving()) {
        if (was_lost) {
            h.lost_since_s = -1;
            if (h.step != HandOffStep::release) return fence(turn, "what was under way is not known");
        }
        if (turn.in.status->boot_count != boots && h.step != HandOffStep::release) {
            return fence(turn, "the cell was switched off and on in between");
        }
    }
    if (turn.in.status && was_lost) {
        h.lost_since_s = -1;
        if (!turn.is_leaving()) h.waits_for_ack = false;  // lost during CLAIM: claim with a higher number
    }
    return after_answer(turn);
}

}  // namespace qchopper::turning

namespace qchopper {

HandOffTurn advance(const HandOffPlan& plan, HandOff state, const HandOffInput& input, double now_s) {
    HandOffTurn result;
    turning::TurnUnderWay turn{plan, state, input, now_s, result.lines};
    HandOffAction action = turning::next_action(turn);
    const bool beat_due = state.is_owner && now_s - state.beat_s >= plan.options.timings.heartbeat_s;
    if (beat_due && action.kind != HandOffAction::Kind::finish && action.kind != HandOffAction::Kind::wait &&
        state.lost_since_s < 0) {
        state.deferred = action;
        action = turning::plain(HandOffAction::Kind::heartbeat);
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
