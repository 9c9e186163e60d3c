#include "segment/cut/cut.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <random>

#include "base/error.h"
#include "segment/cut/cut_piece.h"
#include "segment/cut/nudge.h"
#include "segment/io/read_mesh.h"
#include "segment/mesh/connectivity/edges.h"
#include "segment/mesh/measure.h"
#include "tests/pieces.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

// The invariants of one cut. Returns the number of pieces, 0 if the plane misses.
std::size_t expect_invariants(const Piece& piece, const Plane& plane, const std::string& what) {
    const std::optional<CutHalves> halves = cut(*piece.mesh, plane, 7);
    const std::optional<CutPieces> pieces = cut_piece(piece, plane, 7);
    EXPECT_EQ(halves.has_value(), pieces.has_value()) << what;
    if (!halves || !pieces) return 0;
    const Half& above = halves->above;
    const Half& below = halves->below;
    EXPECT_TRUE(edges(above.mesh).faults.is_closed()) << what;
    EXPECT_TRUE(edges(below.mesh).faults.is_closed()) << what;
    const double whole = volume_mm3(*piece.mesh);
    EXPECT_NEAR((volume_mm3(above.mesh) + volume_mm3(below.mesh)) / whole, 1, 1e-9) << what;

    const std::size_t caps = above.mesh.triangles.size() - above.first_cap_triangle;
    EXPECT_EQ(below.mesh.triangles.size() - below.first_cap_triangle, caps) << what;
    double cap_area = 0;
    for (std::size_t i = 0; i < caps; ++i) {
        const Triangle& a = above.mesh.triangles[above.first_cap_triangle + i];
        const Triangle& b = below.mesh.triangles[below.first_cap_triangle + i];
        EXPECT_EQ(above.mesh.points[a[0]], below.mesh.points[b[0]]) << what;
        EXPECT_EQ(above.mesh.points[a[1]], below.mesh.points[b[2]]) << what;
        EXPECT_EQ(above.mesh.points[a[2]], below.mesh.points[b[1]]) << what;
        EXPECT_EQ(above.mesh.cap_of[above.first_cap_triangle + i], 7) << what;
        EXPECT_EQ(above.parent[above.first_cap_triangle + i], no_parent) << what;
        cap_area += dot(area_vector(below.mesh, below.first_cap_triangle + i), plane.normal);
    }
    const double size = norm(bounds(*piece.mesh).size());
    EXPECT_NEAR(cap_area, halves->cap_area_mm2, 1e-9 * size * size) << what;

    double sum = 0;
    std::size_t faces = 0;
    for (const Piece& p : pieces->pieces) {
        EXPECT_TRUE(edges(*p.mesh).faults.is_closed()) << what;
        EXPECT_EQ(p.half_spaces.back().cut, 7) << what;
        const Extent range = extent(*p.mesh, plane.normal);
        const double slack = 1e-9 * (size + std::abs(plane.offset));
        if (p.half_spaces.back().above)
            EXPECT_GE(range.low, plane.offset - slack) << what;
        else
            EXPECT_LE(range.high, plane.offset + slack) << what;
        sum += volume_mm3(*p.mesh);
        faces += p.mesh->triangles.size();
    }
    EXPECT_NEAR(sum / whole, 1, 1e-9) << what;
    EXPECT_EQ(faces, above.mesh.triangles.size() + below.mesh.triangles.size()) << what;
    EXPECT_GE(pieces->pieces.size(), 2U) << what;
    return pieces->pieces.size();
}

TEST(Cut, RandomPlanesOnEveryShapeKeepTheInvariants) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> share(0.02, 0.98);
    for (const auto& [name, mesh, solids] : shapes::all_closed()) {
        const Piece piece = piece_of(mesh);
        for (int round = 0; round < 150; ++round) {
            const Vec3 normal = random_normal(random);
            const Extent range = extent(mesh, normal);
            const double wanted = range.low + share(random) * range.size();
            const auto nudged = nudge(piece, normal, std::array{wanted});
            ASSERT_TRUE(nudged[0].has_value()) << name;
            expect_invariants(piece, {normal, nudged[0]->offset}, name + " round " + std::to_string(round));
        }
    }
}

