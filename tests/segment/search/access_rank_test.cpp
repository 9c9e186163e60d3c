#include "segment/search/access_rank.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "base/parallel.h"
#include "segment/access/access_sweep.h"
#include "segment/access/piece_access.h"
#include "segment/cut/nudge.h"
#include "segment/mesh/measure.h"
#include "segment/objectives/seam_cost.h"
#include "segment/sample/sample.h"
#include "segment/search/search.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

SearchSettings carving() {
    SearchSettings settings;
    settings.objectives.weights = {0.05, 1, 0.3, 0, 100};
    settings.objectives.scope = TermScope::cut;
    settings.candidates.offsets_per_normal = 12;
    return settings;
}

Segmentation sampled(const TriangleMesh& scan, std::size_t count = 2'000) {
    Segmentation segmentation = uncut(scan, 0);
    sample_uncut(segmentation.pieces, {}, count);
    return segmentation;
}

TriangleMesh bone(Specimen specimen) {
    SampleOptions options;
    options.faces = 6'000;
    return sample(specimen, options);
}

// All planes of all normals with all their terms, nothing left out.
std::vector<Ranked> rank_all(const Segmentation& segmentation, const SearchSettings& settings) {
    EvaluationCache cache(settings.objectives, settings.candidates);
    const int count =
        static_cast<int>(candidate_normals(cache.box(segmentation.pieces[0]), CandidateNormals::sphere).size());
    std::vector<Ranked> all;
    for (int n = 0; n < count; ++n) all = rank_whole_normals_by_access(segmentation, 0, settings, cache, {}, 0, n);
    std::erase_if(all, [](const Ranked& r) { return r.normal_index == refined_index; });
    return all;
}

// Of all planes those that open nearly as much as the best one, or along the box's axes if none opens anything.
std::vector<Ranked> candidates_among(std::vector<Ranked> all, const Piece& piece, const SearchSettings& settings) {
    const double now = area_on_best_base(piece, settings.objectives.tilt_deg).unreachable_mm2 / scan_area_mm2(piece);
    double least = now;
    for (const Ranked& r : all) least = std::min(least, r.terms.unreachable);
    const double gain = now - least;
    std::erase_if(all, [&](const Ranked& r) {
        return gain < min_gain_of_scan ? r.normal_index >= 3
                                       : r.terms.unreachable > now - min_share_of_gain * gain + 1e-12;
    });
    return all;
}

