#include "segment/objectives/objectives.h"

#include <gtest/gtest.h>

namespace qchopper {
namespace {

CutEvaluation two_halves(std::size_t a, std::size_t b) {
    CutEvaluation evaluation;
    evaluation.cap_area_mm2 = 1;
    evaluation.solids = {{a, 10, true, {{1, 2, 10, 3, 6}}}, {b, 10, false, {{1, 1, 10, 1, 5}, {2, 4, 10, 0, 5}}}};
    return evaluation;
}

TEST(Objectives, EvenPiecesCostNothingUpToTheThreshold) {
    EXPECT_EQ(terms(two_halves(100, 150), {}, {})->face_ratio, 0);
    EXPECT_DOUBLE_EQ(terms(two_halves(100, 300), {}, {})->face_ratio, 1.5);
    const std::vector<PieceShare> others{{50, 0.5}};
    EXPECT_DOUBLE_EQ(terms(two_halves(100, 300), others, {})->face_ratio, 4.5);
}

TEST(Objectives, UndercutIsTheMeanOverPiecesOfTheLeastOverBases) {
    EXPECT_DOUBLE_EQ(terms(two_halves(1, 1), {}, {})->undercut, (0.2 + 0.1) / 2);
    Objectives by_count;
    by_count.undercut_by_area = false;
    EXPECT_DOUBLE_EQ(terms(two_halves(1, 1), {}, by_count)->undercut, (0.5 + 0.0) / 2);
    const std::vector<PieceShare> others{{1, 0.5}};
    EXPECT_DOUBLE_EQ(terms(two_halves(1, 1), others, {})->undercut, (0.2 + 0.1 + 0.5) / 3);
}

TEST(Objectives, OverTheCutTheOtherPiecesCountOnlyForWhatIsOutOfReach) {
    Objectives objectives;
    objectives.scope = TermScope::cut;
    objectives.weights = {1, 1, 1, 1, 10};
    CutEvaluation halves = two_halves(100, 300);
    halves.access = CutAccess{20, 1'000};
    const std::vector<PieceShare> others{{7, 0.5, 30}, {9'000, 0.4, 50}};
    const Terms t = *terms(halves, others, objectives);
    EXPECT_DOUBLE_EQ(t.face_ratio, 1.5);
    EXPECT_DOUBLE_EQ(t.undercut, (0.2 + 0.1) / 2);
    EXPECT_DOUBLE_EQ(t.unreachable, 0.1);
    EXPECT_DOUBLE_EQ(t.total, 1.5 + t.fragility + t.piece_count + t.undercut + 1);
    halves.access.reset();
    EXPECT_EQ(terms(halves, others, objectives)->unreachable, 0);
}

TEST(Objectives, ASolidWithoutCapCountsOneHalf) {
    EXPECT_EQ(undercut(SolidEvaluation{}, true), 0.5);
}

TEST(Objectives, FragmentsEnterNothingAndACutThatOnlyShavesThemIsNoCandidate) {
    CutEvaluation evaluation = two_halves(100, 100);
    evaluation.solids.push_back({4, 0.001, true, {}});
    Objectives objectives;
    objectives.fragment_volume_mm3 = 0.01;
    const auto t = terms(evaluation, {}, objectives);
    EXPECT_EQ(t->piece_count, 0);
    EXPECT_EQ(t->face_ratio, 0);
    evaluation.solids[1].volume_mm3 = 0.001;
    EXPECT_FALSE(terms(evaluation, {}, objectives).has_value());
}

TEST(Objectives, TheTotalIsTheWeightedSum) {
    CutEvaluation evaluation = two_halves(100, 300);
    evaluation.fragility = 0.7;
    evaluation.solids.push_back({100, 5, true, {}});
    const auto t = terms(evaluation, {}, {});
    EXPECT_DOUBLE_EQ(t->total, 10 * t->face_ratio + 5 * 0.7 + 50 * 1 + 10 * t->undercut);
}

}  // namespace
}  // namespace qchopper
