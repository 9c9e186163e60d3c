// The term of structure among the others, and on pieces.

#include <gtest/gtest.h>

#include <algorithm>

#include "segment/score/evaluate.h"
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
    Cut cut = cut_by(segmentation, 0, ranking(0), 0, 0);
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

TEST_F(StructureTerm, WithoutStressIsZero) {
    segmentation.pieces[0].stress.reset();
    for (const Ranked& r : ranking(0)) EXPECT_EQ(r.terms.structure, 0);
}

}  // namespace
}  // namespace qchopper
