#include "segment/search/candidates/size_candidates.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <map>

#include "base/parallel.h"
#include "segment/access/sampled_piece.h"
#include "segment/mesh/boxes_needed.h"
#include "segment/sample/sample.h"
#include "segment/search/access_rank.h"
#include "segment/search/search.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

CandidateOptions offsets(int per_normal) {
    CandidateOptions options;
    options.offsets_per_normal = per_normal;
    return options;
}

SearchSettings carving(Vec3 limit) {
    SearchSettings settings;
    settings.objectives.weights = {0.05, 1, 0.3, 0, 100};
    settings.objectives.scope = TermScope::cut;
    settings.candidates.offsets_per_normal = 24;
    settings.stop.max_obb = limit;
    return settings;
}

Segmentation sampled(const TriangleMesh& scan) {
    Segmentation segmentation = uncut(scan, 0);
    sample_uncut(segmentation.pieces, {}, 1'000);
    return segmentation;
}

TriangleMesh bone() {
    SampleOptions options;
    options.faces = 4'000;
    return sample(Specimen::femur, options);
}

// The scan, and the size of a box that is too small for it.
struct Sized {
    TriangleMesh scan;
    Vec3 limit;
};

std::vector<Sized> sized() {
    const Vec3 femur = oriented_box(bone().points).size();
    return {{shapes::box({0, 0, 0}, {300, 40, 30}, 8), {45, 75, 35}},
            {bone(), {femur.x / 2.7, 0.8 * femur.y, 1.1 * femur.z}}};
}

struct Found {
    Segmentation segmentation;
    SearchEnd end;
};

Found searched(const TriangleMesh& scan, const SearchSettings& settings, const PieceChecks& checks = {}) {
    Found found{sampled(scan), {}};
    EvaluationCache cache(settings.objectives, settings.candidates);
    found.end = search(found.segmentation, settings, cache, checks, [](const Segmentation&) {}, {});
    return found;
}

TEST(SizeCut, APieceIsCutIntoFewPiecesThatFit) {
    for (const Sized& s : sized()) {
        const double least = boxes_needed(oriented_box(s.scan.points).size(), s.limit);
        ASSERT_GE(least, 4);
        const Found found = searched(s.scan, carving(s.limit));
        EXPECT_EQ(found.end.reason, EndReason::rules_hold) << found.end.sentence;
        EXPECT_LE(static_cast<double>(found.segmentation.pieces.size()), 2 * least);
        for (const Piece& piece : found.segmentation.pieces) {
            EXPECT_TRUE(fits_in(oriented_box(piece.mesh->points).size(), s.limit)) << piece.name;
        }
    }
}

TEST(SizeCut, TheBlocksOfTheCellServeLikeALargestBox) {
    for (const Sized& s : sized()) {
        SearchSettings settings = carving(s.limit);
        const Found by_box = searched(s.scan, settings);
        settings.stop.max_obb.reset();
        settings.stop.fits_cell = true;
        const PieceChecks checks{[&](const Piece& p) { return fits_in(oriented_box(p.mesh->points).size(), s.limit); },
                                 {},
                                 [&](Vec3 size) { return boxes_needed(size, s.limit); }};
        EXPECT_EQ(searched(s.scan, settings, checks).segmentation.cuts, by_box.segmentation.cuts);
    }
}

TEST(SizeCut, CandidatesAreThePlanesThatLeaveTheFewestBlocks) {
    const Vec3 limit{45, 77, 35};
    const BlocksNeeded blocks = [&](Vec3 size) { return boxes_needed(size, limit); };
    OrientedBox box{};
    box.max = {300, 40, 30};
    EXPECT_TRUE(candidates_for_size(box, offsets(24), {}).empty());
    const auto planes = candidates_for_size(box, offsets(24), blocks);
    std::map<std::pair<std::size_t, std::size_t>, double> needed;
    double fewest = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < 24; ++k) {
        const double share = static_cast<double>(k + 1) / 25;
        needed[{0, k}] = blocks({300 * share, 40, 30}) + blocks({300 * (1 - share), 40, 30});
        needed[{1, k}] = blocks({300, 40 * share, 30}) + blocks({300, 40 * (1 - share), 30});
        needed[{2, k}] = blocks({300, 40, 30 * share}) + blocks({300, 40, 30 * (1 - share)});
        for (std::size_t axis = 0; axis < 3; ++axis) fewest = std::min(fewest, needed[{axis, k}]);
    }
    for (const auto& [plane, sum] : needed) EXPECT_EQ(planes.contains(plane), sum == fewest);
    EXPECT_EQ(fewest, 4);
    EXPECT_TRUE(planes.contains({0, 5})) << "72 and 228 mm need 1 and 3";
    EXPECT_FALSE(planes.contains({0, 11})) << "144 and 156 mm need 2 and 3";
}

TEST(SizeCut, APieceThatDoesNotFitThoughItsBoxDoesIsCutAcrossItsLength) {
    OrientedBox box{};
    box.max = {300, 40, 30};
    const auto planes = candidates_for_size(box, offsets(80), [](Vec3) { return 1; });
    EXPECT_EQ(planes.size(), 40U);
    for (const auto& [normal, k] : planes) {
        EXPECT_EQ(normal, 0U);
        EXPECT_NEAR(static_cast<double>(k + 1) / 81, 0.5, 0.25);
    }
    const auto never = [](Vec3) { return std::numeric_limits<double>::infinity(); };
    EXPECT_TRUE(candidates_for_size(box, offsets(80), never).empty()) << "then it is cut as any other";
}

