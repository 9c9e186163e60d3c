// What the cell says to QUERY, and what does not agree with what it has said before.

#include <cassert>

#include "devices/hand_off_context.h"

namespace qchopper::hand_off {
namespace {

using enum HandOffStep;

bool answers_our_query(const StepContext& context) {
    const ResultRecord& result = *context.in.result;
    return result.query_owner == context.plan.owner && result.query_seq == context.h.command.seq &&
           result.job_id == context.job_id();
}

bool is_over(JobState state) {
    return state == JobState::ended || state == JobState::aborted;
}

std::string in_words(const ResultRecord& result) {
    return std::string(name(result.job_state)) + " (STARTS " + std::to_string(result.starts) + ")";
}

// Empty if RESULT can be true.
std::string contradiction_in(const StepContext& context) {
    const HandOff& h = context.h;
    const ResultRecord& result = *context.in.result;
    const bool started = has_started(result.job_state);
    if (result.starts != (started ? 1U : 0U)) return "QUERY says that the job is " + in_words(result);
    if (started && (h.start_sent || h.is_started) && result.file_sha256 != context.plan.ticket.file_sha256) {
        return "it has carved another file than ours under our job id";
    }
    if (started) return {};
    if (h.is_started && result.job_state != JobState::none) {
        return "STATUS has shown the job as started, and QUERY says that it is " + in_words(result);
    }
    const bool was_acknowledged = h.start_acknowledged || h.step == ask_after;
    if (!h.is_started && was_acknowledged) {
        return "it acknowledged START, and QUERY says that the job is " + in_words(result);
    }
    return {};
}

HandOffAction tell_end(StepContext& context) {
    HandOff& h = context.h;
    const ResultRecord& result = *h.result;
    h.why =
        result.job_state == JobState::ended && result.job_result == JobResult::complete
            ? "the job ran to its end"
            : std::string("the job started and was ") + name(result.job_state) + " (" + name(result.job_result) + ")";
    if (result.job_state == JobState::aborted) h.to_do = "Look at the cell; a new dispatch is a new job.";
    return enter(context, clear_result);
}

// Another client may have asked in between, now and then.
HandOffAction ask_again(StepContext& context) {
    HandOff& h = context.h;
    if (++h.odd_answers <= most_odd_answers) return pause(context);
    const std::string why = "the cell answers QUERY again and again with the result of job " +
                            to_text(context.in.result->job_id) + " for another question than ours";
    if (!h.start_sent && !h.is_started)
        return withdraw(context, why, "Does another program ask the cell all the time?");
    h.why = why;
    h.to_do = "Look at the cell before anything else.";
    context.say(why);
    return enter(context, release);
}

HandOffAction take_state_before(StepContext& context) {
    HandOff& h = context.h;
    const ResultRecord& result = *context.in.result;
    const bool started = has_started(result.job_state);
    if (started && result.file_sha256 != context.plan.ticket.file_sha256) {
        h.refusal = AckResult::job_id_reused;
        return withdraw(context, "the cell has carved another file under this job id", "Dispatch it as a new job.");
    }
    if (started) context.say("the cell has started this job before; taking up its result");
    if (!started && h.start_sent) {
        h.start_sent = false;
        if (++h.attempts > 2) return withdraw(context, "START did not reach the cell, three times", "");
        context.say("START did not reach the cell and now never can; preparing it again");
    }
    if (result.job_state == JobState::cancelled) {
        h.refusal = AckResult::cancelled;
        return withdraw(context, "the job was cancelled in the cell", "Dispatch it as a new job.");
    }
    return plain(Kind::finish);  // nothing against going on
}

}  // namespace

HandOffAction contradict(StepContext& context, const std::string& what) {
    HandOff& h = context.h;
    h.contradicts_itself = true;
    h.why = "the cell contradicts itself: " + what;
    h.to_do = "Look at the cell before anything else.";
    context.say(h.why);
    return h.claim_sent ? enter(context, release) : give_up(context, h.why, h.to_do);
}

HandOffAction take_result(StepContext& context) {
    HandOff& h = context.h;
    assert(h.step == ask_before || h.step == ask_after);
    if (!answers_our_query(context)) return ask_again(context);
    if (const std::string what = contradiction_in(context); !what.empty()) return contradict(context, what);
    const ResultRecord& result = *context.in.result;
    if (h.step == ask_before) {
        HandOffAction instead = take_state_before(context);
        if (instead.kind != Kind::finish || h.step == finished) return instead;
    }
    if (!has_started(result.job_state) && h.is_started) {
        h.why = "the job has started, but the cell no longer remembers it";
        h.to_do = "Look at the cell: its memory was lost.";
        return enter(context, release);
    }
    if (!has_started(result.job_state)) return enter(context, make_ready);
    h.is_started = true;
    h.result = result;
    if (is_over(result.job_state)) return tell_end(context);
    // STATUS did not show it running, or this would not have been asked after the start.
    if (h.step == ask_after && ++h.odd_answers > most_odd_answers) {
        return contradict(context,
                          "QUERY says that the job is " + in_words(result) + ", and STATUS shows " +
                              (context.shows_our_job() ? std::string("it as ") + name(context.status().job_state)
                                                       : std::string("another job or none")));
    }
    h.step = run;
    h.step_since_s = context.now_s;
    return pause(context);
}

}  // namespace qchopper::hand_off