TEST(AccessRank, TheBestPlanesAreThoseOfAllOfThem) {
    for (const TriangleMesh& scan : {bone(Specimen::femur), shapes::ball({0, 0, 0}, 30, 24)}) {
        const Segmentation segmentation = sampled(scan);
        SearchSettings settings = carving();
        const std::vector<Ranked> planes = rank_all(segmentation, settings);
        EXPECT_GT(planes.size(), 1'000U);
        const std::vector<Ranked> all = candidates_among(planes, segmentation.pieces[0], settings);
        for (const std::size_t beam : {std::size_t{1}, std::size_t{4}}) {
            settings.beam = beam;
            EvaluationCache cache(settings.objectives, settings.candidates);
            std::vector<Ranked> best = rank_by_access(segmentation, 0, settings, cache, {});
            std::erase_if(best, [](const Ranked& r) { return r.normal_index == refined_index; });
            ASSERT_GE(best.size(), beam);
            for (std::size_t i = 0; i < beam; ++i) {
                EXPECT_EQ(best[i].plane, all[i].plane) << i;
                EXPECT_NEAR(best[i].terms.total, all[i].terms.total, 1e-12) << i;
            }
        }
    }
}

TEST(AccessRank, WithConnectorAndSeamTheBestPlaneIsThatOfAllOfThemToo) {
    Segmentation segmentation = sampled(bone(Specimen::femur));
    segmentation.scan = measure_scan(segmentation);
    find_seam_costs(segmentation.pieces, {}, 2'000);
    SearchSettings settings = carving();
    settings.objectives.weights.connector = 0.5;
    settings.objectives.weights.seam = 0.2;
    settings.objectives.connector = {ConnectorForm::spread, 4, 6, 2, 3};
    const std::vector<Ranked> all =
        candidates_among(rank_all(segmentation, settings), segmentation.pieces[0], settings);
    ASSERT_FALSE(all.empty());
    EvaluationCache cache(settings.objectives, settings.candidates);
    std::vector<Ranked> best = rank_by_access(segmentation, 0, settings, cache, {});
    std::erase_if(best, [](const Ranked& r) { return r.normal_index == refined_index; });
    EXPECT_EQ(best[0].plane, all[0].plane);
    EXPECT_EQ(best[0].terms.connector, all[0].terms.connector);
    EXPECT_NEAR(best[0].terms.total, all[0].terms.total, 1e-12);
    EXPECT_GT(best[0].terms.seam, 0);
    EXPECT_LT(count_evaluated(cache.access(segmentation.pieces[0]).planes, TermStage::solids), 800U);
    const auto held = std::find_if(all.begin(), all.end(), [](const Ranked& r) { return r.terms.connector < 1; });
    EXPECT_NE(held, all.end());
}

// The cheapest planes are forbidden: as cheap as they are, they say nothing of what the best allowed one costs.
TEST(AccessRank, ForbiddenPlanesComeOnlyWhenNoOtherIsLeft) {
    const Segmentation segmentation = sampled(bone(Specimen::femur));
    SearchSettings settings = carving();
    Objectives& o = settings.objectives;
    o.weights.fragility = 1e-6;
    o.fragility_form = FragilityForm::binary;
    o.fragility_distance = 20;
    o.forbidden = {"fragility"};
    const std::vector<Ranked> all =
        candidates_among(rank_all(segmentation, settings), segmentation.pieces[0], settings);
    const auto first_out =
        std::find_if(all.begin(), all.end(), [&](const Ranked& r) { return is_forbidden(r.terms, o); });
    ASSERT_NE(first_out, all.begin());
    ASSERT_NE(first_out, all.end());
    EXPECT_LT(first_out->terms.total, all.front().terms.total) << "a forbidden plane costs least";
    EvaluationCache cache(settings.objectives, settings.candidates);
    std::vector<Ranked> best = rank_by_access(segmentation, 0, settings, cache, {});
    std::erase_if(best, [](const Ranked& r) { return r.normal_index == refined_index; });
    const auto allowed = std::min<std::size_t>(min_best_planes, static_cast<std::size_t>(first_out - all.begin()));
    ASSERT_GE(best.size(), allowed);
    for (std::size_t i = 0; i < allowed; ++i) EXPECT_EQ(best[i].plane, all[i].plane) << i;
}

TEST(AccessRank, FewPlanesAreEvaluated) {
    const Segmentation segmentation = sampled(bone(Specimen::femur));
    const SearchSettings settings = carving();
    EvaluationCache cache(settings.objectives, settings.candidates);
    rank_by_access(segmentation, 0, settings, cache, {});
    EXPECT_GE(cache.access(segmentation.pieces[0]).normals.size(), 129U);
    EXPECT_LT(count_evaluated(cache.access(segmentation.pieces[0]).planes, TermStage::solids), 400U);
}

// The plane is nudged by less than the samples notice.
TEST(AccessRank, WhatAPlaneLeavesOutOfReachIsWhatItsPiecesDo) {
    for (const Specimen specimen : {Specimen::femur, Specimen::vertebra, Specimen::skull}) {
        Segmentation segmentation = sampled(bone(specimen));
        const SearchSettings settings = carving();
        for (int round = 0; round < 3; ++round) {
            EvaluationCache cache(settings.objectives, settings.candidates);
            const std::vector<Ranked> ranked = rank(segmentation, segmentation.pieces.size() - 1, settings, cache, {});
            ASSERT_FALSE(ranked.empty());
            const double wanted = ranked.front().terms.unreachable;
            ASSERT_TRUE(
                apply(segmentation, cut_by(segmentation, segmentation.pieces.size() - 1, ranked, 0, settings), 0));
            double sum = 0;
            for (const Piece& piece : segmentation.pieces)
                sum += area_on_best_base(piece, settings.objectives.tilt_deg).unreachable_mm2;
            EXPECT_NEAR(sum / scan_area_mm2(segmentation.pieces[0]), wanted, 0.004);
        }
    }
}

TEST(AccessRank, AnOwnPlaneCostsWhatTheSameCandidateCosts) {
    const Segmentation segmentation = sampled(bone(Specimen::femur));
    const SearchSettings settings = carving();
    EvaluationCache cache(settings.objectives, settings.candidates);
    const Ranked best = rank(segmentation, 0, settings, cache, {}).front();
    const Candidate same{best.plane, best.wanted_offset, own_index, own_index};
    const std::optional<Ranked> own = rank_plane(segmentation, 0, same, settings, cache, {});
    ASSERT_TRUE(own);
    EXPECT_NEAR(own->terms.unreachable, best.terms.unreachable, 0.002);
    EXPECT_NEAR(own->terms.fragility, best.terms.fragility, 1e-9);
}

// Calls `check` with the segmentation, the index of the piece that is cut next and its ranking, for three cuts of each
// specimen.
void for_rankings(const SearchSettings& settings,
                  const std::function<void(const Segmentation&, std::size_t, const std::vector<Ranked>&)>& check) {
    for (const Specimen specimen : {Specimen::femur, Specimen::vertebra, Specimen::skull}) {
        Segmentation segmentation = sampled(bone(specimen));
        for (int round = 0; round < 3; ++round) {
            EvaluationCache cache(settings.objectives, settings.candidates);
            const std::size_t piece = segmentation.pieces.size() - 1;
            const std::vector<Ranked> ranked = rank(segmentation, piece, settings, cache, {});
            check(segmentation, piece, ranked);
            ASSERT_TRUE(apply(segmentation, cut_by(segmentation, piece, ranked, 0, settings), 0));
        }
    }
}

// The refined plane too. Of a side of several solids only the first four are known, because only cutting judges it.
TEST(AccessRank, AllPlanesStandWhereTheSameEvaluationPutsThem) {
    const SearchSettings settings = carving();
    std::size_t refined = 0;
    for_rankings(settings, [&](const Segmentation& s, std::size_t piece, const std::vector<Ranked>& ranked) {
        EvaluationCache fresh(settings.objectives, settings.candidates);
        double last = 0;
        constexpr std::size_t most = 30;
        for (std::size_t i = 0; i < ranked.size(); ++i) {
            const Ranked& r = ranked[i];
            EXPECT_GE(r.terms.total + tie, last);
            last = r.terms.total;
            if (i >= most && r.normal_index != refined_index) continue;
            const Candidate same{r.plane, r.wanted_offset, r.normal_index, r.offset_index};
            const std::size_t solids = fresh.evaluation_of(s.pieces[piece], same, {})->solids.size();
            refined += r.normal_index == refined_index ? 1 : 0;
            if (solids > 2 && i >= min_best_planes) continue;
            const std::optional<Ranked> again = rank_plane(s, piece, same, settings, fresh, {});
            ASSERT_TRUE(again);
            EXPECT_NEAR(again->terms.total, r.terms.total, 1e-9) << "place " << i << " of " << ranked.size();
        }
    });
    EXPECT_GT(refined, 0U);
}

TEST(AccessRank, PlanesOfAListAreMoreThanAStepApart) {
    const SearchSettings settings = carving();
    std::size_t dropped = 0;
    for_rankings(settings, [&](const Segmentation& s, std::size_t piece, const std::vector<Ranked>& ranked) {
        const TriangleMesh& mesh = *s.pieces[piece].mesh;
        const auto are_neighbours = [&](const Ranked& a, const Ranked& b) {
            const double step = offset_step(extent(mesh, a.plane.normal), settings.candidates);
            return norm(a.plane.normal - b.plane.normal) < 1e-9 &&
                   std::abs(a.plane.offset - b.plane.offset) < 1.0001 * step;
        };
        const auto are_close = [&](const Plane& a, const Plane& b) {
            const Vec3 centre = bounds(mesh).centre();
            const double sign = dot(a.normal, b.normal) < 0 ? -1 : 1;
            const double moved = a.offset - height(a.normal, centre) - sign * (b.offset - height(b.normal, centre));
            return sign * dot(a.normal, b.normal) > 0.98 &&
                   std::abs(moved) < 1.01 * offset_step(extent(mesh, a.normal), settings.candidates);
        };
        const std::vector<std::size_t> listed =
            without_neighbours(ranked, s.pieces[piece], settings.candidates, ranked.size());
        ASSERT_FALSE(listed.empty());
        EXPECT_EQ(listed.front(), 0U);
        for (std::size_t i = 0; i < listed.size(); ++i) {
            for (std::size_t j = 0; j < i; ++j) {
                EXPECT_LT(listed[j], listed[i]);
                EXPECT_FALSE(are_neighbours(ranked[listed[j]], ranked[listed[i]])) << listed[j] << " " << listed[i];
            }
        }
        for (std::size_t i = 0; i < ranked.size(); ++i) {
            if (ranked[i].normal_index < 0 || std::find(listed.begin(), listed.end(), i) != listed.end()) continue;
            ++dropped;
            const bool is_near = std::any_of(listed.begin(), listed.end(), [&](std::size_t k) {
                return k < i && are_close(ranked[k].plane, ranked[i].plane);
            });
            EXPECT_TRUE(is_near) << "place " << i << " is dropped for no better plane";
        }
        const Cut cut = cut_by(s, piece, ranked, 0, settings);
        for (std::size_t i = 0; i < std::min(cut.runners_up.size(), listed.size() - 1); ++i) {
            EXPECT_EQ(cut.runners_up[i], ranked[listed[i + 1]]);
        }
    });
    EXPECT_GT(dropped, 0U);
}

TEST(AccessRank, WithoutSamplesOrWeightThePlanesOfTheBoxAreRanked) {
    SearchSettings settings = carving();
    EXPECT_FALSE(is_ranked_by_access(uncut(bone(Specimen::femur), 0).pieces[0], settings));
    settings.objectives.weights.unreachable = 0;
    const Segmentation segmentation = sampled(bone(Specimen::femur), 200);
    EXPECT_FALSE(is_ranked_by_access(segmentation.pieces[0], settings));
    EvaluationCache cache(settings.objectives, settings.candidates);
    for (const Ranked& r : rank(segmentation, 0, settings, cache, {})) {
        EXPECT_LT(r.normal_index, 3);
        EXPECT_EQ(r.terms.unreachable, 0);
    }
}

TEST(AccessRank, ASearchTakesThePieceOfWhichMostIsOutOfReachAndItsCostAddsUp) {
    Segmentation segmentation = sampled(bone(Specimen::skull));
    SearchSettings settings = carving();
    settings.stop.min_cuts = 3;
    EvaluationCache cache(settings.objectives, settings.candidates);
    const auto on_round = [&](const Segmentation& s) {
        const Cut& cut = s.cuts.back();
        EXPECT_GT(cut.chosen.terms.unreachable, 0);
        if (s.cuts.size() < 3) return;
        // The piece that was cut had more out of reach than those that were left.
        EXPECT_EQ(s.pieces.size(), 4U);
    };
    const SearchEnd end = search(segmentation, settings, cache, {}, on_round, {});
    double cost = 0;
    for (const Cut& cut : segmentation.cuts) {
        const Terms& t = cut.chosen.terms;
        cost += 0.05 * t.face_ratio + t.fragility + 0.3 * t.piece_count;
    }
    double unreachable = 0;
    for (const Piece& piece : segmentation.pieces) unreachable += area_on_best_base(piece, 60).unreachable_mm2;
    cost += 100 * unreachable / scan_area_mm2(segmentation.pieces[0]);
    EXPECT_NEAR(end.cost, cost, 1e-9);
}

TEST(AccessRank, IsTheSameForAnyNumberOfThreads) {
    const SearchSettings settings = carving();
    const auto ranking = [&] {
        EvaluationCache cache(settings.objectives, settings.candidates);
        return rank(sampled(bone(Specimen::vertebra)), 0, settings, cache, {});
    };
    const std::vector<Ranked> several = ranking();
    const ThreadLimit one(1);
    EXPECT_EQ(ranking(), several);
}

}  // namespace
}  // namespace qchopper
