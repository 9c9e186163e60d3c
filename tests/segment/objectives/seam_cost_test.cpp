#include "segment/objectives/seam_cost.h"

#include <gtest/gtest.h>

#include "segment/mesh/order.h"
#include "tests/pieces.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

TEST(SeamCost, AConvexSolidIsSeenEverywhereAndACavityNowhere) {
    const TriangleMesh mesh = in_memory_order(
        shapes::joined({shapes::ball({0, 0, 0}, 100, 24), shapes::turned_inside_out(shapes::ball({0, 0, 0}, 60, 24))}));
    for (const std::size_t asked : {100'000U, 300U}) {
        std::vector<Piece> pieces{piece_of(mesh)};
        find_seam_costs(pieces, {}, asked);
        ASSERT_EQ(pieces[0].seam_cost->size(), mesh.points.size());
        for (std::size_t v = 0; v < mesh.points.size(); ++v) {
            EXPECT_EQ((*pieces[0].seam_cost)[v], norm(mesh.points[v]) > 80 ? 1 : 0) << asked;
        }
    }
}

TEST(SeamCost, PartsHaveTheValuesOfThePieceAndBetweenThem) {
    Piece piece = piece_of(shapes::torus({0, 0, 0}, 40, 15));
    std::vector<float> cost;
    for (const Vec3& p : piece.mesh->points) cost.push_back(static_cast<float>(0.5 + p.x / 200));  // linear
    piece.seam_cost = std::make_shared<const std::vector<float>>(cost);
    auto made = cut_piece(piece, {{0.6, 0.8, 0}, 7.3}, 1);
    pass_on_seam_costs(piece, *made);
    for (const Piece& part : made->pieces) {
        ASSERT_EQ(part.seam_cost->size(), part.mesh->points.size());
        for (std::size_t v = 0; v < part.mesh->points.size(); ++v) {
            EXPECT_NEAR((*part.seam_cost)[v], 0.5 + part.mesh->points[v].x / 200, 1e-6);
        }
    }
}

TEST(SeamCost, APieceWithoutValuesGivesNone) {
    const Piece piece = piece_of(shapes::box({0, 0, 0}, {10, 10, 10}));
    auto made = cut_piece(piece, {{0, 0, 1}, 5}, 1);
    pass_on_seam_costs(piece, *made);
    for (const Piece& part : made->pieces) EXPECT_EQ(part.seam_cost, nullptr);
}

}  // namespace
}  // namespace qchopper
