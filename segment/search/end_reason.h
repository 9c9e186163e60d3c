// Reasons for which a search ends, and their sentences (tests/segment/search/end_reason_test.cpp).

#pragma once

#include <string>

namespace qchopper {

enum class EndReason {
    rules_hold,   // the stop rules
    no_rule,      // none is set
    no_plane,     // none of the pieces that break a rule has a candidate
    passed_over,  // the same with max_unreachable set: no candidate, or none that makes the piece better
    max_cuts,     // the safety stop
    time_limit,   // the search could go on
};

// Whether no cut is missing.
constexpr bool is_finished(EndReason reason) {
    return reason == EndReason::rules_hold || reason == EndReason::no_rule;
}

// The sentence of a reason, such as "the safety stop of 500 cuts is reached". `figure`: the number in it, or the list
// of pieces, if it has one.
std::string describe(EndReason reason, const std::string& figure = {});

}  // namespace qchopper
