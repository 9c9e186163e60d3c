#include "segment/search/further_candidates.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/parallel.h"
#include "segment/access/sampled_piece.h"
#include "segment/mesh/measure.h"
#include "segment/sample/sample.h"
#include "segment/search/rank_piece.h"
#include "segment/search/search.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

SearchSettings of_sphere(int offsets = 7) {
    SearchSettings settings;
    settings.candidates.normals = CandidateNormals::sphere;
    settings.candidates.offsets_per_normal = offsets;
    settings.objectives.scope = TermScope::cut;
    settings.objectives.weights = {1, 1, 5, 1};
    return settings;
}

const SymmetryPlane tilted{canonical({normalized({1, 0.2, 0.1}), 3}), 1, 2};

Segmentation halved(const TriangleMesh& mesh, const Plane& plane) {
    Segmentation segmentation = uncut(mesh, 0);
    Cut cut;
    cut.number = 1;
    cut.piece = "A";
    cut.chosen.plane = plane;
    EXPECT_TRUE(apply(segmentation, cut, 0));
    return segmentation;
}

bool is_in(const std::vector<Ranked>& ranked, const Plane& plane) {
    return std::any_of(ranked.begin(), ranked.end(), [&](const Ranked& r) { return r.plane == plane; });
}

TEST(FurtherCandidates, AreTheSymmetryPlaneGivenPlanesAndMirrorImagesOfCuts) {
    const Plane first = canonical({normalized({0.3, 1, 0}), 2});
    const Segmentation segmentation = halved(shapes::torus({0, 0, 0}, 40, 12), first);
    CandidateOptions options;
    EXPECT_TRUE(further_candidates(segmentation, 0, options).empty());
    options.symmetry = tilted;
    options.given = {{canonical({{0, 0, 1}, 1})}, {canonical({{0, 0, 1}, 500})}};
    for (std::size_t piece = 0; piece < segmentation.pieces.size(); ++piece) {
        const std::vector<Candidate> found = further_candidates(segmentation, piece, options);
        ASSERT_EQ(found.size(), 3U) << "one given plane misses";
        const Plane expected[] = {tilted.plane, options.given[0].plane, reflected(first, tilted.plane)};
        const std::pair<int, int> index[] = {{symmetry_index, 0}, {given_index, 0}, {mirror_index, 1}};
        for (std::size_t i = 0; i < found.size(); ++i) {
            EXPECT_LT(norm(found[i].plane.normal - expected[i].normal), 1e-12);
            EXPECT_NEAR(found[i].plane.offset, expected[i].offset, 1e-4) << "nudged";
            EXPECT_EQ(std::pair(found[i].normal_index, found[i].offset_index), index[i]);
        }
    }
    const std::vector<Vec3> all = segmentation.pieces[0].mesh->points;
    options.no_cut = no_cut_at(all);
    EXPECT_TRUE(further_candidates(segmentation, 0, options).empty());
}

TEST(FurtherCandidates, AreRankedBesideTheOthers) {
    const TriangleMesh mesh = shapes::torus({0, 0, 0}, 40, 12);
    const Plane first = canonical({normalized({0.3, 1, 0}), 2});
    const Segmentation segmentation = halved(mesh, first);
    SearchSettings settings = of_sphere();
    EvaluationCache cache(settings.objectives, settings.candidates);
    const std::vector<Ranked> without = rank(segmentation, 0, settings, cache, {});
    settings.candidates.symmetry = tilted;
    const std::vector<Ranked> with = rank(segmentation, 0, settings, cache, {});
    for (const Candidate& c : further_candidates(segmentation, 0, settings.candidates)) {
        EXPECT_FALSE(is_in(without, c.plane));
        EXPECT_TRUE(is_in(with, c.plane));
        const std::optional<Ranked> alone = rank_plane(segmentation, 0, c, settings, cache, {});
        const auto at = std::find_if(with.begin(), with.end(), [&](const Ranked& r) { return r.plane == c.plane; });
        EXPECT_EQ(at->terms, alone->terms);
    }
    EXPECT_TRUE(std::is_sorted(with.begin(), with.end(),
                               [](const Ranked& a, const Ranked& b) { return a.terms.total + tie < b.terms.total; }));
}

