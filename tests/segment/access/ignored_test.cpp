// Surface that may stay: what lies inside, and what is left of A and U without it.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "segment/access/access_sweep.h"
#include "segment/access/inside.h"
#include "segment/access/piece_access.h"
#include "segment/access/sampled_piece.h"
#include "segment/cut/cut_piece.h"
#include "tests/cam/setup/solids.h"
#include "tests/pieces.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

Vec3 middle_of(const TriangleMesh& mesh, std::size_t t) {
    const auto p = corners_of(mesh, t);
    return (1.0 / 3) * (p[0] + p[1] + p[2]);
}

template <class Test>
TriangleMesh ignored_where(TriangleMesh mesh, const Test& test) {
    mesh.ignored.clear();
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) mesh.ignored.push_back(test(middle_of(mesh, t)) ? 1 : 0);
    return mesh;
}

double counted_area_of(const TriangleMesh& mesh) {
    double area = 0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        if (!is_ignored(mesh, t) && cap_of(mesh, t) == no_cap) area += norm(area_vector(mesh, t));
    }
    return area;
}

Piece sampled_piece(TriangleMesh mesh) {
    std::vector<Piece> pieces{piece_of(std::move(mesh))};
    sample_uncut(pieces, {}, 4'000);
    return pieces.front();
}

// Of a box with a smaller one as a cavity: the outer and the inner sides.
TriangleMesh hollow_box(int n) {
    return shapes::joined({shapes::box({0, 0, 0}, {100, 100, 100}, n),
                           shapes::turned_inside_out(shapes::box({10, 10, 10}, {90, 90, 90}, n))});
}

bool lies_in_the_cavity(Vec3 p) {
    return std::max({std::abs(p.x - 50), std::abs(p.y - 50), std::abs(p.z - 50)}) < 45;
}

TEST(Ignored, AHalfOfABallLeavesTheOtherHalf) {
    const TriangleMesh ball = shapes::ball({0, 0, 0}, 50, 32);
    const auto below = [](Vec3 p) { return p.z < 0; };
    const auto above = [](Vec3 p) { return p.z > 0; };
    // Straight up alone the upper half is reached but for its steep rim, and nothing of the lower one.
    const std::array<Vec3, 3> axes{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    for (const bool keeps_above : {true, false}) {
        const TriangleMesh mesh = keeps_above ? ignored_where(ball, below) : ignored_where(ball, above);
        const Piece piece = sampled_piece(mesh);
        const double area = counted_area_of(mesh);
        EXPECT_NEAR(scan_area_mm2(piece), area, 1e-9 * area);
        EXPECT_NEAR(piece.samples->judged().area_mm2(), area, 1e-9 * area);
        const UnreachableArea up = unreachable_area(piece.samples->judged(), {axes[2], {}}, 0);
        EXPECT_NEAR(up.hidden_mm2 + up.steep_mm2, keeps_above ? up.steep_mm2 : area, 1e-9 * area);
        for (const SurfaceSample& s : piece.samples->scan->samples.sample) {
            EXPECT_FALSE(is_ignored(*piece.mesh, s.triangle));
        }
    }
}

TEST(Ignored, IsHandedOnByCuts) {
    const TriangleMesh ball =
        ignored_where(shapes::ball({0, 0, 0}, 50, 32), [](Vec3 p) { return p.x > 5 && p.z > -20; });
    const Piece whole = sampled_piece(ball);
    const auto made = cut_piece(whole, {{0.6, 0, 0.8}, 3.7}, 1);
    ASSERT_TRUE(made.has_value());
    double counted = 0;
    for (std::size_t i = 0; i < made->pieces.size(); ++i) {
        const TriangleMesh& mesh = *made->pieces[i].mesh;
        ASSERT_TRUE(is_consistent(mesh));
        ASSERT_FALSE(mesh.ignored.empty());
        counted += counted_area_of(mesh);
        for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
            const std::uint32_t parent = made->parent[i][t];
            EXPECT_EQ(is_ignored(mesh, t), parent != no_parent && is_ignored(*whole.mesh, parent));
        }
        const PieceAccess access = piece_access(made->pieces[i], bases_of(made->pieces[i]), {});
        const double caps = access.samples->caps.front().area_mm2;
        EXPECT_NEAR(access.samples->judged().area_mm2() - caps, counted_area_of(mesh), 1e-6);
    }
    EXPECT_NEAR(counted, counted_area_of(ball), 1e-6 * counted);
}

TEST(Ignored, APieceMayHaveNoSurfaceLeft) {
    const TriangleMesh ball = ignored_where(shapes::ball({0, 0, 0}, 50, 32), [](Vec3 p) { return p.z > -10; });
    const Piece whole = sampled_piece(ball);
    auto made = cut_piece(whole, {{0, 0, 1}, 1.3}, 1);
    ASSERT_TRUE(made.has_value());
    sample_parts(whole, *made);
    const Piece& top = made->pieces.front();
    EXPECT_EQ(counted_area_of(*top.mesh), 0);
    EXPECT_TRUE(top.samples->accessibility.sample.empty());
    EXPECT_EQ(area_on_best_base(top, 60).unreachable_mm2, 0);
    const CutAccess access = cut_access(top, {{1, 0, 0}, 2.1}, 60);
    EXPECT_GE(access.unreachable_mm2, 0);
    EXPECT_TRUE(std::isfinite(access.unreachable_mm2));
    const PieceAccess own = piece_access(top, bases_of(top), {});
    EXPECT_EQ(own.best().share(), 0);
    EXPECT_EQ(own.best().unreachable_mm2, 0);
}

TEST(Inside, OfAHollowBoxIsItsCavity) {
    for (const int n : {1, 7}) {
        const TriangleMesh mesh = hollow_box(n);
        const std::vector<std::uint8_t> inside = inside_surface(mesh, {}, 3'000);
        ASSERT_EQ(inside.size(), mesh.triangles.size());
        for (std::size_t t = 0; t < inside.size(); ++t) {
            EXPECT_EQ(inside[t] != 0, lies_in_the_cavity(middle_of(mesh, t))) << t << " of " << n;
        }
    }
}

// Few samples: most triangles follow their neighbours.
TEST(Inside, SpreadsAlongTheSurface) {
    const TriangleMesh mesh = hollow_box(40);
    const std::vector<std::uint8_t> inside = inside_surface(mesh, {}, 500);
    for (std::size_t t = 0; t < inside.size(); ++t) {
        EXPECT_EQ(inside[t] != 0, lies_in_the_cavity(middle_of(mesh, t))) << t;
    }
}

// A room of 80 mm behind a door of 10 mm: the wall across the door is in sight, its corners beside it are not.
TEST(Inside, AnOpeningShowsWhatLiesBehindIt) {
    const std::vector<double> at = test_pieces::steps(0, 100, 5);
    const TriangleMesh mesh = test_pieces::cell_solid(at, at, at, [](Vec3 p) {
        const bool is_room = std::max({std::abs(p.x - 50), std::abs(p.y - 50), std::abs(p.z - 50)}) < 40;
        const bool is_door = p.z > 80 && std::max(std::abs(p.x - 50), std::abs(p.y - 50)) < 5;
        return !is_room && !is_door;
    });
    const std::vector<std::uint8_t> inside = inside_surface(mesh, {}, 40'000);
    for (std::size_t t = 0; t < inside.size(); ++t) {
        const Vec3 p = middle_of(mesh, t);
        if (!lies_in_the_cavity(p)) {
            EXPECT_EQ(inside[t], 0) << "outside or in the door";
        }
        const bool is_under_the_door = p.z < 11 && std::max(std::abs(p.x - 50), std::abs(p.y - 50)) < 3;
        if (is_under_the_door) {
            EXPECT_EQ(inside[t], 0);
        }
        const bool is_beside_the_door = p.z > 89 && p.z < 91 && std::abs(p.x - 50) > 10;
        if (is_beside_the_door) {
            EXPECT_EQ(inside[t], 1) << p.x << " " << p.y;
        }
    }
}

// A ball in the cavity is a solid of its own, which is carved apart from the box.
TEST(Inside, OfOneSolidIsNotHiddenByAnother) {
    const TriangleMesh box = hollow_box(5);
    const std::size_t of_box = box.triangles.size();
    const TriangleMesh mesh = shapes::joined({box, shapes::ball({50, 50, 50}, 20, 12)});
    const std::vector<std::uint8_t> inside = inside_surface(mesh, {}, 4'000);
    for (std::size_t t = 0; t < inside.size(); ++t) {
        EXPECT_EQ(inside[t] != 0, t < of_box && lies_in_the_cavity(middle_of(mesh, t))) << t;
    }
}

TEST(Inside, OfConvexSolidsIsNothing) {
    for (const TriangleMesh& mesh : {shapes::box({0, 0, 0}, {10, 20, 30}, 3), shapes::ball({0, 0, 0}, 5, 20)}) {
        const std::vector<std::uint8_t> inside = inside_surface(mesh, {}, 5'000);
        EXPECT_EQ(std::count(inside.begin(), inside.end(), 1), 0);
    }
    EXPECT_TRUE(inside_surface({}).empty());
}

TEST(Inside, IsTheSameForAnyNumberOfThreads) {
    const TriangleMesh mesh = shapes::torus({0, 0, 0}, 20, 15, 48);
    const std::vector<std::uint8_t> all = inside_surface(mesh, {}, 2'000);
    const ThreadLimit one(1);
    EXPECT_EQ(inside_surface(mesh, {}, 2'000), all);
}

}  // namespace
}  // namespace qchopper
