#include "segment/search/trial.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <map>
#include <set>
#include <utility>

#include "segment/mesh/measure.h"
#include "segment/search/search.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

SearchSettings settings_of(std::size_t beam = 1) {
    SearchSettings settings;
    settings.candidates.offsets_per_normal = 3;
    settings.stop.max_unreachable = 0.02;
    settings.stop.max_cuts = 20;
    settings.beam = beam;
    return settings;
}

struct Found {
    Segmentation segmentation;
    SearchEnd end;
    std::vector<std::size_t> reported;  // cuts after every round
    std::size_t evaluated = 0;
};

Found searched(const TriangleMesh& mesh, const SearchSettings& settings, const PieceChecks& checks) {
    Found found{uncut(mesh, 0), {}, {}, 0};
    EvaluationCache cache(settings.objectives, settings.candidates);
    const auto on_round = [&](const Segmentation& s) { found.reported.push_back(s.cuts.size()); };
    found.end = search(found.segmentation, settings, cache, checks, on_round, {});
    found.evaluated = cache.evaluated_count();
    return found;
}

constexpr UnreachableSurface none{0, 0};
constexpr UnreachableSurface too_much(double mm2) {
    return {mm2, 0.074};
}

// What is out of reach by the number of cuts that bound a piece; by more cuts nothing.
UnreachableOf by_cuts(std::vector<UnreachableSurface> values) {
    return [values = std::move(values)](const Piece& p) {
        return p.half_spaces.size() < values.size() ? values[p.half_spaces.size()] : none;
    };
}

// Every cut leaves as much out of reach as there was.
UnreachableOf halved(double mm2) {
    return [mm2](const Piece& p) { return too_much(mm2 / static_cast<double>(1 << p.half_spaces.size())); };
}

// Its area is 2,000,000 mm2, less what its few triangles lose: 0.2 % are about 4,000 mm2.
const TriangleMesh& ball() {
    static const TriangleMesh mesh = shapes::ball({0, 0, 0}, 400, 8);
    return mesh;
}

// A has more faces and is tried first.
const TriangleMesh& two_balls() {
    static const TriangleMesh mesh =
        shapes::joined({shapes::ball({0, 0, 0}, 400, 10), shapes::ball({2000, 0, 0}, 400, 8)});
    return mesh;
}

bool is_of_a(const Piece& piece) {
    return bounds(*piece.mesh).centre().x < 1000;
}

// A cannot be made better; B is, by one cut.
UnreachableSurface only_b_gains(const Piece& piece) {
    return is_of_a(piece) ? halved(100'000)(piece) : by_cuts({too_much(100'000)})(piece);
}

