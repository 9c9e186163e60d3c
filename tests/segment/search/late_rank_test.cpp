#include "segment/search/late_rank.h"

#include <gtest/gtest.h>

#include "segment/mesh/oriented_box.h"
#include "segment/objectives/seam_cost.h"
#include "segment/sample/sample.h"
#include "segment/search/candidates/evaluate.h"
#include "segment/search/search.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

SearchSettings chopper() {
    SearchSettings settings;
    Objectives& o = settings.objectives;
    o.weights = {0, 1, 0, 0, 0, 1, 0.05, 1, 0.1, 0.25};
    o.scope = TermScope::cut;
    o.fragility_form = FragilityForm::binary;
    o.fragility_distance = 4;
    o.print_volume = Vec3{40, 40, 40};
    o.connector = {ConnectorForm::spread, 3, 3, 1, 2};
    o.symmetry_plane = Plane{{1, 0, 0}, 2};
    settings.stop.max_obb = o.print_volume;
    return settings;
}

Segmentation start(const TriangleMesh& mesh) {
    Segmentation s = uncut(mesh, 0);
    s.scan = measure_scan(s);
    find_seam_costs(s.pieces);
    return s;
}

// All candidates, all terms of each evaluated.
std::vector<Ranked> plain(const Segmentation& s, std::size_t piece, const SearchSettings& settings) {
    EvaluationCache cache(settings.objectives, settings.candidates);
    PieceEvaluations all;
    all.candidates = cache.candidates(s.pieces[piece]);
    all.evaluations = evaluate_all(s.pieces[piece], all.candidates, settings.objectives, Context{});
    return rank(all, shares_of_others(s, piece, settings.objectives, cache), settings.objectives,
                scan_share(s, piece, settings.objectives, cache));
}

// Three cuts by the best plane; before each the best planes are those of evaluating all.
void expect_best_of_all(const std::string& name, const TriangleMesh& mesh, const SearchSettings& settings) {
    Segmentation s = start(mesh);
    for (int cut = 0; cut < 3; ++cut) {
        EvaluationCache cache(settings.objectives, settings.candidates);
        const std::vector<Ranked> all = plain(s, 0, settings);
        if (all.empty()) break;
        for (const std::size_t best : {std::size_t{1}, std::size_t{5}, all.size() + 1}) {
            const std::vector<Ranked> late = rank_late(s, 0, settings, cache, {}, best);
            ASSERT_GE(late.size(), std::min(best, all.size())) << name;
            for (std::size_t k = 0; k < late.size(); ++k) {
                ASSERT_EQ(late[k], all[k]) << name << " cut " << cut << " best " << best << " place " << k;
            }
        }
        ASSERT_TRUE(apply(s, cut_by(s, 0, all, 0, settings), 0)) << name;
    }
}

TEST(LateRank, TheBestPlanesAreThoseOfEvaluatingAll) {
    for (const auto& [name, mesh, count] : shapes::all_closed()) expect_best_of_all(name, mesh, chopper());
}

TEST(LateRank, TheBestPlanesOfASpecimenAreThoseOfEvaluatingAll) {
    SearchSettings settings = chopper();
    Objectives& o = settings.objectives;
    o.fragility_distance = 20;
    o.print_volume = Vec3{200, 200, 200};
    o.connector = {};
    SampleOptions options;
    options.faces = 3'000;
    expect_best_of_all("vertebra", sample(Specimen::vertebra, options), settings);
}

TEST(LateRank, ForbiddenPlanesComeOnlyWhenNoOtherIsLeft) {
    SearchSettings settings = chopper();
    settings.objectives.forbidden = {"fragility"};
    const Segmentation s = start(shapes::linked_tori());
    EvaluationCache cache(settings.objectives, settings.candidates);
    const std::vector<Ranked> all = plain(s, 0, settings);
    const auto first = std::find_if(all.begin(), all.end(), [](const Ranked& r) { return r.terms.fragility >= 1; });
    ASSERT_NE(first, all.end());
    EXPECT_TRUE(std::all_of(first, all.end(), [](const Ranked& r) { return r.terms.fragility >= 1; }));
    EXPECT_NE(first, all.begin());
    const std::vector<Ranked> late = rank_late(s, 0, settings, cache, {}, 3);
    ASSERT_FALSE(late.empty());
    for (std::size_t k = 0; k < late.size(); ++k) EXPECT_EQ(late[k], all[k]);
    // A sheet that is thinner than the distance has no other.
    const Segmentation sheet = start(shapes::box({0, 0, 0}, {7, 7, 7}, 2));
    EXPECT_EQ(plain(sheet, 0, settings).front().terms.fragility, 1);
    EvaluationCache other(settings.objectives, settings.candidates);
    EXPECT_EQ(rank_late(sheet, 0, settings, other, {}, 3).front().terms.fragility, 1);
}

TEST(LateRank, OwnBoxesAreThoseOfThePartsThatTheCutMakes) {
    SearchSettings settings = chopper();
    settings.objectives.print_volume = Vec3{60, 50, 40};
    const Segmentation s = start(shapes::linked_tori());
    EvaluationCache cache(settings.objectives, settings.candidates);
    const std::vector<Ranked> ranked =
        with_own_boxes(plain(s, 0, settings), s, 0, settings.objectives, cache, Context{});
    double before = 0;
    for (std::size_t k = 0; k < std::min(ranked.size(), max_own_boxes); ++k) {
        Segmentation after = s;
        ASSERT_TRUE(apply(after, cut_by(s, 0, ranked, k, settings), 0));
        double boxes = 0;
        for (const Piece& p : after.pieces)
            boxes += print_boxes(oriented_box(p.mesh->points).size(), settings.objectives);
        const ScanShare scan = scan_share(s, 0, settings.objectives, cache);
        EXPECT_DOUBLE_EQ(ranked[k].terms.parts, boxes / scan.boxes) << k;
        EXPECT_GE(ranked[k].terms.total, before);
        before = ranked[k].terms.total;
    }
}

TEST(LateRank, ASearchEndsWhenEveryPartFitsAndItsCostIsThatOfItsCuts) {
    for (const std::size_t beam : {std::size_t{1}, std::size_t{3}}) {
        SearchSettings settings = chopper();
        settings.beam = beam;
        settings.candidates.offsets_per_normal = 15;
        Segmentation s = start(shapes::box({0, 0, 0}, {150, 38, 36}, 6));
        EvaluationCache cache(settings.objectives, settings.candidates);
        const SearchEnd end = search(
            s, settings, cache, {}, [](const Segmentation&) {}, Context{});
        EXPECT_TRUE(end.is_finished()) << end.sentence;
        EXPECT_GE(s.pieces.size(), 4U);
        const Terms& last = s.cuts.back().chosen.terms;
        double expected = settings.objectives.weights.parts * last.parts + 0.1 * last.seam;
        for (const Cut& cut : s.cuts) {
            const Terms& t = cut.chosen.terms;
            expected += t.fragility + 0.05 * t.utilization + t.connector + 0.25 * t.symmetry;
        }
        EXPECT_NEAR(end.cost, expected, 1e-9);
    }
}

}  // namespace
}  // namespace qchopper
