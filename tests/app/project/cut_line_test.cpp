#include <gtest/gtest.h>

#include "app/project/decisions.h"

namespace qchopper {
namespace {

std::string line_with(double chosen, double runner_up) {
    Cut cut;
    cut.number = 1;
    cut.piece = "A";
    cut.chosen.terms.total = chosen;
    cut.candidates = 120;
    cut.runners_up.resize(1);
    cut.runners_up[0].terms.total = runner_up;
    cut.pieces = {"B", "C"};
    return cut_line(cut);
}

TEST(CutLine, CallsThePlaneTheBestUnlessAnotherIsBetterByMoreThanATie) {
    for (const double runner_up : {3.5, 3.0, 3.0 - 5e-10}) {
        EXPECT_NE(line_with(3.0, runner_up).find("best of 120 planes"), std::string::npos) << runner_up;
    }
    EXPECT_NE(line_with(3.0, 3.0 - 1e-6).find("one of 120 planes"), std::string::npos);
}

}  // namespace
}  // namespace qchopper
