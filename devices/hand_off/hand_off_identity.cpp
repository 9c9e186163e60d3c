// Whether the cell still has the memory that it had: its IDENTITY compared with the one seen before. O(1).

#include "devices/hand_off/hand_off_context.h"
#include "devices/hand_off/seen_store.h"

namespace qchopper::hand_off {
namespace {

// Nothing more is sent: what the cell would answer to QUERY proves nothing.
HandOffAction end_with_lost_store(StepContext& context, const SeenStore& now, const std::string& what) {
    HandOff& h = context.h;
    h.store_is_lost = true;
    h.store = h.kept_store = now;
    context.keep(JournalKind::store_lost).store = now;
    h.claim_sent = h.is_owner = false;
    h.why = "CELL_STORE_LOST: the cell has not the memory that it had before; " + what;
    h.to_do = accept_memory(context);
    return give_up(context, h.why, h.to_do);
}

HandOffAction compare(StepContext& context, const SeenStore& now) {
    HandOff& h = context.h;
    if (context.plan.options.past.store_is_lost) {
        return end_with_lost_store(context, now, "nobody has accepted its new one");
    }
    if (h.store) {
        if (const std::string what = loss_between(*h.store, now); !what.empty()) {
            return end_with_lost_store(context, now, what);
        }
    }
    h.store = now;
    keep_store(context);
    if (h.step == HandOffStep::check_cell) return enter(context, HandOffStep::stage_file);
    if (h.step == HandOffStep::claim) return enter(context, HandOffStep::claim);
    return fence(context, h.claim_reason);
}

}  // namespace

std::optional<HandOffAction> on_bad_identity(StepContext& context) {
    HandOff& h = context.h;
    if (++h.bad_identities < max_bad_identities) return std::nullopt;
    const std::string why = "the cell's IDENTITY cannot be read: it is " + std::string(describe(context.in.fault)) +
                            ", " + std::to_string(h.bad_identities) + " times in a row";
    const Sentence to_do = "Check gateway and cable; tell the integrator of the cell.";
    return h.claim_sent ? give_up(context, why, to_do) : fail(context, DeviceFault::protocol, why, to_do);
}

HandOffAction on_identity(StepContext& context) {
    context.h.bad_identities = 0;
    context.h.checks_store = context.in.identity->checks_store == 1;
    return compare(context, seen_store(*context.in.identity));
}

std::optional<HandOffAction> compare_cell(StepContext& context) {
    HandOff& h = context.h;
    const Status& fresh = *context.in.status;
    if (!h.status || h.step == HandOffStep::check_cell) return std::nullopt;
    const auto shown = [](const Status& status) {
        return std::string("CELL_ID ") + std::to_string(status.cell_id) + " and " +
               (status.has(flag::simulated) ? "simulated" : "real");
    };
    if (shown(fresh) == shown(*h.status)) return std::nullopt;
    h.claim_sent = h.is_owner = false;
    return give_up(
        context,
        "another cell answers now: " + shown(fresh) + ", and before " + shown(*h.status) + "; nothing more was sent",
        "Find out which cell is at this address, then dispatch again.");
}

std::optional<HandOffAction> compare_counters(StepContext& context) {
    HandOff& h = context.h;
    if (!h.store) return std::nullopt;
    const SeenStore now = seen_store(context.status(), h.store->store_id);
    if (const std::string what = loss_between(*h.store, now); !what.empty()) {
        return end_with_lost_store(context, now, what);
    }
    h.store = now;
    return std::nullopt;
}

std::optional<HandOffAction> compare_grant(StepContext& context) {
    HandOff& h = context.h;
    if (h.command.arg0 != 0 && context.in.result->grant_epoch == 0) {
        const SeenStore now = seen_store(context.status(), h.store ? h.store->store_id : Uuid{});
        return end_with_lost_store(context, now, "it does not know the last CLAIM of this PC that it granted");
    }
    const bool has_forgotten = h.is_started && context.in.result->state == JobState::none;
    if (has_forgotten) {
        const SeenStore now = seen_store(context.status(), h.store ? h.store->store_id : Uuid{});
        return end_with_lost_store(context, now, "the job has started, and the cell no longer has a record of it");
    }
    if (!h.is_owner || h.new_grant == 0 || h.new_grant == h.grant) return std::nullopt;
    h.grant = h.new_grant;
    JournalEvent& event = context.keep(JournalKind::granted);
    event.epoch = h.epoch;
    event.owner = context.plan.owner;
    event.grant = h.grant;
    return std::nullopt;
}

void keep_store(StepContext& context) {
    HandOff& h = context.h;
    if (!h.store || h.store == h.kept_store) return;
    h.kept_store = h.store;
    context.keep(JournalKind::identity).store = *h.store;
}

}  // namespace qchopper::hand_off
