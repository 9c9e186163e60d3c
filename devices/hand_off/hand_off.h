// The hand-off of one job as a pure state machine: the state, the last answer and the time give the next action.
//
// Seconds of a monotonic clock. Nothing here reads or writes anything outside: dispatch.h keeps the events of a turn in
// the journal, then performs its action, and returns the answer. A token is used by one START only, whose frame may
// be repeated unchanged, after a CLAIM and a QUERY of the same epoch. The verdict is UNKNOWN wherever neither the start
// nor its impossibility is certain (tests/devices/hand_off/hand_off_test.cpp).

#pragma once

#include <string>
#include <vector>

#include "devices/hand_off/hand_off_state.h"

namespace qchopper {

// Of one of the enumerators.
const char* name(HandOffStep step);

// One turn. `input` is the answer to the action of the turn before, at first HandOffInput{}; now_s never decreases.
// After the action `finish` there is no further turn: the outcome is in `state`, or the error state.fault.
HandOffTransition advance(const HandOffPlan& plan, HandOff state, const HandOffInput& input, double now_s);

// What the operator can do after a refusal; "" if nothing is known.
Sentence remedy(AckResult refusal);

}  // namespace qchopper
