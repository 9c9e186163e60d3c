#include "segment/score/candidates.h"

#include <gtest/gtest.h>

#include "base/parallel.h"
#include "segment/cut/nudge.h"
#include "segment/score/evaluate.h"
#include "tests/pieces.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

TEST(Candidates, FortyOffsetsEvenlyInsideTheExtentOfThreeNormals) {
    const Piece piece = piece_of(shapes::torus({0, 0, 0}, 40, 12));
    const std::vector<Candidate> all = candidate_planes(piece, {});
    ASSERT_EQ(all.size(), 120U);
    for (const Candidate& c : all) {
        const Extent range = extent(*piece.mesh, c.plane.normal);
        EXPECT_DOUBLE_EQ(c.wanted_offset, range.low + range.size() * (c.offset_index + 1) / 41);
        EXPECT_NEAR(c.plane.offset, c.wanted_offset, 1e-7 * range.size());
        EXPECT_EQ(canonical(c.plane), c.plane);
    }
}

TEST(Candidates, EvaluationsComeInTheOrderOfTheCandidates) {
    const TriangleMesh mesh = shapes::linked_tori();
    const Piece piece = piece_of(mesh);
    const std::vector<Candidate> some = candidates_along(piece, {0, 0, 1}, 0, 9);
    const auto evaluations = evaluate_all(piece, some, {}, {});
    for (std::size_t i = 0; i < some.size(); ++i) {
        const auto alone = evaluate_by_cutting(piece, some[i].plane, {});
        ASSERT_EQ(evaluations[i].has_value(), alone.has_value());
        EXPECT_NEAR(evaluations[i]->fragility, alone->fragility, 1e-9);
        EXPECT_NEAR(evaluations[i]->cap_area_mm2, alone->cap_area_mm2, 1e-6);
    }
}

TEST(Candidates, EvaluationsAreTheSameToTheLastBitForAnyNumberOfThreads) {
    const TriangleMesh mesh = shapes::joined({shapes::nested(), shapes::torus({200, 0, 0}, 40, 12, 90)});
    const Piece piece = piece_of(mesh);
    const std::vector<Candidate> all = candidate_planes(piece, {});
    const auto evaluate_with = [&](std::size_t threads, FragilityForm form) {
        const ThreadLimit limit(threads);
        Objectives objectives;
        objectives.fragility_form = form;
        return evaluate_all(piece, all, objectives, {});
    };
    for (const FragilityForm form : {FragilityForm::thinness, FragilityForm::thesis}) {
        const auto one = evaluate_with(1, form);
        for (const std::size_t threads : {2, 3}) {
            const auto many = evaluate_with(threads, form);
            ASSERT_EQ(many.size(), one.size());
            for (std::size_t i = 0; i < one.size(); ++i) {
                ASSERT_EQ(many[i].has_value(), one[i].has_value());
                if (!one[i]) continue;
                EXPECT_EQ(many[i]->fragility, one[i]->fragility);
                EXPECT_EQ(many[i]->cap_area_mm2, one[i]->cap_area_mm2);
                ASSERT_EQ(many[i]->solids.size(), one[i]->solids.size());
                for (std::size_t s = 0; s < one[i]->solids.size(); ++s) {
                    EXPECT_EQ(many[i]->solids[s].volume_mm3, one[i]->solids[s].volume_mm3);
                    EXPECT_EQ(undercut(many[i]->solids[s], true), undercut(one[i]->solids[s], true));
                }
            }
        }
    }
}

TEST(Candidates, EvaluationStopsWhenAsked) {
    const TriangleMesh mesh = shapes::ball({0, 0, 0}, 10);
    const std::atomic<bool> stop{true};
    Context context;
    context.cancelled = &stop;
    const Piece piece = piece_of(mesh);
    EXPECT_THROW(evaluate_all(piece, candidates_along(piece, {0, 0, 1}, 0, 9), {}, context), Cancelled);
}

}  // namespace
}  // namespace qchopper
