// Does the block stand in the cell, and the piece in the block? Every answer is a margin with a name.
//
// Millimetres; negative: violated. First check only: boxes, no kinematics. A piece fits when no margin is negative
// (tests/cam/setup/envelope_test.cpp).

#pragma once

#include <string>
#include <vector>

#include "cam/setup/setup.h"

namespace qchopper {

struct Margin {
    std::string name;     // "block top to reach ceiling"
    std::string problem;  // what is wrong when it is negative: "too high for block ..."
    double mm = 0;
    bool operator==(const Margin&) const = default;
};

struct EnvelopeReport {
    std::vector<Margin> margins;
    bool operator==(const EnvelopeReport&) const = default;
    bool fits() const;
    // The smallest margin. There is always one.
    const Margin& worst() const;
};

EnvelopeReport check_envelope(const Setup& setup, const Cell& cell);

// "piece B does not fit: 32 mm too high for block medium (600 x 400 x 400 mm), ..."; "piece B fits, ..." otherwise.
std::string envelope_words(const std::string& piece, const EnvelopeReport& report);

}  // namespace qchopper