// Offsets wanted exactly through vertices, through middles of edges and along flat faces, with normals along the axes,
// of faces and at random.
TEST(Cut, PlanesThroughVerticesEdgesAndFlatRegionsKeepTheInvariants) {
    std::mt19937 random(2);
    std::size_t cuts = 0;
    for (const auto& [name, mesh, solids] : shapes::all_closed()) {
        const Piece piece = piece_of(mesh);
        for (int round = 0; round < 150; ++round) {
            const Triangle& t = mesh.triangles[random() % mesh.triangles.size()];
            const Vec3 a = mesh.points[t[0]];
            const Vec3 b = mesh.points[t[1]];
            const Vec3 c = mesh.points[t[2]];
            Vec3 normal = round % 3 == 0
                              ? Vec3{round % 9 == 0 ? 1.0 : 0.0, round % 9 == 3 ? 1.0 : 0.0, round % 9 == 6 ? 1.0 : 0.0}
                          : round % 3 == 1 ? cross(b - a, c - a)
                                           : cross(b - a, random_normal(random));
            if (norm(normal) == 0) continue;
            normal = canonical({normalized(normal), 0}).normal;
            const double wanted = height(normal, round % 2 == 0 ? a : 0.5 * (a + b));
            const auto nudged = nudge(piece, normal, std::array{wanted});
            if (!nudged[0]) continue;
            if (expect_invariants(piece, {normal, nudged[0]->offset}, name + " round " + std::to_string(round)) > 0)
                ++cuts;
        }
    }
    EXPECT_GT(cuts, 500U);
}

TEST(Cut, PiecesOfPiecesKeepTheInvariantsAndTheirHalfSpaces) {
    std::mt19937 random(5);
    for (const auto& [name, mesh, solids] : shapes::all_closed()) {
        std::vector<Piece> pieces{piece_of(mesh)};
        const double whole = volume_mm3(mesh);
        for (std::int32_t number = 1; number <= 12; ++number) {
            std::size_t largest = 0;
            for (std::size_t i = 1; i < pieces.size(); ++i) {
                if (volume_mm3(*pieces[i].mesh) > volume_mm3(*pieces[largest].mesh)) largest = i;
            }
            const Vec3 normal = number % 3 == 0 ? Vec3{0, 0, 1} : random_normal(random);
            const Extent range = extent(*pieces[largest].mesh, normal);
            const auto nudged = nudge(pieces[largest], normal, std::array{range.low + 0.45 * range.size()});
            ASSERT_TRUE(nudged[0]) << name;
            auto made = cut_piece(pieces[largest], {normal, nudged[0]->offset}, number);
            ASSERT_TRUE(made) << name;
            pieces.erase(pieces.begin() + static_cast<std::ptrdiff_t>(largest));
            pieces.insert(pieces.end(), made->pieces.begin(), made->pieces.end());
        }
        double sum = 0;
        for (const Piece& p : pieces) {
            sum += volume_mm3(*p.mesh);
            EXPECT_TRUE(edges(*p.mesh).faults.is_closed()) << name;
            for (const HalfSpace& half_space : p.half_spaces) {  // the piece lies in every one of its half-spaces
                const Extent range = extent(*p.mesh, half_space.plane.normal);
                const double slack = 1e-9 * (std::abs(half_space.plane.offset) + range.size());
                if (half_space.above)
                    EXPECT_GE(range.low, half_space.plane.offset - slack);
                else
                    EXPECT_LE(range.high, half_space.plane.offset + slack);
            }
            for (std::size_t t = 0; t < p.mesh->triangles.size(); ++t) {
                const std::int32_t cap = p.mesh->cap_of[t];
                if (cap == no_cap) continue;
                EXPECT_TRUE(std::any_of(p.half_spaces.begin(), p.half_spaces.end(),
                                        [&](const HalfSpace& half_space) { return half_space.cut == cap; }));
            }
        }
        EXPECT_NEAR(sum / whole, 1, 1e-9) << name;
    }
}

