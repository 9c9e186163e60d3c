#include "segment/score/sweep.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "segment/cut/cut_piece.h"
#include "segment/cut/nudge.h"
#include "segment/mesh/measure.h"
#include "segment/score/candidates.h"
#include "segment/score/oracle.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

Piece piece_of(TriangleMesh mesh) {
    Piece piece;
    piece.name = "A";
    piece.mesh = std::make_shared<const TriangleMesh>(std::move(mesh));
    return piece;
}

Vec3 random_normal(std::mt19937& random) {
    std::normal_distribution<double> normal;
    return canonical({normalized({normal(random), normal(random), normal(random)}), 0}).normal;
}

// Solids have no order that both ways of pricing share.
std::vector<SolidPrice> sorted(std::vector<SolidPrice> solids) {
    std::sort(solids.begin(), solids.end(), [](const SolidPrice& a, const SolidPrice& b) {
        return std::tuple(a.above, a.faces, a.volume_mm3) < std::tuple(b.above, b.faces, b.volume_mm3);
    });
    return solids;
}

void expect_equal(const Price& fast, const Price& plain, double size, bool by_area, const std::string& what) {
    const double area = size * size;
    EXPECT_NEAR(fast.cap_area_mm2, plain.cap_area_mm2, 1e-9 * plain.cap_area_mm2 + 1e-13 * area) << what;
    EXPECT_NEAR(fast.fragility, plain.fragility, 1e-9 * (1 + plain.fragility) + 1e-13 * area / plain.cap_area_mm2)
        << what;
    ASSERT_EQ(fast.solids.size(), plain.solids.size()) << what;
    const auto a = sorted(fast.solids);
    const auto b = sorted(plain.solids);
    for (std::size_t i = 0; i < a.size(); ++i) {
        ASSERT_EQ(a[i].above, b[i].above) << what;
        ASSERT_EQ(a[i].faces, b[i].faces) << what;
        ASSERT_NEAR(a[i].volume_mm3, b[i].volume_mm3, 1e-9 * std::abs(b[i].volume_mm3) + 1e-12 * area * size) << what;
        ASSERT_EQ(a[i].bases.size(), b[i].bases.size()) << what;
        for (std::size_t k = 0; k < a[i].bases.size(); ++k) {
            ASSERT_EQ(a[i].bases[k].cut, b[i].bases[k].cut) << what;
            if (by_area)
                ASSERT_NEAR(a[i].bases[k].all_mm2, b[i].bases[k].all_mm2, 1e-9 * b[i].bases[k].all_mm2 + 1e-12 * area)
                    << what;
            else
                ASSERT_NEAR(a[i].bases[k].all_count, b[i].bases[k].all_count, 1e-9 * b[i].bases[k].all_count) << what;
            ASSERT_NEAR(undercut(a[i].bases[k], by_area), undercut(b[i].bases[k], by_area), 1e-9) << what;
        }
    }
}

// Every offset of a normal, priced by the sweep and by cutting.
std::size_t expect_same(const Piece& piece, const RayTree& rays, Vec3 normal, std::vector<double> wanted,
                        const Objectives& objectives, const std::string& what) {
    std::sort(wanted.begin(), wanted.end());
    std::vector<double> offsets;
    for (const auto& n : nudge(piece, normal, wanted)) {
        if (n && (offsets.empty() || n->offset > offsets.back())) offsets.push_back(n->offset);
    }
    if (offsets.empty()) return 0;
    const auto fast = sweep(prepare(piece, objectives), normal, offsets, objectives, rays);
    const double size = norm(bounds(*piece.mesh).size());
    for (std::size_t j = 0; j < offsets.size(); ++j) {
        const auto plain = price_by_cutting(piece, {normal, offsets[j]}, objectives, rays);
        EXPECT_EQ(fast[j].has_value(), plain.has_value()) << what;
        if (!plain || !fast[j]) continue;
        expect_equal(*fast[j], *plain, size, objectives.undercut_by_area, what + " offset " + std::to_string(j));
        if (::testing::Test::HasFatalFailure()) return j;
    }
    return offsets.size();
}

std::vector<double> even(const Piece& piece, Vec3 normal, int count) {
    const Extent range = extent(*piece.mesh, normal);
    std::vector<double> wanted;
    for (int k = 1; k <= count; ++k) wanted.push_back(range.low + range.size() * k / (count + 1));
    return wanted;
}

Objectives form(bool by_area, FragilityForm fragility) {
    Objectives o;
    o.undercut_by_area = by_area;
    o.fragility_form = fragility;
    return o;
}

TEST(Sweep, EqualsCuttingOnEveryShapeAlongRandomNormals) {
    std::mt19937 random(21);
    std::size_t planes = 0;
    for (const auto& [name, mesh, count] : shapes::all_closed()) {
        const Piece piece = piece_of(mesh);
        const RayTree rays(mesh);
        for (int round = 0; round < 6; ++round) {
            const Vec3 n = random_normal(random);
            const Objectives o = form(round % 2 == 0, round % 3 == 0 ? FragilityForm::thesis : FragilityForm::thinness);
            planes += expect_same(piece, rays, n, even(piece, n, 17), o, name + " round " + std::to_string(round));
        }
    }
    EXPECT_GT(planes, 900U);
}

