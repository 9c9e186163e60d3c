// The choices of a check of a controller, and what it found.
//
// Times in seconds.

#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "devices/hand_off/dispatch_options.h"

namespace qchopper {

struct LinkCheckOptions {
    // Whether the command may be sent; empty: none of those that could move something is.
    std::function<bool(const std::string& question)> consent;
    HandOffClock clock;
    std::function<std::uint32_t()> random;  // draws owner, secret and job id; empty: the operating system does
    double answer_s = 10;                   // for a command without consent
    double consent_s = 600;                 // for the operator at the cell
};

struct CheckedRule {
    std::string block;          // "STATUS"
    std::uint16_t address = 0;  // of the register that shows it
    std::string field;          // its name
    std::string rule;           // what the map demands, as a clause: "is one more each 500 ms"
    bool holds = false;
    std::string seen;  // what was read instead; empty where it holds
};

struct LinkCheck {
    std::vector<CheckedRule> rules;        // in the order in which they were checked
    std::vector<std::string> not_checked;  // a sentence for each, with the reason

    bool holds() const;
};

}  // namespace qchopper
