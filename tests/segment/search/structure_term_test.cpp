// The term of structure among the others, and on pieces.

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>

#include "base/parallel.h"
#include "segment/access/sampled_piece.h"
#include "segment/search/candidates/evaluate.h"
#include "segment/search/rank_piece.h"
#include "segment/search/search.h"
#include "segment/structure/section_stress.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

StructureOptions foam() {
    StructureOptions o;
    o.up = {0, 0, 1};
    o.density_kg_per_m3 = 100;
    o.strength_mpa = 0.5;
    o.voxel_mm = 2;
    return o;
}

struct StructureTerm : ::testing::Test {
    TriangleMesh mesh = shapes::rotated(shapes::torus({0, 0, 0}, 30, 9), {1, 0, 0}, 1.3);
    Segmentation segmentation = uncut(mesh, 0);
    SearchSettings settings;
    std::shared_ptr<const StressedModel> stress = std::make_shared<const StressedModel>(stress_of(mesh, foam(), {}));
    void SetUp() override {
        settings.objectives.weights.structure = 3;
        settings.candidates.offsets_per_normal = 9;
        segmentation.pieces[0].stress = stress;
    }
    std::vector<Ranked> ranking(std::size_t piece) const {
        EvaluationCache cache(settings.objectives, settings.candidates);
        return rank(segmentation, piece, settings, cache, {});
    }
};

TEST_F(StructureTerm, OfEveryCandidateIsThatOfItsPlaneTimesTheWeight) {
    const std::vector<Ranked> with = ranking(0);
    settings.objectives.weights.structure = 0;
    const std::vector<Ranked> without = ranking(0);
    ASSERT_EQ(with.size(), without.size());
    const StressedPart part = stressed_part(stress, *segmentation.pieces[0].mesh);
    for (const Ranked& r : with) {
        const SectionStress wanted = section_stress(part, r.plane.normal, std::vector<double>{r.plane.offset})[0];
        EXPECT_GT(wanted.value, 0);
        EXPECT_NEAR(r.terms.structure, wanted.value, 1e-12 * wanted.value);
        EXPECT_EQ(r.coarse_sections, wanted.too_coarse);
        const auto same =
            std::find_if(without.begin(), without.end(), [&](const Ranked& o) { return o.plane == r.plane; });
        ASSERT_NE(same, without.end());
        EXPECT_EQ(same->terms.structure, 0) << "without a weight it is not evaluated";
        EXPECT_NEAR(r.terms.total, same->terms.total + 3 * wanted.value, 1e-12 * r.terms.total);
    }
}

TEST_F(StructureTerm, OfAPieceIsThatOfItsOwnVoxels) {
    Cut cut = cut_by(segmentation, 0, ranking(0), 0, settings);
    ASSERT_TRUE(apply(segmentation, cut, 0));
    ASSERT_GE(segmentation.pieces.size(), 2U);
    std::size_t voxels = 0;
    for (std::size_t p = 0; p < segmentation.pieces.size(); ++p) {
        const Piece& piece = segmentation.pieces[p];
        ASSERT_EQ(piece.stress, stress) << "pieces have the stress of the scan";
        const StressedPart part = stressed_part(stress, *piece.mesh);
        voxels += part.voxels.size();
        for (const Ranked& r : ranking(p)) {
            const double wanted = section_stress(part, r.plane.normal, std::vector<double>{r.plane.offset})[0].value;
            EXPECT_NEAR(r.terms.structure, wanted, 1e-12 * wanted);
        }
    }
    EXPECT_EQ(voxels, stress->voxels.size());
}

TEST_F(StructureTerm, AHeavyWeightTurnsTheCutAwayFromWhereTheModelIsStressed) {
    for (double* other : {&settings.objectives.weights.face_ratio, &settings.objectives.weights.fragility,
                          &settings.objectives.weights.piece_count, &settings.objectives.weights.undercut}) {
        *other = 0;
    }
    const std::vector<Ranked> ranked = ranking(0);
    for (const Ranked& r : ranked) EXPECT_GE(r.terms.structure, ranked.front().terms.structure - 1e-9);
    EXPECT_GT(ranked.back().terms.structure, 2 * ranked.front().terms.structure);
}

