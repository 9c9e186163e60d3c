#include "segment/score/candidates.h"

#include <gtest/gtest.h>

#include "segment/cut/nudge.h"
#include "segment/score/pricing.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

Piece piece_of(TriangleMesh mesh) {
    Piece piece;
    piece.mesh = std::make_shared<const TriangleMesh>(std::move(mesh));
    return piece;
}

TEST(Candidates, FortyOffsetsEvenlyInsideTheExtentOfThreeNormals) {
    const Piece piece = piece_of(shapes::torus({0, 0, 0}, 40, 12));
    const std::vector<Candidate> all = candidate_planes(piece, {});
    ASSERT_EQ(all.size(), 120U);
    for (const Candidate& c : all) {
        const Extent range = extent(*piece.mesh, c.plane.normal);
        EXPECT_DOUBLE_EQ(c.wanted_offset, range.low + range.size() * (c.offset + 1) / 41);
        EXPECT_NEAR(c.plane.offset, c.wanted_offset, 1e-7 * range.size());
        EXPECT_EQ(canonical(c.plane), c.plane);
    }
}

TEST(Candidates, PricesComeInTheOrderOfTheCandidates) {
    const TriangleMesh mesh = shapes::linked_tori();
    const Piece piece = piece_of(mesh);
    const std::vector<Candidate> some = candidates_along(piece, {0, 0, 1}, 0, 9);
    const auto prices = price_all(piece, some, {}, {});
    for (std::size_t i = 0; i < some.size(); ++i) {
        const auto alone = price_by_cutting(piece, some[i].plane, {});
        ASSERT_EQ(prices[i].has_value(), alone.has_value());
        EXPECT_NEAR(prices[i]->fragility, alone->fragility, 1e-9);
        EXPECT_NEAR(prices[i]->cap_area_mm2, alone->cap_area_mm2, 1e-6);
    }
}

TEST(Candidates, PricingStopsWhenAsked) {
    const TriangleMesh mesh = shapes::ball({0, 0, 0}, 10);
    const std::atomic<bool> stop{true};
    Context context;
    context.cancelled = &stop;
    const Piece piece = piece_of(mesh);
    EXPECT_THROW(price_all(piece, candidates_along(piece, {0, 0, 1}, 0, 9), {}, context), Cancelled);
}

}  // namespace
}  // namespace qchopper
