#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include "segment/cut/cut_piece.h"
#include "segment/cut/nudge.h"
#include "segment/mesh/measure.h"
#include "segment/mesh/oriented_box.h"
#include "segment/objectives/seam_cost.h"
#include "tests/pieces.h"
#include "tests/reference/segment/objectives/binary_fragility.h"
#include "tests/reference/segment/objectives/evaluate_by_cutting.h"
#include "tests/segment/access/cut_samples.h"
#include "tests/segment/objectives/sweep/same_evaluation.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

Objectives all_of_chopper() {
    Objectives o;
    o.weights.parts = 1;
    o.weights.utilization = 0.05;
    o.weights.seam = 0.1;
    o.fragility_form = FragilityForm::binary;
    o.fragility_distance = 7;
    o.print_volume = Vec3{30, 25, 20};
    return o;
}

std::vector<double> even(const Piece& piece, Vec3 normal, int count) {
    const Extent range = extent(*piece.mesh, normal);
    std::vector<double> wanted;
    for (int k = 1; k <= count; ++k) wanted.push_back(range.low + range.size() * k / (count + 1));
    return wanted;
}

// A piece whose seams cost something else at each point.
Piece with_costs(TriangleMesh mesh) {
    Piece piece = piece_of(std::move(mesh));
    std::mt19937 random(4);
    std::vector<float> cost(piece.mesh->points.size());
    for (float& c : cost) c = static_cast<float>(random() % 1000) / 1000;
    piece.seam_cost = std::make_shared<const std::vector<float>>(std::move(cost));
    return piece;
}

std::vector<Piece> cut_six_times(Piece whole, std::mt19937& random) {
    std::vector<Piece> pieces{std::move(whole)};
    for (std::int32_t cut_number = 1; cut_number <= 6; ++cut_number) {
        const std::size_t which = random() % pieces.size();
        const Piece piece = pieces[which];
        const Vec3 n = cut_number % 3 == 0 ? Vec3{0, 0, 1} : random_normal(random);
        const Extent range = extent(*piece.mesh, n);
        const auto nudged = nudge(piece, n, std::array{range.low + 0.37 * range.size()});
        if (!nudged[0]) continue;
        auto made = cut_piece(piece, {n, nudged[0]->offset}, cut_number);
        pass_on_seam_costs(piece, *made);
        pieces.erase(pieces.begin() + static_cast<std::ptrdiff_t>(which));
        pieces.insert(pieces.end(), made->pieces.begin(), made->pieces.end());
    }
    return pieces;
}

TEST(Chopper, SizesSeamsAndBinaryFragilityEqualThoseOfCutting) {
    std::mt19937 random(31);
    std::size_t planes = 0;
    for (const auto& [name, mesh, count] : shapes::all_closed()) {
        const Piece piece = with_costs(mesh);
        for (int round = 0; round < 5; ++round) {
            const Vec3 n = round == 0 ? Vec3{0, 0, 1} : random_normal(random);
            Objectives o = all_of_chopper();
            o.fragility_distance = round % 2 == 0 ? 3 : 40;
            planes += expect_same(piece, n, even(piece, n, 17), o, name + " round " + std::to_string(round));
        }
    }
    EXPECT_GT(planes, 700U);
}

TEST(Chopper, TheyDoOnPiecesThatOwnCaps) {
    std::mt19937 random(32);
    for (const auto& [name, mesh, count] : shapes::all_closed()) {
        for (const Piece& piece : cut_six_times(with_costs(mesh), random)) {
            for (int round = 0; round < 2; ++round) {
                const Vec3 n = round == 0 ? Vec3{0, 0, 1} : random_normal(random);
                expect_same(piece, n, even(piece, n, 9), all_of_chopper(), name);
            }
        }
    }
}

