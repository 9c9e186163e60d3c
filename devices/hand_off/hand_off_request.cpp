// Unhold and Clear for another program, while this one holds the lease. O(1).

#include "devices/hand_off/hand_off.h"
#include "devices/hand_off/hand_off_context.h"

namespace qchopper::hand_off {

std::optional<HandOffAction> take_request(StepContext& context) {
    HandOff& h = context.h;
    const CellCommand request = context.in.request;
    const auto refuse = [&](const std::string& why) { context.turn.request_answer = {CommandEnd::refused, why}; };
    if (h.request != CellCommand::none || h.waits_for_ack) {
        refuse(std::string("the dispatcher waits for the answer of the cell to ") + name(h.command.command));
        return std::nullopt;
    }
    if (h.step != HandOffStep::run || !h.is_owner || context.is_leaving() || h.lost_since_s >= 0) {
        refuse(std::string("the dispatcher is at the step \"") + name(h.step) + "\" and cannot pass it on now");
        return std::nullopt;
    }
    if (context.status().has(flag::local_control)) {
        refuse("the cell is under local control (LOCAL_CONTROL)");
        return std::nullopt;
    }
    context.report(std::string("passing on ") + name(request) + " on request");
    h.request = request;
    return send_new(context, request, request == CellCommand::clear ? Uuid{} : context.job_id());
}

void end_request(StepContext& context, CommandEnd end, const std::string& why) {
    if (context.h.request == CellCommand::none) return;
    context.turn.request_answer = {end, why};
    context.h.request = CellCommand::none;
}

}  // namespace qchopper::hand_off
