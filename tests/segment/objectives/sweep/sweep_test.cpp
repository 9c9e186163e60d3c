#include "segment/objectives/sweep/sweep.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>

#include "segment/cut/cut_piece.h"
#include "segment/cut/nudge.h"
#include "segment/mesh/measure.h"
#include "segment/search/candidates/candidates.h"
#include "tests/pieces.h"
#include "tests/segment/objectives/sweep/same_evaluation.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

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
        for (int round = 0; round < 6; ++round) {
            const Vec3 n = random_normal(random);
            const Objectives o = form(round % 2 == 0, round % 3 == 0 ? FragilityForm::thesis : FragilityForm::thinness);
            planes += expect_same(piece, n, even(piece, n, 17), o, name + " round " + std::to_string(round));
        }
    }
    EXPECT_GT(planes, 900U);
}

TEST(Sweep, EqualsCuttingAtOffsetsAskedThroughVerticesEdgesAndFlatRegions) {
    std::mt19937 random(22);
    for (const auto& [name, mesh, count] : shapes::all_closed()) {
        const Piece piece = piece_of(mesh);
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
            expect_same(piece, n, wanted, form(round % 2 == 0, FragilityForm::thinness),
                        name + " round " + std::to_string(round));
        }
    }
}

TEST(Sweep, EqualsCuttingOnPiecesThatOwnCaps) {
    std::mt19937 random(23);
    for (const auto& [name, mesh, count] : shapes::all_closed()) {
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
                expect_same(piece, n, even(piece, n, 9), form(round == 0, FragilityForm::thinness), name);
            }
        }
    }
}

TEST(Sweep, ManyOffsetsAndOneOffsetAgree) {
    const TriangleMesh mesh = shapes::linked_tori();
    const Piece piece = piece_of(mesh);
    const Vec3 n = canonical({normalized({1, 2, -3}), 0}).normal;
    expect_same(piece, n, even(piece, n, 400), {}, "400 offsets");
    for (const double wanted : even(piece, n, 7)) expect_same(piece, n, {wanted}, {}, "one offset");
}

TEST(Sweep, UnevenOffsetsAreNoTrouble) {
    const TriangleMesh mesh = shapes::nested();
    const Piece piece = piece_of(mesh);
    std::vector<double> wanted;
    for (int i = 0; i < 30; ++i) wanted.push_back(100 * std::pow(0.7, i));
    expect_same(piece, {0, 0, 1}, wanted, {}, "geometric offsets");
}

TEST(Sweep, FortyShellsAndCavitiesInsideOneAnother) {
    std::mt19937 random(5);
    std::vector<TriangleMesh> parts{shapes::box({0, 0, 0}, {200, 200, 200}, 3)};
    for (int i = 0; i < 27; ++i) {
        const std::array<int, 3> place{i % 3, i / 3 % 3, i / 9};
        const Vec3 at{40.0 + 60 * place[0], 40.0 + 60 * place[1], 40.0 + 60 * place[2]};
        parts.push_back(shapes::turned_inside_out(shapes::ball(at, 18 + i % 5, 7)));
        if (i % 2 == 0) parts.push_back(shapes::torus(at, 9, 3, 9));
    }
    const TriangleMesh mesh = shapes::joined(parts);
    const Piece piece = piece_of(mesh);
    for (int round = 0; round < 6; ++round) {
        const Vec3 n = round == 0 ? Vec3{0, 0, 1} : random_normal(random);
        expect_same(piece, n, even(piece, n, 21), form(round % 2 == 0, FragilityForm::thinness), "cavities");
    }
}

}  // namespace
}  // namespace qchopper