TEST(FurtherCandidates, OfAPieceRankedByReachAreJudgedByTheirReach) {
    SampleOptions options;
    options.faces = 6'000;
    Segmentation segmentation = uncut(sample(Specimen::femur, options), 0);
    sample_uncut(segmentation.pieces, {}, 2'000);
    SearchSettings settings = of_sphere(12);
    settings.objectives.weights = {0.05, 1, 0.3, 0, 100};
    EvaluationCache cache(settings.objectives, settings.candidates);
    const std::vector<Ranked> without = rank(segmentation, 0, settings, cache, {});
    // A copy of the best plane, and a poor one, are given.
    const Piece& piece = segmentation.pieces[0];
    const Vec3 axis = canonical({cache.box(piece).axis[0], 0}).normal;
    const Extent range = extent(*piece.mesh, axis);
    const auto best = std::find_if(without.begin(), without.end(), [](const Ranked& r) { return r.normal_index >= 0; });
    settings.candidates.given = {{{best->plane.normal, best->plane.offset + 1e-3 * range.size()}},
                                 {{axis, range.low + 0.02 * range.size()}}};
    const std::vector<Ranked> with = rank(segmentation, 0, settings, cache, {});
    const std::vector<Candidate> given = further_candidates(segmentation, 0, settings.candidates);
    ASSERT_EQ(given.size(), 2U);
    EXPECT_TRUE(is_in(with, given[0].plane));
    EXPECT_FALSE(is_in(with, given[1].plane)) << "it opens too little to be a candidate";
    const auto at = std::find_if(with.begin(), with.end(), [&](const Ranked& r) { return r.plane == given[0].plane; });
    EXPECT_EQ(at->terms, rank_plane(segmentation, 0, given[0], settings, cache, {})->terms);
    EXPECT_NEAR(with.front().terms.total, without.front().terms.total, 0.1);
}

TEST(FurtherCandidates, NoPlaneOfARankingByReachGoesThroughSurfaceThatMustNotBeCut) {
    SampleOptions options;
    options.faces = 6'000;
    const TriangleMesh scan = sample(Specimen::femur, options);
    Segmentation segmentation = uncut(scan, 0);
    sample_uncut(segmentation.pieces, {}, 2'000);
    SearchSettings settings = of_sphere(12);
    settings.objectives.weights = {0.05, 1, 0.3, 0, 100};
    EvaluationCache free_cache(settings.objectives, settings.candidates);
    const Plane best = rank(segmentation, 0, settings, free_cache, {}).front().plane;
    // A spot that the best plane crosses.
    const auto over = [&](const Vec3& p) { return std::abs(height(best.normal, p) - best.offset); };
    const Vec3 middle = *std::min_element(scan.points.begin(), scan.points.end(),
                                          [&](const Vec3& a, const Vec3& b) { return over(a) < over(b); });
    std::vector<Vec3> marked;
    for (const Vec3& p : scan.points) {
        if (norm(p - middle) < 0.04 * norm(bounds(scan).size())) marked.push_back(p);
    }
    settings.candidates.no_cut = no_cut_at(marked);
    EvaluationCache cache(settings.objectives, settings.candidates);
    const std::vector<Ranked> ranked = rank_whole_normals(segmentation, 0, settings, cache, {}, 0);
    const std::vector<NoCutTriangle> triangles =
        no_cut_triangles(*segmentation.pieces[0].mesh, settings.candidates.no_cut);
    EXPECT_GT(ranked.size(), 10U);
    EXPECT_TRUE(is_forbidden(forbidden_heights(triangles, best.normal), best.offset));
    for (const Ranked& r : ranked) {
        EXPECT_FALSE(is_forbidden(forbidden_heights(triangles, r.plane.normal), r.plane.offset));
    }
    settings.candidates.no_cut = no_cut_at(scan.points);
    EvaluationCache none(settings.objectives, settings.candidates);
    EXPECT_TRUE(rank(segmentation, 0, settings, none, {}).empty());
}

TEST(FurtherCandidates, AFinerOffsetIsTakenWhereItCostsLess) {
    SampleOptions options;
    options.faces = 4'000;
    const Segmentation segmentation = uncut(sample(Specimen::vertebra, options), 0);
    SearchSettings settings = of_sphere();
    bool is_any_finer = false;
    for (const int offsets : {1, 2, 3, 4}) {
        settings.candidates.offsets_per_normal = offsets;
        EvaluationCache cache(settings.objectives, settings.candidates);
        const std::vector<Ranked> ranked = rank(segmentation, 0, settings, cache, {});
        const auto best =
            std::find_if(ranked.begin(), ranked.end(), [](const Ranked& r) { return r.normal_index >= 0; });
        const Piece& piece = segmentation.pieces[0];
        double least = best->terms.total;
        for (const Candidate& c : offsets_around(piece, *best, settings.candidates)) {
            EXPECT_EQ(c.plane.normal, best->plane.normal);
            const double step = offset_step(extent(*piece.mesh, c.plane.normal), settings.candidates);
            EXPECT_LT(std::abs(c.wanted_offset - best->wanted_offset), step);
            const std::optional<Ranked> finer = rank_plane(segmentation, 0, c, settings, cache, {});
            if (finer) least = std::min(least, finer->terms.total);
        }
        EXPECT_NEAR(ranked.front().terms.total, least, 1e-9);
        is_any_finer = is_any_finer || ranked.front().normal_index == refined_index;
    }
    EXPECT_TRUE(is_any_finer);
}

double degrees(Vec3 a, Vec3 b) {
    return std::acos(std::min(1.0, std::abs(dot(a, b)))) * 180 / std::numbers::pi;
}

TEST(FurtherCandidates, PlanesNearToABetterOneAreDroppedAndNoOthers) {
    const TriangleMesh mesh = shapes::box({0, 0, 0}, {90, 50, 20}, 4);  // its centroid is (45, 25, 10)
    const Segmentation segmentation = uncut(mesh, 0);
    const SearchSettings settings = of_sphere();
    EvaluationCache cache(settings.objectives, settings.candidates);
    const Piece& piece = segmentation.pieces[0];
    const std::vector<Ranked> ranked = rank(segmentation, 0, settings, cache, {});
    const std::vector<std::size_t> kept = without_near_planes(ranked, piece, cache.box(piece));
    EXPECT_TRUE(std::is_sorted(kept.begin(), kept.end()));
    EXPECT_EQ(kept.front(), 0U);
    EXPECT_GT(kept.size(), 20U);
    EXPECT_LT(kept.size(), ranked.size() / 2);
    const Vec3 centre{45, 25, 10};
    const double diagonal = norm(Vec3{90, 50, 20});
    // The points at which the normal through the centroid meets two planes.
    const auto are_near = [&](const Plane& a, const Plane& b) {
        if (degrees(a.normal, b.normal) > 18) return false;
        const Vec3 of_b = dot(a.normal, b.normal) < 0 ? -b.normal : b.normal;
        const double to_a = a.offset - dot(a.normal, centre);
        const double to_b = dot(b.offset * b.normal - centre, of_b);
        return std::abs(to_a - to_b) < 0.05 * diagonal;
    };
    for (std::size_t i = 0; i < ranked.size(); ++i) {
        bool is_expected = true;
        for (const std::size_t k : kept) is_expected &= k >= i || !are_near(ranked[k].plane, ranked[i].plane);
        EXPECT_EQ(std::binary_search(kept.begin(), kept.end(), i), is_expected) << i;
    }
}

TEST(FurtherCandidates, ABeamOverAllPlanesIsTheSameForAnyNumberOfThreads) {
    const TriangleMesh mesh = shapes::rotated(shapes::torus({0, 0, 0}, 40, 12), {1, 2, 3}, 0.5);
    SearchSettings settings = of_sphere(4);
    settings.candidates.symmetry = symmetry_plane(mesh, {1'000, 100, 4, 0.01});
    settings.candidates.given = {{canonical({{0, 0, 1}, 1})}};
    settings.stop.min_cuts = 3;
    settings.beam = 3;
    const auto with = [&](std::size_t threads) {
        const ThreadLimit limit(threads);
        Segmentation segmentation = uncut(mesh, 0);
        EvaluationCache cache(settings.objectives, settings.candidates);
        search(segmentation, settings, cache, {}, [](const Segmentation&) {}, {});
        return segmentation.cuts;
    };
    const std::vector<Cut> one = with(1);
    EXPECT_EQ(one.size(), 3U);
    EXPECT_TRUE(with(2) == one);
    EXPECT_TRUE(with(3) == one);
}

TEST(Proposer, IsThatOfAGivenPlaneAlsoIfItWasRefined) {
    CandidateOptions options;
    options.given = {{canonical({{0, 0, 1}, 1})}, {canonical({{0, 1, 0}, 1}), "shlafman"}};
    Ranked plane;
    for (const int kind : {given_index, refined_given_index}) {
        plane.normal_index = kind;
        plane.offset_index = 0;
        EXPECT_EQ(proposer_of(plane, options), "");
        plane.offset_index = 1;
        EXPECT_EQ(proposer_of(plane, options), "shlafman");
        plane.offset_index = 2;  // of other settings
        EXPECT_EQ(proposer_of(plane, options), "");
    }
    plane.normal_index = refined_index;
    plane.offset_index = 1;
    EXPECT_EQ(proposer_of(plane, options), "");
}

}  // namespace
}  // namespace qchopper
