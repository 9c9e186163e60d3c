#include "app/engine/work_project.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "tests/shapes.h"

namespace qchopper {
namespace {

// Cubes of these sides.
std::vector<Piece> cubes(const std::vector<double>& sides) {
    std::vector<Piece> pieces;
    for (const double side : sides) {
        Piece piece;
        piece.mesh = std::make_shared<TriangleMesh>(shapes::box({0, 0, 0}, {side, side, side}));
        pieces.push_back(std::move(piece));
    }
    return pieces;
}

TEST(Shards, EveryPieceIsInOneOfThem) {
    const std::vector<Piece> pieces = cubes({30, 10, 50, 20, 20, 40, 10});
    for (const std::size_t count : {1U, 2U, 3U, 7U, 9U}) {
        std::vector<std::size_t> all;
        for (std::size_t number = 0; number < count; ++number) {
            const std::vector<std::size_t> own = pieces_of({number, count}, pieces);
            all.insert(all.end(), own.begin(), own.end());
            EXPECT_EQ(own.empty(), number >= pieces.size());
        }
        std::sort(all.begin(), all.end());
        EXPECT_EQ(all, (std::vector<std::size_t>{0, 1, 2, 3, 4, 5, 6})) << count;
    }
}

// Areas of 25, 16, 9, 4, 4, 1, 1: halves of 30 are the best that there are.
TEST(Shards, AreBalancedByTheSurfaceOfTheBoxesTheLargestFirst) {
    const std::vector<Piece> pieces = cubes({30, 10, 50, 20, 20, 40, 10});
    EXPECT_EQ(pieces_of({0, 2}, pieces), (std::vector<std::size_t>{2, 3, 1}));
    EXPECT_EQ(pieces_of({1, 2}, pieces), (std::vector<std::size_t>{5, 0, 4, 6}));
}

}  // namespace
}  // namespace qchopper
