#include "segment/search/stop_rules.h"

#include <gtest/gtest.h>

#include "segment/mesh/oriented_box.h"
#include "tests/segment/search/next_piece.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

Segmentation two_boxes() {
    return uncut(shapes::joined({shapes::box({0, 0, 0}, {10, 10, 10}, 2), shapes::box({20, 0, 0}, {50, 20, 10}, 4)}),
                 0);
}

TEST(StopRules, EachRuleNamesThePieceThatBreaksIt) {
    const Segmentation s = two_boxes();  // A: 48 faces, B: 192 faces
    StopRules rules;
    rules.max_faces = 100;
    EXPECT_EQ(next_piece(s, rules, {}, {}).piece, 1U);
    rules.max_faces = 193;
    EXPECT_TRUE(next_piece(s, rules, {}, {}).is_finished);
    rules.max_faces = 192;  // fewer than
    EXPECT_FALSE(next_piece(s, rules, {}, {}).is_finished);
    rules = {};
    rules.max_obb = Vec3{11, 31, 21};
    EXPECT_TRUE(next_piece(s, rules, {}, {}).is_finished);
    rules.max_obb = Vec3{11, 29, 21};
    EXPECT_EQ(next_piece(s, rules, {}, {}).piece, 1U);
    rules = {};
    rules.fits_cell = true;
    EXPECT_EQ(next_piece(s, rules, {[](const Piece& p) { return p.name == "B"; }, {}}, {}).piece, 0U);
    rules = {};
    rules.min_cuts = 1;
    EXPECT_EQ(next_piece(s, rules, {}, {}).piece, 1U);
}

TEST(StopRules, SeveralPiecesThatAreNewAreWorkedOutTogether) {
    const Segmentation s = two_boxes();
    StopRules rules;
    rules.fits_cell = true;
    rules.max_unreachable = 0.1;
    PieceChecks checks;
    checks.fits_cell = [](const Piece& p) { return p.name == "A"; };
    checks.unreachable = [](const Piece&) { return UnreachableSurface{5, 0.05, 0}; };
    std::vector<std::vector<std::string>> calls;
    checks.work_out = [&](std::span<const Piece> pieces, const AskedOfPieces& asked) {
        EXPECT_TRUE(asked.fits_cell && asked.unreachable);
        EXPECT_FALSE(asked.is_machinable) << "asked where a priority is given only";
        calls.emplace_back();
        for (const Piece& piece : pieces) calls.back().push_back(piece.name);
    };
    StopJudge judge(rules, checks, {});
    EXPECT_EQ(judge.next(s, {}).piece, 1U);
    EXPECT_EQ(judge.next(s, {}).piece, 1U) << "known pieces are not worked out again";
    EXPECT_EQ(calls, (std::vector<std::vector<std::string>>{{"A", "B"}}));
    calls.clear();
    rules.max_faces = 5;  // breaks first: the cell might not be asked
    EXPECT_TRUE(StopJudge(rules, checks, {}).next(s, {}).piece);
    EXPECT_TRUE(calls.empty());
}

TEST(StopRules, AnyStopsAtTheFirstRuleThatHoldsAllWaitsForEach) {
    const Segmentation s = two_boxes();
    StopRules rules;
    rules.max_faces = 1000;
    rules.min_cuts = 1;
    EXPECT_FALSE(next_piece(s, rules, {}, {}).is_finished);
    rules.combine = Stop::any;
    EXPECT_TRUE(next_piece(s, rules, {}, {}).is_finished);
    rules.max_faces = 10;
    EXPECT_FALSE(next_piece(s, rules, {}, {}).is_finished);
}

TEST(StopRules, NoRuleIsFinishedAtOnceAndTheSafetyStopNamesNoPiece) {
    Segmentation s = two_boxes();
    EXPECT_TRUE(next_piece(s, {}, {}, {}).is_finished);
    StopRules rules;
    rules.max_faces = 10;
    rules.max_cuts = 0;
    const NextPiece next = next_piece(s, rules, {}, {});
    EXPECT_FALSE(next.is_finished);
    EXPECT_FALSE(next.piece);
}

TEST(StopRules, APieceWithoutCandidatesIsPassedOver) {
    const Segmentation s = two_boxes();
    StopRules rules;
    rules.max_faces = 10;
    EXPECT_EQ(next_piece(s, rules, {}, {"B"}).piece, 0U);
    EXPECT_FALSE(next_piece(s, rules, {}, {"A", "B"}).piece);
}

TEST(StopRules, AJudgeChecksEveryPieceOnce) {
    Segmentation s = two_boxes();
    StopRules rules;
    rules.max_obb = Vec3{11, 29, 21};
    rules.fits_cell = true;
    int boxes = 0;
    int checks = 0;
    StopJudge judge(rules,
                    {[&](const Piece&) {
                         ++checks;
                         return true;
                     },
                     {}},
                    [&](const Piece& p) {
                        ++boxes;
                        return oriented_box(p.mesh->points).size();
                    });
    for (int again = 0; again < 3; ++again) EXPECT_EQ(judge.next(s, {}).piece, 1U);
    EXPECT_EQ(boxes, 2);
    EXPECT_EQ(checks, 2);
    Cut cut;
    cut.piece = "B";
    cut.chosen.plane = {{1, 0, 0}, 33.3};
    ASSERT_TRUE(apply(s, cut, 0));
    EXPECT_TRUE(judge.next(s, {}).is_finished);
    EXPECT_EQ(boxes, 4) << "only the new pieces are checked";
}

