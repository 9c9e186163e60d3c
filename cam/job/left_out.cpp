// Sentences from values.

#include "cam/job/left_out.h"

#include "base/text.h"

namespace qchopper {

std::string describe(const MovesLeftOut& moves) {
    if (moves.because.empty()) return {};
    return "no hold of the arm carries " + fixed(moves.length_mm, 0) + " mm of its cuts: " + moves.because +
           "; they are left out, and the proof counts the foam that stays";
}

}  // namespace qchopper
