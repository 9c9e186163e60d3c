#include "segment/search/beam.h"

#include <gtest/gtest.h>

#include <limits>

#include "segment/mesh/measure.h"
#include "tests/segment/search/greedy.h"
#include "tests/segment/search/next_piece.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

SearchSettings settings_of(int cuts, std::size_t beam, int offsets = 5) {
    SearchSettings settings;
    settings.candidates.offsets_per_normal = offsets;
    settings.stop.min_cuts = cuts;
    settings.beam = beam;
    return settings;
}

struct Found {
    Segmentation segmentation;
    SearchEnd end;
};

Found searched(const TriangleMesh& mesh, const SearchSettings& settings) {
    Found found{uncut(mesh, settings.objectives.fragment_volume_mm3), {}};
    EvaluationCache cache(settings.objectives, settings.candidates);
    found.end = search(found.segmentation, settings, cache, {}, [](const Segmentation&) {}, {});
    return found;
}

double cost_of(const Segmentation& segmentation, const SearchSettings& settings) {
    EvaluationCache cache(settings.objectives, settings.candidates);
    return cost(segmentation, settings.objectives, cache);
}

TEST(Beam, OfOneIsTheGreedySearchOnEveryShape) {
    for (const auto& [name, mesh, count] : shapes::all_closed()) {
        const SearchSettings settings = settings_of(4, 1, 7);
        Segmentation greedy = uncut(mesh, 0);
        const bool is_finished = greedy::search(greedy, settings);
        const Found beam = searched(mesh, settings);
        EXPECT_EQ(beam.end.is_finished(), is_finished) << name;
        ASSERT_EQ(beam.segmentation.cuts.size(), greedy.cuts.size()) << name;
        for (std::size_t i = 0; i < greedy.cuts.size(); ++i) {
            EXPECT_TRUE(beam.segmentation.cuts[i] == greedy.cuts[i]) << name << " cut " << i + 1;
        }
    }
}

TEST(Beam, OfOneIsTheGreedySearchWithLimitsOnFaces) {
    SearchSettings settings = settings_of(0, 1, 7);
    settings.stop.min_cuts.reset();
    settings.stop.max_faces = 300;
    settings.stop.max_cuts = 12;
    for (const TriangleMesh& mesh : {shapes::linked_tori(), shapes::nested(), shapes::ball({1, 2, 3}, 20, 16)}) {
        Segmentation greedy = uncut(mesh, 0);
        greedy::search(greedy, settings);
        EXPECT_TRUE(searched(mesh, settings).segmentation.cuts == greedy.cuts);
        EXPECT_FALSE(greedy.cuts.empty());
    }
}

TEST(Beam, OfAnyWidthFindsTheGreedyCutIfOneIsAskedFor) {
    for (const auto& [name, mesh, count] : shapes::all_closed()) {
        const std::vector<Cut> greedy = searched(mesh, settings_of(1, 1)).segmentation.cuts;
        for (const std::size_t width : {2U, 3U, 8U}) {
            EXPECT_TRUE(searched(mesh, settings_of(1, width)).segmentation.cuts == greedy) << name << " " << width;
        }
    }
}

// Every pair of cuts that the search could make, made. Least cost of all.
double min_of_all_pairs(const TriangleMesh& mesh, const SearchSettings& settings) {
    const Segmentation start = uncut(mesh, 0);
    EvaluationCache cache(settings.objectives, settings.candidates);
    double least = std::numeric_limits<double>::infinity();
    const std::size_t first = *next_piece(start, settings.stop, {}, {}).piece;
    const std::vector<Ranked> firsts = rank(start, first, settings, cache, {});
    for (std::size_t i = 0; i < firsts.size(); ++i) {
        Segmentation one = start;
        EXPECT_TRUE(apply(one, cut_by(one, first, firsts, i, settings), 0));
        const std::size_t second = *next_piece(one, settings.stop, {}, {}).piece;
        const std::vector<Ranked> seconds = rank(one, second, settings, cache, {});
        for (std::size_t j = 0; j < seconds.size(); ++j) {
            Segmentation two = one;
            EXPECT_TRUE(apply(two, cut_by(two, second, seconds, j, settings), 0));
            least = std::min(least, cost_of(two, settings));
        }
    }
    return least;
}

// This holds by construction: a beam that keeps all children of the first round compares every pair of cuts that it
// could make, so it finds the cheapest two cuts, and no narrower beam ends cheaper.
TEST(Beam, AsWideAsAllCandidatesFindsTheCheapestTwoCuts) {
    for (const TriangleMesh& mesh : {shapes::linked_tori(), shapes::stairs(), shapes::nested(),
                                     shapes::rotated(shapes::torus({0, 0, 0}, 40, 12, 12), {1, 2, 3}, 0.5)}) {
        SearchSettings wide = settings_of(2, 9, 3);
        wide.near = 0;
        const double least = min_of_all_pairs(mesh, wide);
        const Found widest = searched(mesh, wide);
        EXPECT_NEAR(widest.end.cost, least, 1e-7);
        for (const std::size_t width : {1U, 2U, 4U}) {
            SearchSettings narrow = wide;
            narrow.beam = width;
            EXPECT_LE(widest.end.cost, searched(mesh, narrow).end.cost + 1e-7) << width;
        }
    }
}