TEST(Chopper, AllButTheConnectorEqualCuttingOnSamplesAndOnTheirPieces) {
    std::size_t planes = 0;
    std::size_t of_many_solids = 0;
    std::size_t k = 0;
    constexpr std::array forms{FragilityForm::binary, FragilityForm::thinness, FragilityForm::thesis};
    for (const SampleCut& of : cut_samples({Specimen::vertebra, Specimen::skull})) {
        Piece piece = of.piece;
        piece.seam_cost = with_costs(*piece.mesh).seam_cost;
        Objectives o = all_of_chopper();
        o.fragility_form = forms[k++ % forms.size()];
        o.fragility_distance = 20;
        o.print_volume = Vec3{400, 300, 250};
        planes += expect_same(piece, of.normal, even(piece, of.normal, 8), o, of.name);
        for (const double offset : even(piece, of.normal, 6)) {
            const auto nudged = nudge(piece, of.normal, std::array{offset});
            if (!nudged[0]) continue;
            const auto made = evaluate_by_cutting(piece, {of.normal, nudged[0]->offset}, {});
            if (made && made->solids.size() > 2) ++of_many_solids;
        }
    }
    EXPECT_GE(planes, 60U);
    EXPECT_GT(of_many_solids, 10U);
}

double parts_of_first_cut(const Piece& box, double wanted, Vec3 axis, const Objectives& o) {
    const auto nudged = nudge(box, axis, std::array{wanted});
    const auto evaluation = sweep(prepare(box, o), axis, {&nudged[0]->offset, 1}, o);
    ScanShare scan;
    scan.boxes = print_boxes(oriented_box(box.mesh->points).size(), o);
    return terms(*evaluation[0], {}, o, scan)->parts;
}

TEST(Chopper, ABoxOfFourPrintLengthsCutAtOneLengthNeedsNoFurtherParts) {
    Objectives o = all_of_chopper();
    o.print_volume = Vec3{250, 200, 150};
    for (int n = 1; n <= 40; ++n) {  // the vertices along the length, and so the nudge, differ
        const Piece box = piece_of(shapes::box({0, 0, 0}, {1000, 200, 150}, n));
        for (const double at : {250.0, 500.0, 750.0}) EXPECT_EQ(parts_of_first_cut(box, at, {1, 0, 0}, o), 1) << n;
        EXPECT_EQ(parts_of_first_cut(box, 300, {1, 0, 0}, o), 1.25) << n;
    }
}

TEST(Chopper, UtilizationIsOfTheWorstPartOfTheCutOrOfAll) {
    Objectives o = all_of_chopper();
    o.print_volume = Vec3{250, 200, 150};
    const Piece box = piece_of(shapes::box({0, 0, 0}, {500, 200, 150}));
    const double at = 125;
    const auto evaluation = sweep(prepare(box, o), {1, 0, 0}, {&at, 1}, o);
    EXPECT_NEAR(terms(*evaluation[0], {}, o)->utilization, 0.5, 1e-9);
    const std::vector<PieceShare> others{{10, 0.5, 0, 1, 250 * 200 * 150 * 0.1}};
    EXPECT_NEAR(terms(*evaluation[0], others, o)->utilization, 0.5, 1e-9);
    o.utilization_scope = TermScope::whole;
    EXPECT_NEAR(terms(*evaluation[0], others, o)->utilization, 0.9, 1e-9);
}

TEST(Chopper, WithoutAPrintVolumePartsAndUtilizationCostNothing) {
    Objectives o = all_of_chopper();
    o.print_volume.reset();
    const Piece box = piece_of(shapes::box({0, 0, 0}, {500, 200, 150}));
    const double at = 125;
    ScanShare scan;
    scan.diagonal_mm = 100;
    const Terms t = *terms(*sweep(prepare(box, o), {1, 0, 0}, {&at, 1}, o)[0], {}, o, scan);
    EXPECT_EQ(t.parts, 0);
    EXPECT_EQ(t.utilization, 0);
    EXPECT_NEAR(t.seam, 7, 1e-9) << "700 mm of outline";
}

TEST(Chopper, TheSeamOfACylinderIsItsCircumference) {
    constexpr int sides = 96;
    constexpr double radius = 40;
    TriangleMesh cylinder;
    for (const double z : {0.0, 200.0}) {
        for (int i = 0; i < sides; ++i) {
            const double angle = 2 * std::numbers::pi * i / sides;
            cylinder.points.push_back({radius * std::cos(angle), radius * std::sin(angle), z});
        }
    }
    for (std::uint32_t i = 0; i < sides; ++i) {
        const std::uint32_t next = (i + 1) % sides;
        cylinder.triangles.push_back({i, next, sides + next});
        cylinder.triangles.push_back({i, sides + next, sides + i});
        if (i > 0 && i + 1 < sides) {
            cylinder.triangles.push_back({0, i + 1, i});
            cylinder.triangles.push_back({sides, sides + i, sides + i + 1});
        }
    }
    Objectives o = all_of_chopper();
    o.print_volume.reset();
    const Piece piece = piece_of(cylinder);
    const double at = 77;
    ScanShare scan;
    scan.diagonal_mm = norm(oriented_box(piece.mesh->points).size());
    const Terms t = *terms(*sweep(prepare(piece, o), {0, 0, 1}, {&at, 1}, o)[0], {}, o, scan);
    const double circumference = 2 * sides * radius * std::sin(std::numbers::pi / sides);
    EXPECT_NEAR(t.seam, circumference / scan.diagonal_mm, 1e-12);
}

