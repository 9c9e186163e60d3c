// O(1) for each refusal, whatever it is repeated.

#include "sim/cell/link/refusals.h"

namespace qchopper {
namespace {

constexpr double first_line_s = 1;  // so that what comes together is told together
constexpr double line_s = 60;

constexpr std::array<const char*, static_cast<std::size_t>(RefusedBecause::count)> words = {
    "not on the list of allowed addresses",
    "for a newcomer that needed the place",
    "not Modbus TCP",
    "request not whole in time",
    "answers not read in time",
    "silent for too long",
    "no descriptor free",
};

}  // namespace

void Refusals::add(RefusedBecause why, const std::string& peer, LinkTime now) {
    ++counts_[static_cast<std::size_t>(why)];
    last_peer_ = peer;
    if (!first_) first_ = now;
}

std::optional<std::string> Refusals::line(LinkTime now) {
    if (!first_ || seconds_between(*first_, now) < first_line_s) return std::nullopt;
    if (last_line_ && seconds_between(*last_line_, now) < line_s) return std::nullopt;
    last_line_ = now;
    return rest();
}

std::optional<std::string> Refusals::rest() {
    if (!first_) return std::nullopt;
    std::string text;
    std::size_t sum = 0;
    for (std::size_t i = 0; i < counts_.size(); ++i) {
        if (counts_[i] == 0) continue;
        sum += counts_[i];
        text += (text.empty() ? "" : ", ") + std::to_string(counts_[i]) + " " + words[i];
    }
    counts_ = {};
    first_.reset();
    return std::to_string(sum) + (sum == 1 ? " connection" : " connections") + " refused or closed, the last from " +
           last_peer_ + ": " + text;
}

}  // namespace qchopper