TEST(Cut, ATorusAcrossItsAxisFallsIntoTwoAndAlongItIntoRings) {
    const Piece torus = piece_of(shapes::torus({0, 0, 0}, 40, 12, 24));
    const Plane across{{1, 0, 0}, 0.37};
    EXPECT_EQ(expect_invariants(torus, across, "across"), 2U);
    EXPECT_EQ(cut(*torus.mesh, across, 1)->loops, 2U);
    EXPECT_EQ(expect_invariants(torus, {{0, 0, 1}, 0.37}, "along"), 2U);
    EXPECT_EQ(expect_invariants(torus, {{1, 0, 0}, 35}, "a corner of the ring"), 2U);
    const Piece bent = piece_of(shapes::torus({0, 0, 0}, 40, 12, 24));
    EXPECT_EQ(expect_invariants(bent, {{1, 0, 0}, 29}, "just outside the hole"), 2U);
}

TEST(Cut, ACavityStaysWithItsSolidAndABallInsideItIsAPieceOfItsOwn) {
    const Piece piece = piece_of(shapes::nested());
    EXPECT_EQ(expect_invariants(piece, {{0, 0, 1}, 90.3}, "above the cavity"),
              3U);  // slab, box with cavity, ball inside
    EXPECT_EQ(expect_invariants(piece, {{0, 0, 1}, 50.3}, "through all"), 4U);
}

TEST(Cut, APlaneThatMissesIsAnAnswer) {
    const TriangleMesh ball = shapes::ball({0, 0, 0}, 10);
    EXPECT_FALSE(cut(ball, {{0, 0, 1}, 11}, 1).has_value());
    EXPECT_FALSE(cut(ball, {{0, 0, 1}, -11}, 1).has_value());
    EXPECT_FALSE(cut({}, {{0, 0, 1}, 0}, 1).has_value());
}

TEST(Cut, AnOpenMeshIsRefused) {
    TriangleMesh ball = shapes::ball({0, 0, 0}, 10);
    ball.triangles.resize(ball.triangles.size() / 2);
    EXPECT_THROW(cut(ball, {{1, 0, 0}, 0.123}, 1), InputError);
}

TEST(Cut, InputThatIntersectsItselfStillGivesClosedPieces) {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> place(-8, 8);
    const Piece piece =
        piece_of(shapes::joined({shapes::ball({0, 0, 0}, 10, 12), shapes::ball({7, 1, 0}, 9, 11),
                                 shapes::torus({2, 2, 2}, 8, 3, 14), shapes::box({-3, -3, -3}, {9, 4, 4}, 2)}));
    for (int round = 0; round < 300; ++round) {
        const Vec3 normal = random_normal(random);
        const auto nudged = nudge(piece, normal, std::array{place(random)});
        if (!nudged[0]) continue;
        const auto halves = cut(*piece.mesh, {normal, nudged[0]->offset}, 1);
        ASSERT_TRUE(halves);
        ASSERT_TRUE(edges(halves->above.mesh).faults.is_closed()) << round;
        ASSERT_TRUE(edges(halves->below.mesh).faults.is_closed()) << round;
        ASSERT_NEAR((volume_mm3(halves->above.mesh) + volume_mm3(halves->below.mesh)) / volume_mm3(*piece.mesh), 1,
                    1e-9);
    }
}

TEST(Cut, TheSameCutTwiceGivesTheSameBytes) {
    const TriangleMesh mesh = shapes::linked_tori();
    const Plane plane{normalized({1, 2, 3}), 4.321};
    const auto a = cut(mesh, plane, 1);
    const auto b = cut(mesh, plane, 1);
    EXPECT_EQ(a->above.mesh, b->above.mesh);
    EXPECT_EQ(a->below.mesh, b->below.mesh);
}

}  // namespace
}  // namespace qchopper
