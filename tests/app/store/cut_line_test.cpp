#include <gtest/gtest.h>

#include "app/store/decisions.h"

namespace qchopper {
namespace {

std::string line_with(double chosen, double runner_up, const SearchSettings& settings = {}) {
    Cut cut;
    cut.number = 1;
    cut.piece = "A";
    cut.chosen.terms.total = chosen;
    cut.candidates = 120;
    cut.runners_up.resize(1);
    cut.runners_up[0].terms.total = runner_up;
    cut.pieces = {"B", "C"};
    return cut_line(cut, settings);
}

TEST(CutLine, CallsThePlaneTheBestUnlessAnotherIsBetterByMoreThanATie) {
    for (const double runner_up : {3.5, 3.0, 3.0 - 5e-10}) {
        EXPECT_NE(line_with(3.0, runner_up).find("best of 120 planes"), std::string::npos) << runner_up;
    }
    EXPECT_NE(line_with(3.0, 3.0 - 1e-6).find("one of 120 planes"), std::string::npos);
}

TEST(CutLine, CallsARefinedPlaneTheBestOnlyIfItsTotalIs) {
    Cut cut;
    cut.number = 1;
    cut.piece = "A";
    cut.chosen.normal_index = refined_index;
    cut.chosen.terms.total = 3;
    cut.candidates = 120;
    cut.runners_up.resize(1);
    cut.runners_up[0].terms.total = 2.9;
    EXPECT_NE(cut_line(cut, {}).find("one of 120 planes, refined"), std::string::npos) << cut_line(cut, {});
    cut.runners_up[0].terms.total = 3.1;
    EXPECT_NE(cut_line(cut, {}).find("best of 120 planes, refined"), std::string::npos) << cut_line(cut, {});
}

TEST(CutLine, TellsJudgedPlanesFromThoseEvaluatedWhole) {
    SearchSettings settings;
    settings.objectives.weights.unreachable = 100;
    settings.candidates.offsets_per_normal = 80;
    EXPECT_NE(line_with(3, 4, settings).find("best of up to 10,560 planes, 120 of them evaluated whole, total"),
              std::string::npos)
        << line_with(3, 4, settings);
}

}  // namespace
}  // namespace qchopper