TEST(StopRules, WhatArmAndToolsCannotMillIsCutForLowBlocksWherePiecesAreCutForSize) {
    const Segmentation s = two_boxes();
    StopRules rules;
    rules.fits_cell = true;
    std::string asked;
    PieceChecks checks;
    checks.fits_cell = [](const Piece& p) { return p.name == "A"; };
    checks.blocks_needed = [](Vec3) { return 2.0; };
    checks.is_machinable = [&](const Piece& p) {
        asked += p.name;
        return false;
    };
    checks.low_blocks_needed = [](Vec3) { return 3.0; };
    const auto size = [](const Piece&) { return Vec3{}; };
    StopJudge by_size(rules, checks, size, [](const Piece&) { return 1.0; });
    EXPECT_FALSE(by_size.next(s, {}).is_finished);
    EXPECT_EQ(asked, "A") << "B does not even fit";
    EXPECT_EQ(by_size.too_large_for(s.pieces[0])({}), 3);
    EXPECT_EQ(by_size.too_large_for(s.pieces[1])({}), 2);
    EXPECT_NE(by_size.why(s.pieces[0]), by_size.why(s.pieces[1]));
    rules.combine = Stop::any;
    StopJudge any(rules, checks, size, [](const Piece&) { return 1.0; });
    EXPECT_FALSE(any.next(s, {}).is_finished);
    StopJudge by_faces(rules, checks, size);
    EXPECT_TRUE(by_faces.why(s.pieces[0]).empty()) << "the presets of the thesis cut as before";
}

TEST(StopRules, WhatIsOutOfReachIsAskedOncePerPieceAndOnlyWhereItDecides) {
    const Segmentation s = two_boxes();  // A: 48 faces, B: 192 faces
    StopRules rules;
    rules.max_faces = 100;
    rules.max_unreachable = 0.02;
    std::string asked;
    const PieceChecks checks{{}, [&](const Piece& p) {
                                 asked += p.name;
                                 return UnreachableSurface{5, p.name == "A" ? 0.020001 : 0.02};
                             }};
    StopJudge judge(rules, checks, [](const Piece&) { return Vec3{}; });
    EXPECT_EQ(judge.next(s, {}).piece, 1U);
    EXPECT_FALSE(judge.next(s, {}).is_trial) << "B breaks another rule";
    EXPECT_EQ(asked, "A");
    EXPECT_EQ(judge.next(s, {"B"}).piece, 0U);
    EXPECT_TRUE(judge.next(s, {"B"}).is_trial);
    EXPECT_EQ(judge.why(s.pieces[0]), "2.0001 % of its surface is out of reach (2 % may be)");
    EXPECT_EQ(judge.why(s.pieces[1]), "192 faces (fewer than 100 are wanted)");
    rules.combine = Stop::any;
    asked.clear();
    const NextPiece next = next_piece(s, rules, checks, {});
    EXPECT_EQ(asked, "AB");
    EXPECT_FALSE(next.is_finished);
    rules.max_unreachable = 0.03;
    EXPECT_TRUE(next_piece(s, rules, checks, {}).is_finished) << "no piece breaks that rule";
    rules.max_faces.reset();
    rules.max_unreachable = 0.02;
    EXPECT_EQ(next_piece(s, rules, checks, {}).piece, 0U);
}

TEST(StopRules, ALargeShareOfSoLittleSurfaceAsMayStayBreaksNoRule) {
    const Segmentation s = two_boxes();
    StopRules rules;
    rules.max_unreachable = 0.02;
    const auto next = [&](double mm2, double share) {
        const PieceChecks checks{{}, [&](const Piece& p) {
                                     return p.name == "A" ? UnreachableSurface{mm2, share, 576} : UnreachableSurface{};
                                 }};
        return next_piece(s, rules, checks, {});
    };
    EXPECT_TRUE(next(576, 0.3).is_finished);
    EXPECT_EQ(next(577, 0.3).piece, 0U);
    EXPECT_TRUE(next(577, 0.02).is_finished) << "a small share of a large piece";
}

TEST(StopRules, ThosePiecesWaitThatWillBeCutTheNextOneFirst) {
    const Segmentation s = two_boxes();
    StopRules rules;
    rules.max_faces = 10;
    EXPECT_EQ(next_piece(s, rules, {}, {}).waiting, (std::vector<std::size_t>{1, 0}));
    EXPECT_EQ(next_piece(s, rules, {}, {"B"}).waiting, (std::vector<std::size_t>{0}));
    rules = {};
    rules.min_cuts = 1;
    EXPECT_EQ(next_piece(s, rules, {}, {}).waiting, (std::vector<std::size_t>{1})) << "one cut is missing, not two";
}

TEST(StopRules, ABoxFitsInSomeAxisOrder) {
    EXPECT_TRUE(fits_in({1, 2, 3}, {3, 1, 2}));
    EXPECT_FALSE(fits_in({1, 2, 3.1}, {3, 2, 2}));
}

}  // namespace
}  // namespace qchopper
