#include "tests/reference/segment/objectives/evaluate_by_cutting.h"

#include <gtest/gtest.h>

#include <random>

#include "segment/cut/cut_piece.h"
#include "segment/cut/nudge.h"
#include "segment/mesh/measure.h"
#include "segment/search/candidates/evaluate.h"
#include "tests/pieces.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

TEST(Reference, AHalvedBoxHasNoUndercut) {
    const TriangleMesh box = shapes::box({0, 0, 0}, {10, 10, 10}, 2);
    const auto evaluation = evaluate_by_cutting(piece_of(box), {{0, 0, 1}, 4.0 + 1e-7}, {});
    ASSERT_TRUE(evaluation);
    ASSERT_EQ(evaluation->solids.size(), 2U);
    EXPECT_NEAR(evaluation->cap_area_mm2, 100, 1e-9);
    for (const SolidEvaluation& solid : evaluation->solids) {
        ASSERT_EQ(solid.bases.size(), 1U);
        EXPECT_NEAR(undercut(solid, true), 0, 1e-12);
        EXPECT_NEAR(undercut(solid, false), 0, 1e-12);
    }
    EXPECT_FALSE(evaluate_by_cutting(piece_of(box), {{0, 0, 1}, 40}, {}));
}

TEST(Reference, AFullBallOnASmallBaseIsHalfUndercut) {
    // Cut below the middle, the upper part overhangs: downward surface is the ring between equator and cut.
    const TriangleMesh ball = shapes::ball({0, 0, 0}, 10, 64);
    const auto evaluation = evaluate_by_cutting(piece_of(ball), {{0, 0, 1}, -6.001}, {});
    const SolidEvaluation& upper = evaluation->solids[0];
    // Projected: up-facing disc pi r^2, down-facing pi (r^2 - cap radius^2) with cap radius^2 = 64.
    EXPECT_NEAR(undercut(upper, true), 36.0 / (100 + 36), 2e-3);
    EXPECT_NEAR(undercut(evaluation->solids[1], true), 0, 1e-12);
}

// The evaluation of each solid of a cut equals the evaluation of the piece that the cut makes of it.
TEST(Reference, EvaluationsAgreeWithThePiecesThatTheCutMakes) {
    std::mt19937 random(4);
    std::normal_distribution<double> normal;
    for (const auto& [name, mesh, count] : shapes::all_closed()) {
        std::vector<Piece> pieces{piece_of(mesh)};
        for (std::int32_t number = 1; number <= 4; ++number) {
            const Piece piece = pieces[random() % pieces.size()];
            const Vec3 n = canonical({normalized({normal(random), normal(random), normal(random)}), 0}).normal;
            const Extent range = extent(*piece.mesh, n);
            const auto nudged = nudge(piece, n, std::array{range.low + 0.4 * range.size()});
            ASSERT_TRUE(nudged[0]);
            const Plane plane{n, nudged[0]->offset};
            const auto evaluation = evaluate_by_cutting(piece, plane, {});
            const auto made = cut_piece(piece, plane, number);
            ASSERT_EQ(evaluation->solids.size(), made->pieces.size()) << name;
            for (std::size_t i = 0; i < made->pieces.size(); ++i) {
                const SolidEvaluation own = measure(made->pieces[i]);
                EXPECT_EQ(evaluation->solids[i].faces, own.faces) << name;
                EXPECT_NEAR(evaluation->solids[i].volume_mm3, own.volume_mm3, 1e-9 * volume_mm3(mesh)) << name;
                ASSERT_EQ(evaluation->solids[i].bases.size(), own.bases.size()) << name;
                EXPECT_NEAR(undercut(evaluation->solids[i], true), undercut(own, true), 1e-9) << name;
            }
            pieces = made->pieces;
        }
    }
}

TEST(Reference, ByAreaTheUndercutOfAnyClosedSolidIsBelowOneHalf) {
    for (const auto& [name, mesh, count] : shapes::all_closed()) {
        const Extent range = extent(mesh, {1, 0, 0});
        const auto nudged = nudge(piece_of(mesh), {1, 0, 0}, std::array{range.low + 0.3 * range.size()});
        const auto evaluation = evaluate_by_cutting(piece_of(mesh), {{1, 0, 0}, nudged[0]->offset}, {});
        for (const SolidEvaluation& solid : evaluation->solids) {
            for (const BaseShare& base : solid.bases) EXPECT_LT(undercut(base, true), 0.5) << name;
        }
    }
}

}  // namespace
}  // namespace qchopper
