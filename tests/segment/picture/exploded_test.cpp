#include "segment/picture/exploded.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "segment/cut/cut_piece.h"
#include "segment/mesh/measure.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

std::vector<Piece> pieces_of(const TriangleMesh& mesh) {
    std::vector<Piece> pieces{{"A", std::make_shared<TriangleMesh>(mesh), {}}};
    const Vec3 middle = bounds(mesh).centre();
    const std::vector<Vec3> normals{{0.61, 0.31, 0.83}, {0.83, -0.47, 0.23}, {0.29, 0.93, -0.11}};
    for (std::size_t cut = 0; cut < normals.size(); ++cut) {
        const Plane plane = canonical({normals[cut], dot(normals[cut], middle) + 0.01317});
        std::vector<Piece> next;
        for (const Piece& piece : pieces) {
            const auto fallen = cut_piece(piece, plane, static_cast<std::int32_t>(cut));
            if (!fallen) next.push_back(piece);
            if (fallen) next.insert(next.end(), fallen->pieces.begin(), fallen->pieces.end());
        }
        pieces = next;
    }
    return pieces;
}

double lowest(const TriangleMesh& mesh, Vec3 normal) {
    double low = 1e300;
    for (const Vec3& p : mesh.points) low = std::min(low, dot(normal, p));
    return low;
}

// Clear air along the normal of a cut between a piece above it and one below it.
double air(const Piece& above, Vec3 moved_up, const Piece& below, Vec3 moved_down, Vec3 normal) {
    return lowest(*above.mesh, normal) + dot(normal, moved_up) +
           (lowest(*below.mesh, -normal) - dot(normal, moved_down));
}

TEST(Exploded, NeighboursOnTheTwoSidesOfACutSeparate) {
    int pairs = 0;
    for (const shapes::Named& shape : shapes::all_closed()) {
        const std::vector<Piece> pieces = pieces_of(shape.mesh);
        const std::vector<Vec3> shifts = exploded_shifts(pieces);
        ASSERT_EQ(shifts.size(), pieces.size());
        for (std::size_t i = 0; i < pieces.size(); ++i) {
            for (std::size_t k = 0; k < pieces.size(); ++k) {
                for (const HalfSpace& a : pieces[i].half_spaces) {
                    for (const HalfSpace& b : pieces[k].half_spaces) {
                        if (a.cut != b.cut || !a.above || b.above) continue;
                        ++pairs;
                        const Vec3 n = a.plane.normal;
                        const double before = air(pieces[i], {}, pieces[k], {}, n);
                        const double after = air(pieces[i], shifts[i], pieces[k], shifts[k], n);
                        EXPECT_GT(after, before) << shape.name;
                        EXPECT_GT(after, 0) << shape.name;
                    }
                }
            }
        }
    }
    EXPECT_GT(pairs, 50);
}

TEST(Exploded, EqualHalvesOpenByTheWantedGap) {
    const Piece whole{"A", std::make_shared<TriangleMesh>(shapes::box({0, 0, 0}, {10, 10, 10}, 3)), {}};
    const auto halves = cut_piece(whole, {{0, 0, 1}, 5.01}, 0);
    ASSERT_TRUE(halves);
    ExplodeOptions options;
    options.gap = 0.2;
    options.min_factor = 0;
    const std::vector<Vec3> shifts = exploded_shifts(halves->pieces, options);
    EXPECT_NEAR(shifts[0].z - shifts[1].z, 0.2 * std::sqrt(300), 1e-9);
}

TEST(Exploded, OnePieceStaysNearlyWhereItIs) {
    const std::vector<Piece> one{{"A", std::make_shared<TriangleMesh>(shapes::ball({5, 5, 5}, 3)), {}}};
    EXPECT_LT(norm(exploded_shifts(one)[0]), 1e-9);
    EXPECT_TRUE(exploded_shifts({}).empty());
}

TEST(Exploded, PiecesTakeTheirColourAndShift) {
    const std::vector<Piece> pieces = pieces_of(shapes::ball({0, 0, 0}, 3));
    const std::vector<Vec3> shifts = exploded_shifts(pieces);
    const std::vector<ColouredMesh> apart = coloured(pieces, shifts);
    const std::vector<ColouredMesh> together = coloured(pieces);
    ASSERT_EQ(apart.size(), pieces.size());
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        EXPECT_EQ(apart[i].mesh, pieces[i].mesh.get());
        EXPECT_EQ(apart[i].colour, piece_colour(i));
        EXPECT_EQ(apart[i].shift, shifts[i]);
        EXPECT_EQ(together[i].shift, Vec3{});
    }
}

}  // namespace
}  // namespace qchopper