TEST(Chopper, ASeamCostsOncePerFurtherPrintVolume) {
    CutEvaluation evaluation;
    evaluation.cap_area_mm2 = 1;
    evaluation.seam_mm = 10;
    evaluation.solids = {{4, 10, true, {}, {30, 10, 10}}, {4, 10, false, {}, {10, 10, 10}}};
    Objectives o = all_of_chopper();
    o.print_volume = Vec3{10, 10, 10};
    EXPECT_DOUBLE_EQ(terms(evaluation, {}, o, {100, 4, 7})->seam, (7 + 10 * (1 + 2)) / 400.0);
}

TEST(Chopper, ASlabThinnerThanTheDistanceIsFragileOnItsSide) {
    const Piece box = piece_of(shapes::box({0, 0, 0}, {100, 100, 100}, 4));
    for (const auto& [at, is_fragile] : {std::pair{5.0, 1.0}, {19.0, 1.0}, {21.0, 0.0}, {79.0, 0.0}, {90.0, 1.0}}) {
        EXPECT_EQ(binary_fragility(box, {{0, 0, 1}, at}, 20), is_fragile) << at;
    }
    // Beside a cap that an earlier cut made, whose corners' own normals look sideways too.
    const auto made = cut_piece(box, {canonical({normalized({0.02, 0, 1}), 50}).normal, 50}, 1);
    for (const Piece& half : made->pieces)
        EXPECT_EQ(binary_fragility(half, {{0, 0, 1}, 42}, 20) + binary_fragility(half, {{0, 0, 1}, 58}, 20), 1);
}

TEST(Chopper, ABallIsFragileNearItsPolesOnly) {
    const Piece ball = piece_of(shapes::ball({0, 0, 0}, 100, 40));
    EXPECT_EQ(binary_fragility(ball, {{0, 0, 1}, 0.5}, 20), 0);
    EXPECT_EQ(binary_fragility(ball, {{0, 0, 1}, 85.0}, 20), 1);
    EXPECT_EQ(binary_fragility(ball, {{0, 0, 1}, 73.0}, 20), 1) << "the normal of its surface 19 mm off is 0.92 up";
    EXPECT_EQ(binary_fragility(ball, {{0, 0, 1}, 55.0}, 20), 0);
    EXPECT_EQ(binary_fragility(ball, {{0, 0, 1}, -85.0}, 20), 1);
}

TEST(Chopper, SurfaceAcrossAGapIsNotThin) {
    const Piece pair = piece_of(
        shapes::joined({shapes::box({0, 0, 0}, {100, 100, 100}, 3), shapes::box({0, 0, 105}, {100, 100, 205}, 3)}));
    EXPECT_EQ(binary_fragility(pair, {{0, 0, 1}, 50}, 60), 1) << "the top and the bottom of the lower box";
    EXPECT_EQ(binary_fragility(pair, {{0, 0, 1}, 50}, 49), 0);
    EXPECT_EQ(binary_fragility(pair, {{0, 0, 1}, 150}, 50), 1) << "45 mm above the bottom";
    EXPECT_EQ(binary_fragility(pair, {{0, 0, 1}, 155}, 49.9), 0) << "the lower box lies beyond a gap";
}

TEST(Chopper, ForbiddenIsAValueOfOneOfANamedObjective) {
    Terms t;
    t.fragility = 1;
    t.parts = 1;
    Objectives o;
    EXPECT_FALSE(is_forbidden(t, o));
    o.forbidden = {"connector"};
    EXPECT_FALSE(is_forbidden(t, o));
    o.forbidden = {"connector", "fragility"};
    EXPECT_TRUE(is_forbidden(t, o));
    t.fragility = 0.99;
    EXPECT_FALSE(is_forbidden(t, o));
}

}  // namespace
}  // namespace qchopper