TEST(Sweep, EqualsCuttingAtOffsetsAskedThroughVerticesEdgesAndFlatRegions) {
    std::mt19937 random(22);
    for (const auto& [name, mesh, count] : shapes::all_closed()) {
        const Piece piece = piece_of(mesh);
        const RayTree rays(mesh);
        for (int round = 0; round < 8; ++round) {
            Vec3 n{round == 0 ? 1.0 : 0.0, round == 1 ? 1.0 : 0.0, round == 2 ? 1.0 : 0.0};
            if (round > 2) {
                const std::size_t t = random() % mesh.triangles.size();
                if (norm(area_vector(mesh, t)) == 0) continue;
                n = canonical({normalized(area_vector(mesh, t)), 0}).normal;
            }
            std::vector<double> wanted;
            for (int k = 0; k < 12; ++k) {
                const Triangle& t = mesh.triangles[random() % mesh.triangles.size()];
                const Vec3 a = mesh.points[t[0]];
                wanted.push_back(height(n, k % 2 == 0 ? a : 0.5 * (a + mesh.points[t[1]])));
            }
            expect_same(piece, rays, n, wanted, form(round % 2 == 0, FragilityForm::thinness),
                        name + " round " + std::to_string(round));
        }
    }
}

TEST(Sweep, EqualsCuttingOnPiecesThatOwnCaps) {
    std::mt19937 random(23);
    for (const auto& [name, mesh, count] : shapes::all_closed()) {
        const RayTree rays(mesh);
        std::vector<Piece> pieces{piece_of(mesh)};
        for (std::int32_t cut_number = 1; cut_number <= 6; ++cut_number) {
            const std::size_t which = random() % pieces.size();
            const Piece piece = pieces[which];
            const Vec3 n = cut_number % 3 == 0 ? Vec3{0, 0, 1} : random_normal(random);
            const Extent range = extent(*piece.mesh, n);
            const auto nudged = nudge(piece, n, std::array{range.low + 0.37 * range.size()});
            if (!nudged[0]) continue;
            const auto made = cut_piece(piece, {n, nudged[0]->offset}, cut_number);
            pieces.erase(pieces.begin() + static_cast<std::ptrdiff_t>(which));
            pieces.insert(pieces.end(), made->pieces.begin(), made->pieces.end());
        }
        for (const Piece& piece : pieces) {
            for (int round = 0; round < 2; ++round) {
                const Vec3 n = round == 0 ? Vec3{0, 0, 1} : random_normal(random);
                expect_same(piece, rays, n, even(piece, n, 9), form(round == 0, FragilityForm::thinness), name);
            }
        }
    }
}

TEST(Sweep, ManyOffsetsAndOneOffsetAgree) {
    const TriangleMesh mesh = shapes::linked_tori();
    const Piece piece = piece_of(mesh);
    const RayTree rays(mesh);
    const Vec3 n = canonical({normalized({1, 2, -3}), 0}).normal;
    expect_same(piece, rays, n, even(piece, n, 400), {}, "400 offsets");
    for (const double wanted : even(piece, n, 7)) expect_same(piece, rays, n, {wanted}, {}, "one offset");
}

TEST(Sweep, UnevenOffsetsAreNoTrouble) {
    const TriangleMesh mesh = shapes::nested();
    const Piece piece = piece_of(mesh);
    std::vector<double> wanted;
    for (int i = 0; i < 30; ++i) wanted.push_back(100 * std::pow(0.7, i));
    expect_same(piece, RayTree(mesh), {0, 0, 1}, wanted, {}, "geometric offsets");
}

TEST(Sweep, FortyShellsAndCavitiesInsideOneAnother) {
    std::mt19937 random(5);
    std::vector<TriangleMesh> parts{shapes::box({0, 0, 0}, {200, 200, 200}, 3)};
    for (int i = 0; i < 27; ++i) {
        const Vec3 at{40.0 + 60 * (i % 3), 40.0 + 60 * (i / 3 % 3), 40.0 + 60 * (i / 9)};
        parts.push_back(shapes::turned_inside_out(shapes::ball(at, 18 + i % 5, 7)));
        if (i % 2 == 0) parts.push_back(shapes::torus(at, 9, 3, 9));
    }
    const TriangleMesh mesh = shapes::joined(parts);
    const Piece piece = piece_of(mesh);
    const RayTree rays(mesh);
    for (int round = 0; round < 6; ++round) {
        const Vec3 n = round == 0 ? Vec3{0, 0, 1} : random_normal(random);
        expect_same(piece, rays, n, even(piece, n, 21), form(round % 2 == 0, FragilityForm::thinness), "cavities");
    }
}

}  // namespace
}  // namespace qchopper