TEST(Beam, CostOfTheEvaluationsIsTheCostOfTheRealPieces) {
    for (const std::size_t width : {1U, 3U}) {
        const SearchSettings settings = settings_of(3, width);
        const Found found = searched(shapes::linked_tori(), settings);
        EXPECT_NEAR(found.end.cost, cost_of(found.segmentation, settings), 1e-9);
        double of_cuts = 0;
        for (const Cut& cut : found.segmentation.cuts) {
            of_cuts += 5 * cut.chosen.terms.fragility + 50 * cut.chosen.terms.piece_count;
        }
        const Terms& last = found.segmentation.cuts.back().chosen.terms;
        EXPECT_NEAR(found.end.cost, of_cuts + 10 * last.face_ratio + 10 * last.undercut, 1e-7);
    }
}

TEST(Beam, IsTheSameTwice) {
    const TriangleMesh mesh = shapes::linked_tori();
    EXPECT_TRUE(searched(mesh, settings_of(3, 4)).segmentation.cuts ==
                searched(mesh, settings_of(3, 4)).segmentation.cuts);
}

TEST(Beam, CullsTheWorseOfTwoNearPlanesOfOneNormal) {
    const auto at = [](int normal_index, int offset_index) {
        Ranked r;
        r.normal_index = normal_index;
        r.offset_index = offset_index;
        return r;
    };
    const std::vector<Ranked> ranked{at(0, 20), at(0, 22), at(1, 21), at(0, 23), at(0, 17), at(1, 22)};
    // 0.06 of the extent are 2.46 steps of 41.
    EXPECT_EQ(without_near_duplicates(ranked, 40, 0.06), (std::vector<std::size_t>{0, 2, 3, 4}));
    EXPECT_EQ(without_near_duplicates(ranked, 40, 0).size(), ranked.size());
}

TEST(Beam, ReportsTheBestOfEveryRoundAndEndsInAReportedOne) {
    const TriangleMesh mesh = shapes::linked_tori();
    const SearchSettings settings = settings_of(4, 5);
    Segmentation segmentation = uncut(mesh, 0);
    EvaluationCache cache(settings.objectives, settings.candidates);
    std::vector<std::size_t> reported;
    search(segmentation, settings, cache, {}, [&](const Segmentation& s) { reported.push_back(s.cuts.size()); }, {});
    EXPECT_EQ(reported, (std::vector<std::size_t>{1, 2, 3, 4}));
    EXPECT_EQ(segmentation.cuts.size(), 4U);
}

TEST(Beam, WhatIsStoppedForTimeEndsWithTheDecisionBeingMade) {
    const TriangleMesh mesh = shapes::linked_tori();
    for (const std::size_t width : {1U, 3U}) {
        const SearchSettings settings = settings_of(400, width);
        Segmentation segmentation = uncut(mesh, 0);
        EvaluationCache cache(settings.objectives, settings.candidates);
        std::size_t reported = 0;
        const SearchEnd end = search(
            segmentation, settings, cache, {}, [&](const Segmentation&) { ++reported; }, {}, TimeLimit{1e-9});
        EXPECT_TRUE(end.is_out_of_time());
        EXPECT_FALSE(end.is_finished());
        EXPECT_EQ(reported, 1U);
        EXPECT_EQ(segmentation.cuts.size(), 1U);
        EXPECT_EQ(end.reason, EndReason::time_limit);
        EXPECT_NE(end.sentence.find("time limit"), std::string::npos);
    }
}

TEST(Beam, ThatIsFinishedWhenItsTimeEndsReportsThatItIsFinished) {
    const SearchSettings settings = settings_of(1, 1);
    Segmentation segmentation = uncut(shapes::ball({0, 0, 0}, 10), 0);
    EvaluationCache cache(settings.objectives, settings.candidates);
    const SearchEnd end = search(
        segmentation, settings, cache, {}, [](const Segmentation&) {}, {}, TimeLimit{1e-9});
    EXPECT_TRUE(end.is_finished());
    EXPECT_FALSE(end.is_out_of_time());
}

TEST(Beam, GivesItsReasonWhereNothingCanBeCutOrTheSafetyStopIsReached) {
    for (const std::size_t width : {1U, 3U}) {
        SearchSettings settings = settings_of(2, width, 0);
        const Found stuck = searched(shapes::ball({0, 0, 0}, 10), settings);
        EXPECT_FALSE(stuck.end.is_finished());
        EXPECT_EQ(stuck.end.reason, EndReason::no_plane);
        EXPECT_EQ(stuck.end.sentence, "no plane parts any of the unfinished pieces");
        settings = settings_of(9, width);
        settings.stop.max_cuts = 2;
        const Found safe = searched(shapes::ball({0, 0, 0}, 10), settings);
        EXPECT_FALSE(safe.end.is_finished());
        EXPECT_EQ(safe.end.reason, EndReason::max_cuts);
        EXPECT_EQ(safe.end.sentence, "the safety stop of 2 cuts is reached");
        EXPECT_EQ(safe.segmentation.cuts.size(), 2U);
    }
}

}  // namespace
}  // namespace qchopper
