// CLAIM: its epoch, its number, and what a refusal means. O(1).
//
// The journal may have lost its last rows, as after a copy of the disk was put back. The owner of its last CLAIM then
// goes on with numbers that the cell has seen already, and which it ignores as STALE_SEQ.

#include <algorithm>

#include "devices/hand_off/hand_off.h"
#include "devices/hand_off/hand_off_context.h"
#include "devices/hand_off/operator_text.h"
#include "devices/hand_off/seen_store.h"

namespace qchopper::hand_off {
namespace {

// ", held by dispatcher 0x1234ABCD", or nothing if the cell shows no lease.
std::string holder(const Status& status) {
    if (status.owner_held == 0) return {};
    return ", held by " + dispatcher_name(status.owner_held);
}

}  // namespace

HandOffAction send_claim(StepContext& context) {
    HandOff& h = context.h;
    if (++h.claims > max_claims) return give_up(context, in_words(CellCommand::claim) + " has failed ten times");
    h.epoch = std::max(h.epoch, context.status().epoch_held) + 1;
    h.seq = number_after(context.status(), context.plan.owner, h.seq);
    h.bad_frames = context.status().bad_frames;
    h.command = Command{};
    h.command.arg0 = context.plan.options.takeover_code;
    h.command.arg1 = context.plan.secret;
    h.claim_sent = true;
    return send(context, CellCommand::claim);
}

bool answers_claim(const StepContext& context) {
    return is_answer_to_claim(context.status(), context.h.epoch);
}

std::optional<HandOffAction> claim_past_stale_number(StepContext& context) {
    if (!has_refused_number(context.h.bad_frames, context.status())) return std::nullopt;
    context.report(
        "the cell has had a later command of this dispatcher than the journal knows: the journal lost its last rows; "
        "claiming the cell under a higher number");
    context.h.seq += skipped_numbers;
    return enter(context, HandOffStep::claim);
}

HandOffAction claim_refused(StepContext& context, AckResult result, const std::string& answer) {
    HandOff& h = context.h;
    const bool is_busy = result == AckResult::lease_busy;
    if (!h.start_sent && !h.is_stored && !h.is_started) {
        if (result == AckResult::stale_epoch) return fence(context, "another dispatcher claimed the cell first");
        return fail(context, is_busy ? DeviceFault::busy : DeviceFault::refused,
                    "the cell cannot be claimed: " + answer + (is_busy ? holder(context.status()) : ""),
                    is_busy ? wait_or_take_over(context.plan.options.address) : Sentence());
    }
    h.is_owner = h.claim_sent = false;
    if (!is_busy) return give_up(context, "the cell cannot be claimed again: " + answer, remedy(result));
    // The lease of the other one has a higher epoch than our START: that is void, and QUERY needs no lease.
    h.is_taken_over = true;
    context.report("the cell was taken over by another dispatcher" + holder(context.status()) + "; querying the job");
    return enter(context, HandOffStep::ask_before);
}

}  // namespace qchopper::hand_off
