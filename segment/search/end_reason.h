// Why a search ended, and the sentence that says so: one table, read in both directions.

#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace qchopper {

enum class EndReason {
    rules_hold,
    no_rule,     // none is set
    no_plane,    // of the pieces that break a rule none can be parted
    max_cuts,    // the safety stop
    time_limit,  // the search could go on
};

// Is no cut missing?
constexpr bool is_finished(EndReason reason) {
    return reason == EndReason::rules_hold || reason == EndReason::no_rule;
}

// "the safety stop of 500 cuts is reached". `figure`: the number in the sentence, where there is one.
std::string describe(EndReason reason, const std::string& figure = {});

// The reason of a sentence, whatever its figure. Nothing if no sentence of describe() begins like that.
std::optional<EndReason> end_reason_of(std::string_view sentence);

}  // namespace qchopper