// Makes the cuts again: each term is that of its plane on the piece that it parts, evaluated alone.
void expect_terms_of_their_planes(Segmentation s, const std::vector<Cut>& cuts,
                                  const std::shared_ptr<const StressedModel>& stress, const std::string& what) {
    for (const Cut& cut : cuts) {
        const auto piece =
            std::find_if(s.pieces.begin(), s.pieces.end(), [&](const Piece& p) { return p.name == cut.piece; });
        ASSERT_NE(piece, s.pieces.end()) << what;
        const StressedPart part = stressed_part(stress, *piece->mesh);
        const Plane& plane = cut.chosen.plane;
        const SectionStress alone = section_stress(part, plane.normal, std::vector<double>{plane.offset})[0];
        EXPECT_GT(alone.value, 0) << what;
        EXPECT_NEAR(cut.chosen.terms.structure, alone.value, 1e-12 * alone.value) << what << " cut " << cut.number;
        EXPECT_EQ(cut.chosen.coarse_sections, alone.too_coarse) << what << " cut " << cut.number;
        ASSERT_TRUE(apply(s, cut, 0));
    }
}

struct Found {
    std::vector<Cut> cuts;
    double cost = 0;
    bool operator==(const Found&) const = default;
};

Found found_by(Segmentation s, const SearchSettings& settings, unsigned threads) {
    const ThreadLimit limit(threads);
    EvaluationCache cache(settings.objectives, settings.candidates);
    const SearchEnd end = search(s, settings, cache, {}, [](const Segmentation&) {}, {});
    return {s.cuts, end.cost};
}

// The three rankings: of all planes along the box, by reach, and with late terms.
std::vector<std::pair<std::string, SearchSettings>> rankings(SearchSettings settings) {
    settings.stop.min_cuts = 3;
    settings.objectives.scope = TermScope::cut;
    std::vector<std::pair<std::string, SearchSettings>> all{{"box", settings}, {"reach", settings}, {"late", settings}};
    all[1].second.objectives.weights.unreachable = 100;
    all[1].second.candidates.normals = CandidateNormals::sphere;
    all[2].second.objectives.weights.connector = 1;
    all[2].second.objectives.weights.symmetry = 0.25;
    all[2].second.objectives.connector = {ConnectorForm::spread, 3, 3, 1, 2};
    all[2].second.objectives.symmetry_plane = Plane{{1, 0, 0}, 2};
    return all;
}

TEST_F(StructureTerm, InEveryRankingAndBeamIsThatOfThePlaneAloneForAnyNumberOfThreads) {
    for (const auto& [name, of] : rankings(settings)) {
        for (const std::size_t beam : {std::size_t{1}, std::size_t{3}}) {
            SearchSettings own = of;
            own.beam = beam;
            Segmentation start = segmentation;
            if (own.takes_samples()) sample_uncut(start.pieces, {}, 800);
            if (own.measures_scan()) start.scan = measure_scan(start);
            const std::string what = name + ", beam " + std::to_string(beam);
            const Found found = found_by(start, own, 1);
            EXPECT_GE(found.cuts.size(), 3U) << what;
            EXPECT_TRUE(found_by(start, own, 4) == found) << what;
            expect_terms_of_their_planes(start, found.cuts, stress, what);
            own.objectives.weights.structure = 0;
            EXPECT_FALSE(found_by(start, own, 4) == found) << what << ": the term changes the search or its cost";
        }
    }
}

TEST_F(StructureTerm, WithoutStressIsZero) {
    segmentation.pieces[0].stress.reset();
    for (const Ranked& r : ranking(0)) EXPECT_EQ(r.terms.structure, 0);
}

}  // namespace
}  // namespace qchopper
