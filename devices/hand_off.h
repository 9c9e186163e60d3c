// The hand-off of one job as a pure state machine: what is known, what was answered and the time give the next action.
//
// Seconds of a clock that never jumps. Nothing here touches the outside world: dispatch.h does the actions, writes the
// journal row of an action before it, and brings back the answers. START is sent at most once per token, and only
// after a fresh CLAIM and a QUERY; whatever is not known for certain is reported UNKNOWN
// (tests/devices/hand_off_test.cpp).

#pragma once

#include <string>
#include <vector>

#include "devices/hand_off_input.h"
#include "devices/hand_off_state.h"

namespace qchopper {

const char* name(HandOffStep step);

struct HandOffTransition {
    HandOff state;
    HandOffAction action;
    std::vector<std::string> lines;  // for the operator
};
HandOffTransition advance(const HandOffPlan& plan, HandOff state, const HandOffInput& input, double now_s);

// What helps after a refusal, or nothing.
const char* remedy(AckResult refusal);

}  // namespace qchopper
