// The answer to QUERY: compared with what the cell has reported before, and what follows from it. O(1).

#include <cassert>

#include "devices/hand_off/hand_off_context.h"
#include "devices/hand_off/operator_text.h"

namespace qchopper::hand_off {
namespace {

using enum HandOffStep;

bool answers_our_query(const StepContext& context) {
    const ResultRecord& result = *context.in.result;
    return result.query_owner == context.plan.owner && result.query_seq == context.h.command.seq &&
           (result.job_id == context.job_id() || context.h.step == ask_file);
}

std::string describe(const ResultRecord& result) {
    return std::string(name(result.state)) + " (STARTS " + std::to_string(result.starts) + ")";
}

// What contradicts earlier answers of the cell, or "".
std::string contradiction_in(const StepContext& context) {
    const HandOff& h = context.h;
    const ResultRecord& result = *context.in.result;
    const bool started = has_started(result.state);
    if (result.starts != (started ? 1U : 0U)) return "QUERY reports the job as " + describe(result);
    if (started && (h.start_sent || h.is_started) && result.file_sha256 != context.plan.ticket.file_sha256) {
        return "it has carved another file under this job id";
    }
    if (started) return {};
    if (h.is_started && result.state != JobState::none) {
        return "STATUS has shown the job as started, and QUERY reports it as " + describe(result);
    }
    const bool was_acknowledged = h.start_acknowledged || h.step == ask_after;
    if (!h.is_started && was_acknowledged) {
        return "it acknowledged START, and QUERY reports the job as " + describe(result);
    }
    return {};
}

HandOffAction report_end(StepContext& context) {
    HandOff& h = context.h;
    const ResultRecord& result = *h.result;
    JournalEvent& event = context.keep(JournalKind::result);
    event.job_state = result.state;
    event.job_result = result.result;
    event.starts = result.starts;
    h.why = result.state == JobState::ended && result.result == JobResult::complete
                ? "the job ran to its end"
                : std::string("the job started and was ") + name(result.state) + " (" + name(result.result) + ")";
    if (result.state == JobState::aborted)
        h.to_do = Sentence::with_key("look_then_carve_again", {},
                                     "Look at the cell. The file is carved once more only if that is asked for.");
    return enter(context, h.claim_sent ? clear_result : release);
}

// Why a START that may have arrived may be missing from the cell's memory, or "". A copy of the memory from before the
// epoch of that START was found already; one from between the two shows by a restart, if at all.
std::string how_it_may_have_forgotten(const StepContext& context) {
    const HandOff& h = context.h;
    if (!h.start_sent || h.checks_store || context.status().boot_count == h.start_boots) return {};
    return "the cell was restarted after START was sent, and it cannot find out whether its store is an older copy";
}

// The answer to QUERY_FILE: a job other than ours has been started with this file.
HandOffAction on_file_result(StepContext& context) {
    HandOff& h = context.h;
    const ResultRecord& result = *context.in.result;
    if (result.job_id == context.job_id()) {
        return contradict(context, "QUERY does not know the job as started, and QUERY_FILE does");
    }
    const std::string before = "job " + to_text(result.job_id) + ", which is " + name(result.state) + " (" +
                               name(result.result) +
                               "); started with this file so far: " + std::to_string(context.status().ack_detail);
    if (context.plan.options.again) {
        context.report("the file is carved again: " + before);
        return enter(context, make_ready);
    }
    h.milled_before = result;
    return withdraw(context, "the cell has carved this file before: " + before, carve_again());
}

// Another client may have sent a QUERY in between.
HandOffAction query_again(StepContext& context) {
    HandOff& h = context.h;
    if (++h.odd_answers <= max_odd_answers) return pause(context);
    const std::string why = "the cell answers QUERY repeatedly with the result of job " +
                            to_text(context.in.result->job_id) + " for the query of another client";
    if (!h.start_sent && !h.is_started) return withdraw(context, why, "Stop other programs that query the cell.");
    context.set_reason(why, "");
    return enter(context, release);
}

// Before the start: nothing if the hand-off may continue.
std::optional<HandOffAction> check_state_before(StepContext& context) {
    HandOff& h = context.h;
    const ResultRecord& result = *context.in.result;
    const bool started = has_started(result.state);
    if (started && result.file_sha256 != context.plan.ticket.file_sha256) {
        h.refusal = AckResult::job_id_reused;
        return withdraw(context, "the cell has carved another file under this job id", "Dispatch it as a new job.");
    }
    if (started) context.report("the cell has started this job before; continuing with its result");
    if (const std::string how = started ? "" : how_it_may_have_forgotten(context); !how.empty()) {
        context.set_reason(how, accept_memory(context));
        return enter(context, release);
    }
    if (!started) h.is_excluded = true;
    if (!started && h.start_sent) {
        h.start_sent = false;
        context.keep(JournalKind::start_void);
        if (++h.attempts > 2)
            return withdraw(context, "START did not reach the cell, three times",
                            "Mend the link to the cell, then dispatch again.");
        context.report(std::string("START did not reach the cell and no longer can") +
                       (context.plan.adopts ? "" : "; preparing the job again"));
    }
    if (result.state == JobState::cancelled) {
        h.refusal = AckResult::cancelled;
        return withdraw(context, "the job was cancelled in the cell", "Dispatch it as a new job.");
    }
    if (!started && h.is_taken_over) {
        return finish(context, StartOutcome::not_started, "another dispatcher has taken the cell over",
                      "Try again when it has finished.");
    }
    if (!started && context.plan.adopts && !h.is_started) {
        return withdraw(context, "an earlier dispatcher ended before the job was started",
                        "Nothing has to be done: the piece is dispatched as a new job.");
    }
    return std::nullopt;
}

}  // namespace

HandOffAction contradict(StepContext& context, const std::string& what) {
    HandOff& h = context.h;
    h.contradicts_itself = true;
    context.set_reason("the cell contradicts itself: " + what, "");
    return h.claim_sent ? enter(context, release) : give_up(context, h.why, h.to_do);
}

HandOffAction on_result(StepContext& context) {
    HandOff& h = context.h;
    assert(h.step == ask_before || h.step == ask_file || h.step == ask_after);
    if (!answers_our_query(context)) return query_again(context);
    if (h.step == ask_file) return on_file_result(context);
    if (const std::optional<HandOffAction> lost = compare_grant(context)) return *lost;
    if (const std::string what = contradiction_in(context); !what.empty()) return contradict(context, what);
    const ResultRecord& result = *context.in.result;
    if (h.step == ask_before) {
        if (std::optional<HandOffAction> instead = check_state_before(context)) return *instead;
    }
    if (!has_started(result.state) && h.is_started) {
        h.why = "the job has started, but the cell no longer has a record of it";
        h.to_do = accept_memory(context);
        return enter(context, release);
    }
    if (!has_started(result.state)) return enter(context, h.step == ask_before ? ask_file : make_ready);
    if (!h.is_started) context.keep(JournalKind::started).epoch = result.start_epoch;
    h.is_started = true;
    h.result = result;
    if (is_over(result.state)) return report_end(context);
    // After the start there is a QUERY only if STATUS did not show the job as running.
    if (h.step == ask_after && ++h.odd_answers > max_odd_answers) {
        return contradict(context,
                          "QUERY reports the job as " + describe(result) + ", and STATUS shows " +
                              (context.shows_our_job() ? std::string("it as ") + name(context.status().job_state)
                                                       : std::string("another job or none")));
    }
    h.step = run;
    h.step_since_s = context.now_s;
    return pause(context);
}

}  // namespace qchopper::hand_off
