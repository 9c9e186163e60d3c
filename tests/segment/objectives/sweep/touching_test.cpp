// Solids that touch themselves and each other: the sweep predicts what the cut makes, and no cap is folded.

#include "tests/segment/objectives/sweep/touching.h"

#include <gtest/gtest.h>

#include <cmath>

#include "segment/cut/cut.h"
#include "segment/mesh/connectivity/edges.h"
#include "tests/pieces.h"
#include "tests/reference/segment/objectives/evaluate_by_cutting.h"
#include "tests/segment/objectives/sweep/same_evaluation.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

// The invariants of a cut through solids that touch but do not cross.
void expect_flat_caps(const TriangleMesh& mesh, const Plane& plane, const std::string& what) {
    const auto halves = cut(mesh, plane, 1);
    if (!halves) return;
    const double size = norm(bounds(mesh).size());
    EXPECT_EQ(halves->forced_regions, 0U) << what;
    EXPECT_EQ(crossing_regions(mesh, plane), 0U) << what;
    EXPECT_TRUE(edges(halves->above.mesh).faults.is_closed()) << what;
    EXPECT_TRUE(edges(halves->below.mesh).faults.is_closed()) << what;
    EXPECT_NEAR((volume_mm3(halves->above.mesh) + volume_mm3(halves->below.mesh)) / volume_mm3(mesh), 1, 1e-9) << what;
    double covered = 0;
    double folded = 0;
    for (std::size_t t = halves->below.first_cap_triangle; t < halves->below.mesh.triangles.size(); ++t) {
        const double area = dot(area_vector(halves->below.mesh, t), plane.normal);
        covered += std::max(area, 0.0);
        folded += std::max(-area, 0.0);
    }
    EXPECT_NEAR(covered, halves->cap_area_mm2, 1e-9 * size * size) << what;
    EXPECT_NEAR(folded, 0, 1e-9 * size * size) << what;
}

// Evenly spread planes and planes asked through points of contact.
void expect_invariants(const TriangleMesh& mesh, Vec3 normal, std::mt19937& random, const std::string& what) {
    const Piece piece = piece_of(mesh);
    const Extent range = extent(mesh, normal);
    std::vector<double> wanted;
    for (int i = 1; i < 8; ++i) wanted.push_back(range.low + range.size() * i / 8);
    for (int i = 0; i < 5; ++i) wanted.push_back(height(normal, mesh.points[random() % mesh.points.size()]));
    Objectives objectives;
    objectives.undercut_by_area = random() % 2 == 0;
    expect_same(piece, normal, wanted, objectives, what);
    const double size = norm(bounds(mesh).size());
    for (const auto& nudged : nudge(piece, normal, wanted)) {
        if (!nudged) continue;
        const auto evaluation = evaluate_by_cutting(piece, {normal, nudged->offset}, objectives);
        if (!evaluation) continue;
        for (const SolidEvaluation& solid : evaluation->solids)
            EXPECT_GE(solid.volume_mm3, -1e-9 * size * size * size) << what;
    }
    for (const auto& nudged : nudge(piece, normal, wanted)) {
        if (nudged) expect_flat_caps(mesh, {normal, nudged->offset}, what);
    }
}

// Sparse grids have many edges and corners in common, dense ones cavities that touch each other and the outside;
// walls make coincident faces. Planes square to the grid's axes run along faces, others do not.
TEST(Touching, TheSweepPredictsTheCutAndNoCapIsFolded) {
    std::mt19937 random(1);
    for (int round = 0; round < 120; ++round) {
        const double share_full = std::array{0.5, 0.85, 0.97}[static_cast<std::size_t>(round % 3)];
        const double share_walls = std::array{0.0, 0.3}[static_cast<std::size_t>(round / 3 % 2)];
        TriangleMesh mesh = touching::mesh_of(random, touching::random_grid(random, 4, share_full, share_walls));
        ASSERT_TRUE(edges(mesh).faults.is_closed());
        Vec3 axis{0, 0, 1};
        if (round % 2 == 1) {
            const Vec3 about = random_normal(random);
            mesh = shapes::rotated(mesh, about, 0.7);
            axis = canonical({normalized(area_vector(mesh, random() % mesh.triangles.size())), 0}).normal;
        }
        const std::string what = "round " + std::to_string(round);
        expect_invariants(mesh, axis, random, what + " along");
        expect_invariants(mesh, random_normal(random), random, what + " across");
        expect_invariants(mesh, random_normal(random), random, what + " across again");
        if (HasFailure()) return;
    }
}

// Where solids cross no answer is right, but the sweep and the cut give the same: pieces, faces and bases.
TEST(Touching, WhereSolidsCrossTheSweepPredictsTheCutToo) {
    std::mt19937 random(2);
    std::uniform_real_distribution<double> place(-8, 8);
    int planes_that_cross = 0;
    const auto somewhere = [&] { return Vec3{place(random), place(random), place(random)}; };
    for (int round = 0; round < 40; ++round) {
        std::vector<TriangleMesh> parts{shapes::box({-12, -12, -12}, {12, 12, 12}, 3)};
        for (int i = 0; i < 6; ++i) {
            TriangleMesh part = i % 3 == 0   ? shapes::ball(somewhere(), 3 + i, 8)
                                : i % 3 == 1 ? shapes::torus(somewhere(), 6, 2, 10)
                                             : shapes::rotated(shapes::box({-2, -3, -4}, somewhere(), 2), {1, 1, 0}, i);
            if (random() % 2 == 0) part = shapes::turned_inside_out(part);
            parts.push_back(std::move(part));
        }
        const Piece piece = piece_of(shapes::joined(parts));
        const Vec3 normal = random_normal(random);
        std::vector<double> wanted;
        for (int i = -11; i < 12; ++i) wanted.push_back(i);
        expect_same(piece, normal, wanted, {}, "crossing, round " + std::to_string(round));
        for (const double offset : wanted) {
            const auto halves = cut(*piece.mesh, {normal, offset}, 1);
            const std::size_t crossing = crossing_regions(*piece.mesh, {normal, offset});
            EXPECT_EQ(crossing, halves ? halves->forced_regions : 0);
            if (crossing > 0) ++planes_that_cross;
        }
        if (HasFailure()) return;
    }
    EXPECT_GT(planes_that_cross, 100);
}

}  // namespace
}  // namespace qchopper
