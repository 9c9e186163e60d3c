#include "segment/search/candidates/candidates.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/parallel.h"
#include "segment/cut/nudge.h"
#include "segment/search/candidates/evaluate.h"
#include "tests/pieces.h"
#include "tests/reference/segment/objectives/evaluate_by_cutting.h"
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

TEST(Candidates, OfTheSphereHaveThe129NormalsAndTheAxesOfTheBox) {
    const Piece piece = piece_of(shapes::rotated(shapes::box({0, 0, 0}, {90, 50, 20}, 4), {3, 1, 2}, 0.77));
    const OrientedBox box = oriented_box(piece.mesh->points);
    const std::vector<Vec3> normals = candidate_normals(box, CandidateNormals::sphere);
    ASSERT_EQ(normals.size(), 132U);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(normals[i], canonical({box.axis[i], 0}).normal);
    EXPECT_EQ(candidate_normals(box, CandidateNormals::box).size(), 3U);
    // A box along the axes of the world, and one turned by less and by more than half a degree.
    OrientedBox level{{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}, {0, 0, 0}, {1, 1, 1}};
    EXPECT_EQ(candidate_normals(level, CandidateNormals::sphere).size(), 129U);
    const auto turn_about_z = [&](double degrees) {
        const double angle = degrees * std::numbers::pi / 180;
        level.axis[0] = {std::cos(angle), std::sin(angle), 0};
        level.axis[1] = {-std::sin(angle), std::cos(angle), 0};
    };
    turn_about_z(0.49);
    EXPECT_EQ(candidate_normals(level, CandidateNormals::sphere).size(), 129U);
    turn_about_z(0.51);
    EXPECT_EQ(candidate_normals(level, CandidateNormals::sphere).size(), 131U);
}

TEST(Candidates, OffsetsAtStepsAreTheStepApartOrATwoHundredthOfTheExtent) {
    CandidateOptions options;
    options.offset_step_mm = 5;
    const std::vector<double> few = candidate_offsets({-10, 41}, options);
    ASSERT_EQ(few.size(), 10U);
    for (std::size_t k = 0; k < few.size(); ++k) EXPECT_DOUBLE_EQ(few[k], -10 + 5.0 * static_cast<double>(k + 1));
    const std::vector<double> many = candidate_offsets({0, 2'000}, options);
    ASSERT_EQ(many.size(), 199U);
    EXPECT_DOUBLE_EQ(many.front(), 10);
    EXPECT_DOUBLE_EQ(many.back(), 1'990);
    EXPECT_EQ(max_offsets(options), 199);
    EXPECT_TRUE(candidate_offsets({0, 4}, options).empty());
    EXPECT_TRUE(candidate_offsets({0, 5}, options).empty()) << "strictly inside";
}

TEST(Candidates, ABoxOfFourStepsIsCutAtEachOfThem) {
    const Piece piece = piece_of(shapes::box({0, 0, 0}, {400, 30, 20}, 3));
    CandidateOptions options;
    options.offset_step_mm = 100;
    const std::vector<Candidate> all = candidates_along(piece, {1, 0, 0}, 0, options);
    ASSERT_EQ(all.size(), 3U);
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(all[k].plane.offset, 100.0 * static_cast<double>(k + 1), 1e-4);
}

TEST(Candidates, AreOrderedByNormalThenOffset) {
    const Piece piece = piece_of(shapes::linked_tori());
    CandidateOptions options;
    options.normals = CandidateNormals::sphere;
    options.offsets_per_normal = 3;
    const std::vector<Candidate> all = candidate_planes(piece, options);
    EXPECT_GT(all.size(), 380U);
    for (std::size_t i = 1; i < all.size(); ++i) {
        EXPECT_LT(std::pair(all[i - 1].normal_index, all[i - 1].offset_index),
                  std::pair(all[i].normal_index, all[i].offset_index));
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