// Of the planes for size, each with all its terms.
TEST(SizeCut, TheBestPlaneIsTheCheapestOfThoseForSize) {
    for (const Sized& s : sized()) {
        const SearchSettings settings = carving(s.limit);
        const Segmentation segmentation = sampled(s.scan);
        const BlocksNeeded blocks = [&](Vec3 size) { return boxes_needed(size, s.limit); };
        EvaluationCache cache(settings.objectives, settings.candidates);
        const auto planes = candidates_for_size(cache.box(segmentation.pieces[0]), settings.candidates, blocks);
        ASSERT_GE(planes.size(), min_best_planes);
        std::vector<Ranked> all;
        for (int n = 0; n < 3; ++n) all = rank_whole_normals_by_access(segmentation, 0, settings, cache, {}, 0, n);
        std::erase_if(all, [&](const Ranked& r) {
            return !planes.contains(
                {static_cast<std::size_t>(r.normal_index), static_cast<std::size_t>(r.offset_index)});
        });
        const std::vector<Ranked> best = rank(segmentation, 0, settings, cache, {}, min_best_planes, blocks);
        ASSERT_GE(best.size(), min_best_planes);
        for (std::size_t i = 0; i < min_best_planes; ++i) EXPECT_EQ(best[i].plane, all[i].plane) << i;
        for (const Ranked& r : best) {
            EXPECT_TRUE(
                planes.contains({static_cast<std::size_t>(r.normal_index), static_cast<std::size_t>(r.offset_index)}));
        }
        EvaluationCache fresh(settings.objectives, settings.candidates);
        EXPECT_EQ(rank(segmentation, 0, settings, fresh, {}, min_best_planes, blocks), best)
            << "what was ranked before changes nothing";
    }
}

TEST(SizeCut, PiecesThatAreTooLargeAreCutBeforeAllOthers) {
    const SearchSettings settings = carving({45, 45, 35});
    StopRules rules = settings.stop;
    rules.max_unreachable = 0.02;
    const PieceChecks checks{{}, [](const Piece&) { return UnreachableSurface{10, 0.1}; }};
    const auto size = [](const Piece& p) { return oriented_box(p.mesh->points).size(); };
    Segmentation segmentation = uncut(shapes::box({0, 0, 0}, {100, 40, 30}, 8), 0);
    Cut cut;
    cut.piece = "A";
    cut.chosen.plane = {{1, 0, 0}, 30.3};
    ASSERT_TRUE(apply(segmentation, cut, 0));
    const std::size_t small = size(segmentation.pieces[0]).x < 45 ? 0 : 1;
    const auto prefers_small = [&](const Piece& p) { return p.name == segmentation.pieces[small].name ? 2.0 : 1.0; };
    StopJudge judge(rules, checks, size, prefers_small);
    EXPECT_FALSE(judge.too_large_for(segmentation.pieces[small]));
    const BlocksNeeded blocks = judge.too_large_for(segmentation.pieces[1 - small]);
    ASSERT_TRUE(blocks);
    EXPECT_EQ(blocks({100, 40, 30}), 3);
    EXPECT_EQ(judge.next(segmentation, {}).waiting, (std::vector<std::size_t>{1 - small, small}));
    EXPECT_FALSE(judge.next(segmentation, {}).is_trial);
    rules.max_obb.reset();
    StopJudge of_any_size(rules, checks, size, prefers_small);
    EXPECT_EQ(of_any_size.next(segmentation, {}).waiting, (std::vector<std::size_t>{small, 1 - small}));
}

TEST(SizeCut, WithoutAWeightOfReachNothingChanges) {
    const Sized s = sized().back();
    SearchSettings settings = carving(s.limit);
    settings.objectives.weights = {10, 5, 50, 10};
    settings.objectives.scope = TermScope::whole;
    const Segmentation segmentation = uncut(s.scan, 0);
    EvaluationCache cache(settings.objectives, settings.candidates);
    const BlocksNeeded blocks = [&](Vec3 size) { return boxes_needed(size, s.limit); };
    EXPECT_EQ(rank(segmentation, 0, settings, cache, {}, 1, blocks), rank(segmentation, 0, settings, cache, {}));
    settings.stop.max_obb.reset();
    settings.stop.fits_cell = true;
    settings.stop.max_cuts = 4;
    const FitsCell fits = [&](const Piece& p) { return fits_in(oriented_box(p.mesh->points).size(), s.limit); };
    EXPECT_EQ(searched(s.scan, settings, {fits, {}, blocks}).segmentation.cuts,
              searched(s.scan, settings, {fits, {}}).segmentation.cuts);
}

TEST(SizeCut, ASearchIsTheSameForAnyNumberOfThreadsAndIfItIsInterrupted) {
    const Sized s = sized().front();
    const SearchSettings settings = carving(s.limit);
    const Found whole = searched(s.scan, settings);
    Segmentation in_parts = sampled(s.scan);
    const ThreadLimit one(1);
    SearchEnd end;
    std::size_t parts = 0;
    do {
        EvaluationCache cache(settings.objectives, settings.candidates);
        end = search(
            in_parts, settings, cache, {}, [](const Segmentation&) {}, {}, TimeLimit{1e-9});
    } while (end.is_out_of_time() && ++parts < 100);
    EXPECT_GE(parts, 3U);
    EXPECT_EQ(in_parts.cuts, whole.segmentation.cuts);
}

}  // namespace
}  // namespace qchopper
