// Sentences from values.

#include "cam/job/job_program.h"

#include <algorithm>

#include "base/text.h"

namespace qchopper {

std::string describe(const ProofFinding& finding) {
    if (finding.file.empty()) return finding.text;
    if (finding.line == 0) return finding.file + ": " + finding.text;
    return finding.file + " line " + std::to_string(finding.line) + ": " + finding.text;
}

double ProofResult::figure(std::string_view key) const {
    const auto found =
        std::find_if(figures.begin(), figures.end(), [&](const ProofFigure& own) { return own.key == key; });
    return found == figures.end() ? 0 : found->value;
}

std::string describe(const MovesLeftOut& moves) {
    if (moves.because.empty()) return {};
    return "no arm posture reaches " + fixed(moves.length_mm, 0) + " mm of its cuts: " + moves.because +
           "; they are left out, and the proof counts the foam that stays";
}

}  // namespace qchopper