TEST(Trial, EndsWithTheFirstCutThatGainsEnough) {
    for (const std::size_t beam : {1U, 2U}) {
        const Found one = searched(ball(), settings_of(beam), {{}, by_cuts({too_much(100'000)})});
        EXPECT_EQ(one.end.reason, EndReason::rules_hold) << one.end.sentence;
        EXPECT_EQ(one.reported, (std::vector<std::size_t>{1}));
        // After two cuts 48,000 + 0 + 0; the piece that is left has a trial of its own.
        const Found two = searched(ball(), settings_of(beam), {{}, by_cuts({too_much(100'000), too_much(48'000)})});
        EXPECT_EQ(two.end.reason, EndReason::rules_hold) << two.end.sentence;
        EXPECT_EQ(two.reported, (std::vector<std::size_t>{2, 3}));
        // 100,000; 50,000 + 2 x 22,000; 4 x 22,000, for the largest one is cut next.
        const Found three =
            searched(ball(), settings_of(beam), {{}, by_cuts({too_much(100'000), too_much(50'000), too_much(22'000)})});
        EXPECT_EQ(three.end.reason, EndReason::rules_hold) << three.end.sentence;
        EXPECT_EQ(three.reported, (std::vector<std::size_t>{3, 4, 5, 6, 7}));
    }
}

TEST(Trial, NeedsATenthOfWhatIsOutOfReachAndTwoThousandthsOfThePiece) {
    const double area = area_mm2(ball());
    const auto is_better = [&](double before, double after) {
        const UnreachableOf reach =
            by_cuts({too_much(before), too_much(after / 2), too_much(after / 4), too_much(after / 8)});
        return !searched(ball(), settings_of(), {{}, reach}).reported.empty();
    };
    EXPECT_TRUE(is_better(100'000, 89'999));
    EXPECT_FALSE(is_better(100'000, 90'001));
    EXPECT_TRUE(is_better(10'000, 9'999 - 0.002 * area));
    EXPECT_FALSE(is_better(10'000, 10'001 - 0.002 * area)) << "a third of it is too little of this piece";
}

// The edges of a mesh with one cap that only one of its triangles has.
double outline_of_cap(const TriangleMesh& mesh) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        if (cap_of(mesh, t) == no_cap) continue;
        for (std::size_t k = 0; k < 3; ++k) {
            ++edges[std::minmax(mesh.triangles[t][k], mesh.triangles[t][(k + 1) % 3])];
        }
    }
    double length = 0;
    for (const auto& [edge, count] : edges) {
        if (count == 1) length += norm(mesh.points[edge.first] - mesh.points[edge.second]);
    }
    return length;
}

TEST(Trial, NeedsAsMuchAsAStripAlongItsJoints) {
    const auto searched_with = [](double seam_width_mm, const UnreachableOf& reach) {
        PieceChecks checks{{}, reach};
        checks.seam_width_mm = seam_width_mm;
        return searched(ball(), settings_of(), checks).segmentation;
    };
    // 100,000 mm2 before; 88,000 after any number of cuts, so that more joints are no remedy.
    const UnreachableOf better = by_cuts({too_much(100'000), too_much(44'000), too_much(22'000), too_much(11'000)});
    const UnreachableOf held = by_cuts({too_much(100'000)});
    const Segmentation cut = searched_with(0, held);
    ASSERT_EQ(cut.cuts.size(), 1U);
    const double seam = outline_of_cap(*cut.pieces[0].mesh);
    ASSERT_NEAR(seam, outline_of_cap(*cut.pieces[1].mesh), 1e-6 * seam);
    EXPECT_GT(searched_with(0.999 * 12'000 / seam, better).cuts.size(), 0U);
    EXPECT_EQ(searched_with(1.001 * 12'000 / seam, better).cuts.size(), 0U);
    EXPECT_EQ(searched_with(1000 * 12'000 / seam, held).cuts.size(), 1U) << "every piece holds the rules then";
}

// So many balls in a row. Of the first one, which has most faces, 2,000 mm2 are out of reach, too little for a joint to
// be worth it, and of the others `others_mm2`; of pieces of a cut ball nothing.
Found balls_searched(int count, double others_mm2) {
    std::vector<TriangleMesh> balls;
    for (int k = 0; k < count; ++k) balls.push_back(shapes::ball({1000.0 * k, 0, 0}, 400, k == 0 ? 12 : 8));
    const auto reach = [=](const Piece& p) {
        if (!p.half_spaces.empty()) return none;
        return too_much(bounds(*p.mesh).centre().x < 500 ? 2'000 : others_mm2);
    };
    return searched(shapes::joined(balls), settings_of(), {{}, reach});
}

TEST(Trial, ThatMakesTheLastPiecesHoldIsWorthItWhateverItGains) {
    const Found found = balls_searched(3, 2'000);
    EXPECT_EQ(found.segmentation.cuts.size(), 3U);
    EXPECT_EQ(found.end.reason, EndReason::rules_hold);
}

TEST(Trial, ThatGainsLittleIsNotWorthItWhereManyPiecesBreakTheRule) {
    const Found found = balls_searched(4, 2'000);
    EXPECT_EQ(found.segmentation.cuts.size(), 0U);
    EXPECT_EQ(found.end.reason, EndReason::passed_over);
    ASSERT_EQ(found.end.reverted.size(), 4U);
    for (const RevertedTrial& trial : found.end.reverted) EXPECT_TRUE(trial.holds);
    EXPECT_NE(found.end.sentence.find("one cut changed that from 20.0 to 0.0 cm2, less than its joints take by hand"),
              std::string::npos)
        << found.end.sentence;
}

TEST(Trial, ThatGainsLittleIsTakenUpAgainWhenFewPiecesBreakTheRule) {
    const Found found = balls_searched(5, 100'000);
    EXPECT_EQ(found.segmentation.cuts.size(), 5U);
    EXPECT_EQ(found.segmentation.cuts.back().piece, "A") << "the first ball";
    EXPECT_EQ(found.end.reason, EndReason::rules_hold);
    EXPECT_TRUE(found.end.reverted.empty());
}

// A hundredth of the scan's surface, 6 % of it out of reach: little of the scan, and no little of the piece.
TEST(Trial, OfASmallSolidDoesNotDependOnTheScanAroundIt) {
    const TriangleMesh small = shapes::ball({2000, 0, 0}, 40, 8);
    const TriangleMesh both = shapes::joined({shapes::ball({0, 0, 0}, 400, 8), small});
    const double before = 0.06 * area_mm2(small);
    ASSERT_LT(before, 0.002 * area_mm2(both));
    const UnreachableOf reach = [&](const Piece& p) {
        constexpr double tenth = 0.1;
        const UnreachableSurface left{tenth * before, 0.03};
        return is_of_a(p) ? none : by_cuts({{before, 0.06}, left, left, left})(p);
    };
    const auto cuts_with = [&](double min_gain_mm2) {
        PieceChecks checks{{}, reach};
        checks.min_gain_mm2 = min_gain_mm2;
        return searched(both, settings_of(), checks).segmentation.cuts.size();
    };
    EXPECT_EQ(cuts_with(0), 1U);
    EXPECT_EQ(cuts_with(0.79 * before), 1U);
    EXPECT_EQ(cuts_with(0.81 * before), 0U) << "no more than the finest tool can tell from nothing";
}

TEST(Trial, ThatGainsNothingIsRevertedAndThePieceIsPassedOver) {
    for (const std::size_t beam : {1U, 2U}) {
        const Segmentation before = uncut(ball(), 0);
        const Found found = searched(ball(), settings_of(beam), {{}, halved(100'000)});
        EXPECT_EQ(found.end.reason, EndReason::passed_over);
        EXPECT_FALSE(found.end.is_finished());
        EXPECT_TRUE(found.reported.empty());
        EXPECT_EQ(found.segmentation.names_given, before.names_given);
        ASSERT_EQ(found.segmentation.pieces.size(), 1U);
        EXPECT_EQ(*found.segmentation.pieces[0].mesh, *before.pieces[0].mesh);
        EXPECT_EQ(found.end.sentence,
                  "every unfinished piece is passed over: piece A: 7.4 % of its surface is out of reach (2 % may be), "
                  "three cuts changed that from 1000.0 to 1000.0 cm2");
    }
}

TEST(Trial, ThatFailsLeavesTheOtherPiecesToBeCut) {
    for (const std::size_t beam : {1U, 2U}) {
        const Found found = searched(two_balls(), settings_of(beam), {{}, only_b_gains});
        EXPECT_EQ(found.end.reason, EndReason::passed_over);
        ASSERT_EQ(found.segmentation.cuts.size(), 1U);
        EXPECT_EQ(found.segmentation.cuts[0].piece, "B");
        EXPECT_EQ(found.segmentation.cuts[0].pieces, (std::vector<std::string>{"C", "D"})) << "no name is lost";
        EXPECT_NE(found.end.sentence.find("piece A"), std::string::npos);
        EXPECT_EQ(found.end.sentence.find("piece C"), std::string::npos) << found.end.sentence;
        EXPECT_EQ(found.reported, (std::vector<std::size_t>{1})) << "nothing within a trial is reported";
    }
}

TEST(Trial, WhereEveryPieceIsPassedOverEachIsNamed) {
    const Found found = searched(two_balls(), settings_of(),
                                 {{}, [](const Piece& p) { return is_of_a(p) ? halved(100'000)(p) : too_much(100); }});
    EXPECT_EQ(found.end.reason, EndReason::passed_over);
    for (const char* piece : {"A", "B"}) {
        const std::string named = std::string("piece ") + piece + ": 7.4 % of its surface is out of reach (2 % may be)";
        EXPECT_NE(found.end.sentence.find(named + ", three cuts changed that"), std::string::npos)
            << found.end.sentence;
    }
    EXPECT_TRUE(found.segmentation.cuts.empty());
}

// A piece that breaks the rule is no job: what makes all pieces hold it counts from a quarter of the floor on.
TEST(Trial, IsKeptWhereEveryPieceHoldsTheRuleThen) {
    for (const std::size_t beam : {1U, 2U}) {
        PieceChecks checks{{}, by_cuts({too_much(3000)})};
        checks.min_gain_mm2 = 4 * 2999;
        const Found one = searched(ball(), settings_of(beam), checks);
        EXPECT_EQ(one.end.reason, EndReason::rules_hold) << one.end.sentence;
        EXPECT_EQ(one.reported, (std::vector<std::size_t>{1}));
        checks.min_gain_mm2 = 4 * 3001;
        const Found too_little = searched(ball(), settings_of(beam), checks);
        EXPECT_TRUE(too_little.end.sentence.ends_with("(2 % may be), too little for a cut to count"))
            << too_little.end.sentence;
        EXPECT_EQ(too_little.evaluated, 0U) << "no cut is tried";
        const Found not_all = searched(ball(), settings_of(beam), {{}, halved(3000)});
        EXPECT_EQ(not_all.end.reason, EndReason::passed_over);
        EXPECT_TRUE(not_all.segmentation.cuts.empty());
    }
}

TEST(Trial, OfAPieceThatNoPlanePartsSaysSo) {
    for (const std::size_t beam : {1U, 2U}) {
        SearchSettings settings = settings_of(beam);
        settings.candidates.offsets_per_normal = 0;
        const Found found = searched(ball(), settings, {{}, halved(100'000)});
        EXPECT_EQ(found.end.reason, EndReason::passed_over);
        EXPECT_TRUE(found.end.sentence.ends_with("(2 % may be), no plane parts it")) << found.end.sentence;
    }
}

TEST(Trial, NeverExceedsTheSafetyStop) {
    const PieceChecks checks{{}, by_cuts({too_much(100'000), too_much(48'000)})};
    for (const std::size_t beam : {1U, 2U}) {
        SearchSettings settings = settings_of(beam);
        settings.stop.max_cuts = 1;  // the trial needs two
        const Found one = searched(ball(), settings, checks);
        EXPECT_EQ(one.end.reason, EndReason::max_cuts);
        EXPECT_TRUE(one.segmentation.cuts.empty());
        EXPECT_EQ(one.end.sentence,
                  "the safety stop of 1 cuts is reached; piece A: 7.4 % of its surface is out of reach (2 % may be), "
                  "one cut changed that from 1000.0 to 960.0 cm2");
        settings.stop.max_cuts = 2;
        const Found two = searched(ball(), settings, checks);
        EXPECT_EQ(two.end.reason, EndReason::max_cuts);
        EXPECT_EQ(two.segmentation.cuts.size(), 2U);
        EXPECT_EQ(two.end.sentence, "the safety stop of 2 cuts is reached");
    }
}

TEST(Trial, IsOnlyOfPiecesThatBreakNoOtherRule) {
    SearchSettings settings = settings_of();
    settings.stop.max_faces = ball().triangles.size();  // broken by the scan alone
    const Found found = searched(ball(), settings, {{}, halved(100'000)});
    EXPECT_EQ(found.reported, (std::vector<std::size_t>{1})) << "this cut is not judged";
    EXPECT_EQ(found.end.reason, EndReason::passed_over);
    settings.stop.combine = Stop::any;
    const Found any = searched(ball(), settings, {{}, halved(100'000)});
    EXPECT_EQ(any.end.reason, EndReason::rules_hold);
    EXPECT_EQ(any.reported, (std::vector<std::size_t>{1}));
    const Found reached = searched(ball(), settings, {{}, by_cuts({})});
    EXPECT_EQ(reached.end.reason, EndReason::rules_hold);
    EXPECT_TRUE(reached.reported.empty()) << "one rule holds at once";
}

TEST(Trial, WaitsUntilAsManyCutsAreMadeAsAreAskedFor) {
    SearchSettings settings = settings_of();
    settings.stop.min_cuts = 2;
    const Found found = searched(ball(), settings, {{}, halved(100'000)});
    EXPECT_EQ(found.segmentation.cuts.size(), 2U);
    EXPECT_EQ(found.end.reason, EndReason::passed_over);
}

TEST(Trial, OfAWiderBeamBeginsWithOtherCutsToo) {
    const SearchSettings greedy = settings_of();
    EvaluationCache cache(greedy.objectives, greedy.candidates);
    const Segmentation start = uncut(ball(), 0);
    const Plane best = rank(start, 0, greedy, cache, {}).front().plane;
    const PieceChecks checks{{}, [best](const Piece& p) {
                                 const bool is_bad = p.half_spaces.empty() || p.half_spaces[0].plane == best;
                                 return is_bad ? halved(100'000)(p) : none;
                             }};
    EXPECT_EQ(searched(ball(), greedy, checks).end.reason, EndReason::passed_over);
    const Found wide = searched(ball(), settings_of(2), checks);
    EXPECT_EQ(wide.end.reason, EndReason::rules_hold);
    ASSERT_EQ(wide.segmentation.cuts.size(), 1U);
    EXPECT_NE(wide.segmentation.cuts[0].chosen.plane, best);
}

TEST(Trial, ThatIsCancelledLeavesWhatWasBeforeIt) {
    for (const std::size_t beam : {1U, 2U}) {
        const SearchSettings settings = settings_of(beam);
        EvaluationCache cache(settings.objectives, settings.candidates);
        Segmentation segmentation = uncut(ball(), 0);
        std::atomic<bool> stop{false};
        Context context;
        context.cancelled = &stop;
        const UnreachableOf reach = [&](const Piece& p) {
            stop = !p.half_spaces.empty();
            return halved(100'000)(p);
        };
        EXPECT_THROW(search(
                         segmentation, settings, cache, {{}, reach}, [](const Segmentation&) {}, context),
                     Cancelled);
        EXPECT_TRUE(segmentation.cuts.empty());
        EXPECT_EQ(segmentation.pieces.size(), 1U);
    }
}

// A trial is one decision: a time limit that passes in it ends the search after it. What was passed over stays so, and
// is not tried again.
TEST(Trial, OfASearchThatGoesOnIsNotMadeAgain) {
    for (const std::size_t beam : {1U, 2U}) {
        const SearchSettings settings = settings_of(beam);
        const Found whole = searched(two_balls(), settings, {{}, only_b_gains});
        Segmentation segmentation = uncut(two_balls(), 0);
        BeamProgress progress;
        progress.root = segmentation;
        SearchEnd end;
        std::vector<std::size_t> trials_of_a;
        do {
            EvaluationCache cache(settings.objectives, settings.candidates);
            std::set<const TriangleMesh*> asked;
            const UnreachableOf reach = [&](const Piece& p) {
                if (is_of_a(p) && !p.half_spaces.empty()) asked.insert(p.mesh.get());
                return only_b_gains(p);
            };
            end = search(
                segmentation, settings, cache, {{}, reach}, [](const Segmentation&) {}, {}, TimeLimit{1e-9}, &progress);
            if (beam == 1) progress.root = segmentation;
            trials_of_a.push_back(asked.size());
        } while (end.is_out_of_time() && trials_of_a.size() < 9);
        EXPECT_EQ(end.sentence, whole.end.sentence);
        EXPECT_EQ(segmentation.cuts, whole.segmentation.cuts);
        ASSERT_GE(trials_of_a.size(), 2U);
        EXPECT_GE(trials_of_a.front(), 6U);
        for (std::size_t i = 1; i < trials_of_a.size(); ++i) EXPECT_EQ(trials_of_a[i], 0U) << i;
    }
}

TEST(Trial, WithoutAFunctionTheRuleIsLeftOut) {
    const Found found = searched(ball(), settings_of(), {});
    EXPECT_EQ(found.end.reason, EndReason::rules_hold);
    EXPECT_TRUE(found.reported.empty());
}

}  // namespace
}  // namespace qchopper
