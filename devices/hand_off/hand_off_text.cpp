// What the operator is told: whether foam is being cut, and what to do. O(1).

#include "devices/hand_off/hand_off.h"
#include "devices/hand_off/hand_off_context.h"
#include "devices/hand_off/operator_text.h"

namespace qchopper::hand_off {
namespace {

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

Sentence look_first(const StepContext& context, Sentence then) {
    std::string text = "Go to the cell and look whether it cuts. Ask it. " + then.text;
    return Sentence::with_key("look_first", {context.plan.options.address, std::move(then)}, std::move(text));
}

Sentence accept_memory(const StepContext& context) {
    return Sentence::with_key("accept_memory", {context.plan.options.address},
                              "Look at the cell and what it has cut, then accept its memory.");
}

Sentence usual_remedy(const StepContext& context, StartOutcome start_outcome) {
    if (start_outcome == StartOutcome::not_started) {
        return "Look at the panel of the cell, mend the cause, and dispatch again.";
    }
    if (start_outcome == StartOutcome::unknown) return "The next dispatch asks the cell before it sends a job.";
    if (is_complete(context)) return {};
    if (has_ended(context)) return "Look at the cell and at the piece before the next dispatch.";
    return Sentence::with_key("look_at_job", {context.plan.options.address},
                              "Look at the cell. The next dispatch follows the job to its end.");
}

}  // namespace qchopper::hand_off

namespace qchopper {

Sentence remedy(AckResult refusal) {
    struct RefusalRow {
        AckResult refusal;
        const char* text;
    };
    constexpr const char* changed = "Something changed the job file on the way; dispatch it again.";
    constexpr const char* other_cell = "Prepare the project with the cell file of this cell.";
    constexpr const char* again = "Dispatch it again: that is a new job with a token of its own.";
    constexpr const char* full_disk = "Free space on the disk of the cell.";
    constexpr RefusalRow remedies[] = {
        {AckResult::no_consent, "Ask the operator at the cell, then dispatch again."},
        {AckResult::file_missing, "Check that the drop folder is the one from which the cell fetches job files."},
        {AckResult::hash_mismatch, changed},
        {AckResult::file_size, changed},
        {AckResult::envelope, other_cell},
        {AckResult::stock_too_small, other_cell},
        {AckResult::tool, other_cell},
        {AckResult::program_unreadable, "Read in the log of the cell which line it is; prepare the project again."},
        {AckResult::store_full, full_disk},
        {AckResult::store_io, full_disk},
        {AckResult::ticket_field, other_cell},
        {AckResult::token_bad, again},
        {AckResult::token_expired, again},
        {AckResult::safety_open, "Close the door and release the emergency stop, then dispatch again."},
        {AckResult::local_control, "Set the panel of the cell to remote, then dispatch again."},
        {AckResult::bad_signature, "Sign the ticket with a key that the cell trusts, then dispatch again."},
        {AckResult::unknown_key,
         "Have the key trusted on the box that verifies for the cell, or sign with another key."},
        {AckResult::stale_epoch, "Only one dispatcher may drive a cell."},
    };
    if (refusal == AckResult::rehearsal_required) {
        return Sentence::with_key("rehearse", {}, "Let the cell rehearse the job first.");
    }
    for (const RefusalRow& row : remedies) {
        if (row.refusal == refusal) return row.text;
    }
    return {};
}

const char* name(HandOffStep step) {
    constexpr const char* names[] = {
        "check the cell", "stage the file",  "claim",   "ask before", "ask for the file", "make ready",
        "write ticket",   "write signature", "store",   "deliver",    "verify",           "rehearse",
        "prepare",        "start",           "run",     "ask after",  "clear result",     "reset",
        "cancel",         "release",         "finished"};
    return names[static_cast<std::size_t>(step)];
}

}  // namespace qchopper
