// A table of sentences and its linear search.

#include "segment/search/end_reason.h"

#include <algorithm>
#include <array>

namespace qchopper {
namespace {

// The text before the figure of a sentence and the text after it.
struct EndSentence {
    EndReason reason;
    const char* before;
    const char* after;
};
constexpr std::array<EndSentence, 6> sentences{{
    {EndReason::rules_hold, "the stop rules hold", ""},
    {EndReason::no_rule, "no stop rule is set", ""},
    {EndReason::no_plane, "no plane parts any of the unfinished pieces", ""},
    {EndReason::passed_over, "every unfinished piece is passed over: ", ""},
    {EndReason::max_cuts, "the safety stop of ", " cuts is reached"},
    {EndReason::time_limit, "the time limit of ", " s is reached"},
}};

}  // namespace

std::string describe(EndReason reason, const std::string& figure) {
    const EndSentence& s =
        *std::find_if(sentences.begin(), sentences.end(), [&](const auto& x) { return x.reason == reason; });
    return s.before + figure + s.after;
}

}  // namespace qchopper
