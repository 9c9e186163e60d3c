#include "cam/setup/layout/flush_caps.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "cam/setup/choose_setup.h"
#include "cam/setup/layout/lay_out.h"
#include "cam/setup/stock_fit.h"
#include "segment/mesh/footprint.h"
#include "tests/cam/setup/pieces.h"

namespace qchopper {
namespace {

using test_pieces::rotated;
using test_pieces::uncut;

constexpr double degree = std::numbers::pi / 180;

struct CutBy {
    Vec3 inward;
    double offset = 0;  // of the plane along it
};

// What of a shape lies on the inward side of each plane, as a segmentation cuts it: the cuts are numbered from 1.
Piece cut_by(TriangleMesh mesh, const std::vector<CutBy>& cuts) {
    Piece piece = uncut(std::move(mesh));
    for (std::size_t i = 0; i < cuts.size(); ++i) {
        const Plane plane = canonical({normalized(cuts[i].inward), cuts[i].offset / norm(cuts[i].inward)});
        auto made = cut_piece(piece, plane, static_cast<std::int32_t>(i + 1));
        EXPECT_TRUE(made.has_value());
        if (!made) return piece;
        const auto is_inside = [&](const Piece& part) {
            const Vec3 middle = bounds(*part.mesh).centre();
            return dot(normalized(cuts[i].inward), middle) >
                   plane.offset * dot(plane.normal, normalized(cuts[i].inward));
        };
        const auto kept = std::find_if(made->pieces.begin(), made->pieces.end(), is_inside);
        EXPECT_NE(kept, made->pieces.end());
        piece = *kept;
    }
    return piece;
}

// A ball of 100 mm radius of which the planes leave a part.
TriangleMesh hundred_mm_ball() {
    return shapes::ball({0, 0, 0}, 100, 32);
}

Cell sawn_cell() {
    Cell cell = test_pieces::cell();
    cell.stock = {{"sheet", {1000, 600, 500}, Material::pu_foam, true, 3}};
    cell.margins = {5, 3, 10};
    return cell;
}

// On the base of that number.
qchopper::Setup laid(const Piece& piece, const Cell& cell, int number) {
    const std::vector<PieceBase> bases = bases_of(piece);
    const auto base = std::find_if(bases.begin(), bases.end(), [&](const PieceBase& b) { return b.number == number; });
    EXPECT_NE(base, bases.end());
    return lay_out(piece, *base, cell, caps_to_saw(*piece.mesh, cell));
}

std::vector<std::pair<std::int32_t, BlockFace>> faces_of(const qchopper::Setup& setup) {
    std::vector<std::pair<std::int32_t, BlockFace>> faces;
    for (const FlushCap& cap : setup.flush_caps) faces.emplace_back(cap.cut, cap.face);
    return faces;
}

// What every setup with flush caps must keep.
void expect_whole(const Piece& piece, const qchopper::Setup& setup, const Cell& cell, const std::string& name) {
    const Box block = setup.block_box();
    EXPECT_EQ(setup.block.size, block.size()) << name;
    EXPECT_NEAR(block.centre().x, 0, 1e-9) << name;
    EXPECT_NEAR(block.centre().y, 0, 1e-9) << name;
    const auto foam = foam_at_faces(margins_of(cell), setup.flush_faces());
    const std::array<double, block_faces> away{setup.box.min.x - block.min.x, block.max.x - setup.box.max.x,
                                               setup.box.min.y - block.min.y, block.max.y - setup.box.max.y,
                                               block.max.z - setup.box.max.z};
    for (std::size_t f = 0; f < block_faces; ++f) {
        if (setup.flush_faces()[f]) {
            EXPECT_NEAR(away[f], 0, 0.5 * flush_step + 1e-6) << name << ", face " << f;
        } else {
            EXPECT_GE(away[f], foam[f] - 0.5 * flush_step - 1e-6) << name << ", face " << f;
        }
    }
    // Every cap is the base, flush or milled.
    double caps = 0;
    double known = setup.milled_caps_mm2;
    for (const CapPoints& cap : caps_with_points(*piece.mesh)) {
        caps += cap.area_mm2;
        if (cap.cut == setup.base) known += cap.area_mm2;
    }
    for (const FlushCap& cap : setup.flush_caps) known += cap.area_mm2;
    EXPECT_NEAR(known, caps, 1e-6 * caps) << name;
    // Every point of a flush cap lies in its face.
    for (const CapPoints& cap : caps_with_points(*piece.mesh)) {
        const auto flush = std::find_if(setup.flush_caps.begin(), setup.flush_caps.end(),
                                        [&](const FlushCap& f) { return f.cut == cap.cut; });
        if (flush == setup.flush_caps.end()) continue;
        for (const Vec3& in_piece : cap.points) {
            const Vec3 p = apply(setup.piece_in_setup, in_piece);
            const std::array<double, block_faces> to_face{p.x - block.min.x, block.max.x - p.x, p.y - block.min.y,
                                                          block.max.y - p.y, block.max.z - p.z};
            EXPECT_NEAR(to_face[static_cast<std::size_t>(flush->face)], 0, 0.15 + 1e-6) << name;
        }
    }
    EXPECT_TRUE(check_stock_fit(setup, cell).fits()) << name << describe_stock_fit(name, check_stock_fit(setup, cell));
}

TEST(FlushCaps, SidesAndTopOfACutBallAreFacesOfItsBlock) {
    const Piece piece = cut_by(hundred_mm_ball(), {{{0, 0, 1}, -40}, {{1, 0, 0}, -50}, {{0, 0, -1}, -30}});
    const Cell cell = sawn_cell();
    const qchopper::Setup setup = laid(piece, cell, 1);
    ASSERT_EQ(setup.flush_caps.size(), 2U);
    EXPECT_EQ(setup.flush_caps[0].cut, 2);
    EXPECT_NE(setup.flush_caps[0].face, BlockFace::top);
    EXPECT_EQ(setup.flush_caps[1], (FlushCap{3, BlockFace::top, setup.flush_caps[1].area_mm2}));
    EXPECT_EQ(setup.milled_caps_mm2, 0);
    expect_whole(piece, setup, cell, "three caps");
}

TEST(FlushCaps, ATurnedPieceHasTheSameFlushCapsAndBlock) {
    const Piece piece = cut_by(hundred_mm_ball(), {{{0, 0, 1}, -40}, {{1, 0.2, 0}, -50}, {{-0.2, 1, 0}, -60}});
    const Cell cell = sawn_cell();
    const qchopper::Setup setup = laid(piece, cell, 1);
    for (const double angle : {0.3, 1.1, 2.5}) {
        const Piece turned = rotated(piece, {0.3, -0.5, 0.8}, angle, {12, -7, 30});
        const qchopper::Setup other = laid(turned, cell, 1);
        EXPECT_EQ(other.flush_caps.size(), setup.flush_caps.size());
        EXPECT_NEAR(other.block.size.x, setup.block.size.x, 0.11);
        EXPECT_NEAR(other.block.size.y, setup.block.size.y, 0.11);
        EXPECT_NEAR(other.block.size.z, setup.block.size.z, 0.11);
        expect_whole(turned, other, cell, "turned by " + std::to_string(angle));
    }
}

TEST(FlushCaps, WithoutABaseCapOrSawnStockNothingIsFlush) {
    const Piece whole = uncut(hundred_mm_ball());
    EXPECT_TRUE(laid(whole, sawn_cell(), 1).flush_caps.empty());
    const Piece piece = cut_by(hundred_mm_ball(), {{{0, 0, 1}, -40}, {{1, 0, 0}, -50}});
    Cell cell = sawn_cell();
    cell.stock.front().is_sawn = false;
    const qchopper::Setup setup = laid(piece, cell, 1);
    EXPECT_TRUE(setup.flush_caps.empty());
    EXPECT_NEAR(setup.box.centre().x, 0, 1e-9);
}

TEST(FlushCaps, OfTwoSideCapsAtSixtyDegreesOneIsFlush) {
    const double c = std::cos(60 * degree);
    const double s = std::sin(60 * degree);
    const Piece piece = cut_by(hundred_mm_ball(), {{{0, 0, 1}, -40}, {{1, 0, 0}, -50}, {{c, s, 0}, -50}});
    const Cell cell = sawn_cell();
    const qchopper::Setup setup = laid(piece, cell, 1);
    ASSERT_EQ(setup.flush_caps.size(), 1U);
    EXPECT_GT(setup.milled_caps_mm2, 400);
    expect_whole(piece, setup, cell, "sixty degrees");
}

// A cap of some 170 mm: 1e-4 rad are 0.02 mm, 1e-3 rad 0.17 mm.
TEST(FlushCaps, DistancesDecideHowFarACapMayLean) {
    const Cell cell = sawn_cell();
    const std::vector<std::pair<double, bool>> cases{{0, true}, {1e-4, true}, {1e-3, false}, {1e-2, false}};
    for (const auto& [lean, is_flush] : cases) {
        const Piece piece = cut_by(hundred_mm_ball(), {{{0, 0, 1}, -40}, {{1, 0, std::tan(lean)}, -50}});
        const qchopper::Setup setup = laid(piece, cell, 1);
        EXPECT_EQ(setup.flush_caps.size(), is_flush ? 1U : 0U) << lean;
        expect_whole(piece, setup, cell, "leans by " + std::to_string(lean));
    }
}

TEST(FlushCaps, ACapOf60MmTurnedByAFifthOfADegreeIsNot) {
    const Piece piece =
        cut_by(hundred_mm_ball(),
               {{{0, 0, 1}, -20}, {{0, 0, -1}, -20}, {{1, 0, 0}, -50}, {{-1, 0, std::tan(0.2 * degree)}, -95}});
    const Cell cell = sawn_cell();
    const qchopper::Setup setup = laid(piece, cell, 1);
    const auto is_leaning = [](const FlushCap& cap) { return cap.cut == 4; };
    EXPECT_TRUE(std::none_of(setup.flush_caps.begin(), setup.flush_caps.end(), is_leaning));
    EXPECT_EQ(setup.flush_caps.size(), 2U);
    expect_whole(piece, setup, cell, "turned cap");
}

TEST(FlushCaps, OppositeSidesAreBothFlushAndTheBlockEndsAtBoth) {
    const Piece piece = cut_by(hundred_mm_ball(), {{{0, 0, 1}, -40}, {{1, 0, 0}, -50}, {{-1, 0, 0}, -31.23}});
    const Cell cell = sawn_cell();
    const qchopper::Setup setup = laid(piece, cell, 1);
    ASSERT_EQ(setup.flush_caps.size(), 2U);
    const auto along = static_cast<std::size_t>(setup.flush_caps[0].face) / 2;
    EXPECT_EQ(along, static_cast<std::size_t>(setup.flush_caps[1].face) / 2);
    // The piece is 81.23 long: a cell refuses a block that is shorter (tests/sim/cell, STOCK_TOO_SMALL).
    EXPECT_NEAR(setup.block.size[static_cast<int>(along)], 81.3, 1e-6);
    expect_whole(piece, setup, cell, "opposite sides");
}

TEST(FlushCaps, ACapWithAHoleAndACapOfSeveralLoopsAreFlushToo) {
    const Cell cell = sawn_cell();
    // A torus around z: across x its caps are two discs; across z a ring.
    const Piece ring = cut_by(shapes::torus({0, 0, 0}, 70, 30, 48), {{{0, 0, 1}, -10}, {{0, 0, -1}, -12}});
    const qchopper::Setup with_hole = laid(ring, cell, 1);
    ASSERT_EQ(faces_of(with_hole), (std::vector{std::pair(std::int32_t{2}, BlockFace::top)}));
    expect_whole(ring, with_hole, cell, "ring");
    const Piece half = cut_by(shapes::torus({0, 0, 0}, 70, 30, 48), {{{0, 0, 1}, -10}, {{1, 0, 0}, 0}});
    const qchopper::Setup two_loops = laid(half, cell, 1);
    ASSERT_EQ(two_loops.flush_caps.size(), 1U);
    EXPECT_EQ(two_loops.flush_caps.front().cut, 2);
    expect_whole(half, two_loops, cell, "two loops");
}

TEST(FlushCaps, StockThatIsTooShortForTheSawCutKeepsFoamThere) {
    const Piece piece = cut_by(hundred_mm_ball(), {{{0, 0, 1}, -40}, {{1, 0, 0}, -50}, {{-1, 0, 0}, -50}});
    const Cell roomy = sawn_cell();
    const Vec3 size = laid(piece, roomy, 1).box.size();
    ASSERT_NEAR(std::min(size.x, size.y), 100, 1e-6);
    for (const auto& [extra, is_flush] : std::vector<std::pair<double, bool>>{{6, true}, {5.9, false}}) {
        Cell cell = roomy;
        cell.margins.sides = 2;  // so that the block with foam fits into the shorter stock too
        // Along the other axes there is no room for the sides that are flush.
        cell.stock.front().size = {std::max(size.x, size.y) + 4, 100 + extra, size.z + 13};
        const qchopper::Setup setup = laid(piece, cell, 1);
        EXPECT_EQ(setup.flush_caps.size(), is_flush ? 2U : 0U) << extra;
    }
}

TEST(FlushCaps, FlatSkinInThePlaneOfACapIsNoCap) {
    // A box is all flat; only its underside and one side were cut.
    const Piece piece = cut_by(shapes::box({0, 0, 0}, {120, 80, 60}, 2), {{{0, 0, 1}, 20}, {{1, 0, 0}, 30}});
    const Cell cell = sawn_cell();
    const qchopper::Setup setup = laid(piece, cell, 1);
    ASSERT_EQ(setup.flush_caps.size(), 1U);
    EXPECT_EQ(setup.flush_caps.front().cut, 2);
    EXPECT_NEAR(setup.flush_caps.front().area_mm2, 80 * 40, 1e-6);
    expect_whole(piece, setup, cell, "flat skin");
}

// Every turn in steps of a thousandth of a degree around those that lay a side cap along an axis, by the normal of one
// of its triangles.
TEST(FlushCaps, TheTurnIsTheBestOfManyTriedOneByOne) {
    const Cell cell = sawn_cell();
    const Margins margins = margins_of(cell);
    const double c = std::cos(72 * degree);
    const double s = std::sin(72 * degree);
    const std::vector<Piece> pieces{
        cut_by(hundred_mm_ball(), {{{0, 0, 1}, -40}, {{1, 0.1, 0}, -50}, {{c, s, 0}, -50}}),
        cut_by(hundred_mm_ball(), {{{0, 0, 1}, -40}, {{1, 0.1, 0}, -50}, {{-0.1, 1, 0}, -20}, {{-c, s, 0}, -40}}),
        cut_by(shapes::box({0, 0, 0}, {120, 80, 60}, 2), {{{0, 0, 1}, 20}, {{1, 0.3, 0}, 30}})};
    for (const Piece& piece : pieces) {
        const std::vector<CapPoints> caps = caps_with_points(*piece.mesh);
        const Vec3 up{0, 0, 1};
        const auto cost = [&](Point2 along) {
            const auto [e1, e2] = frame_under(up);
            const Vec3 x = normalized(along.x * e1 + along.y * e2);
            const Pose pose{{x, cross(up, x), up}, {}};
            Box box{apply(pose, piece.mesh->points.front()), apply(pose, piece.mesh->points.front())};
            for (const Vec3& p : piece.mesh->points) extend(box, apply(pose, p));
            FlushFaces flush{};
            double milled = 0;
            for (const CapPoints& cap : caps) milled += cap.cut == 1 ? 0 : cap.area_mm2;
            for (const FlushCap& cap : flush_caps(caps, pose, box, 1, 0.1)) {
                flush[static_cast<std::size_t>(cap.face)] = true;
                milled -= cap.area_mm2;
            }
            const Vec3 size = size_with_foam(box.size(), margins, flush);
            return size.x * size.y * size.z + foam_per_milled_cap * milled;
        };
        const std::vector<Point2> turns = turns_to_try(caps, piece.mesh->points, up, 1, margins, 0.1);
        const double chosen = cost(turns.front());
        std::vector<Point2> along_caps;
        const auto [e1, e2] = frame_under(up);
        for (const CapPoints& cap : caps) {
            const Vec3 normal = normalized(cross(cap.points[1] - cap.points[0], cap.points[2] - cap.points[0]));
            if (std::abs(normal.z) < 0.5) along_caps.push_back({-dot(e2, normal), dot(e1, normal)});
        }
        ASSERT_FALSE(along_caps.empty());
        double best = chosen;
        for (const Point2& turn : along_caps) {
            for (int k = -20; k <= 20; ++k) {
                const double by = k * 0.001 * degree;
                best = std::min(best, cost({std::cos(by) * turn.x - std::sin(by) * turn.y,
                                            std::sin(by) * turn.x + std::cos(by) * turn.y}));
            }
        }
        // A turn by a thousandth of a degree changes the sides by some thousandths of a mm: of 100 x 100 mm 0.02 mm.
        EXPECT_LT(chosen, best + 200);
    }
}

TEST(FlushCaps, ASliverOfACapIsFlush) {
    const Piece piece = cut_by(hundred_mm_ball(), {{{0, 0, 1}, -40}, {{1, 0, 0}, -99.2}});
    const Cell cell = sawn_cell();
    const qchopper::Setup setup = laid(piece, cell, 1);
    ASSERT_EQ(setup.flush_caps.size(), 1U);
    EXPECT_EQ(setup.flush_caps.front().cut, 2);
    EXPECT_LT(setup.flush_caps.front().area_mm2, 500);
    EXPECT_GT(setup.flush_caps.front().area_mm2, 10);
    expect_whole(piece, setup, cell, "sliver");
}

// A base as small as may be: about an eighth of what the piece covers.
TEST(FlushCaps, SidesOverASmallBaseAreFlush) {
    const Piece piece = cut_by(hundred_mm_ball(), {{{0, 0, 1}, -95.5}, {{1, 0, 0}, -50}, {{0, 1, 0}, -50}});
    const Cell cell = sawn_cell();
    const qchopper::Setup setup = laid(piece, cell, 1);
    EXPECT_LT(setup.base_mm2, 0.15 * setup.projected_area_mm2);
    EXPECT_EQ(faces_of(setup).size(), 2U);
    expect_whole(piece, setup, cell, "small base");
}

TEST(FlushCaps, BasesAreRankedByAreaOutOfReachNotByShare) {
    // On its base cap of the largest area fewer caps are milled, so that the same area out of reach is a larger share.
    int disagree = 0;  // bases with a smaller share and more area than the one that is taken
    for (const Piece& piece : test_pieces::cut_shapes()) {
        if (piece.half_spaces.size() < 2) continue;
        Cell cell = sawn_cell();
        cell.stock.front().size = {3000, 3000, 3000};
        SetupOptions options;
        options.samples = 500;
        options.mapped = 8;
        options.map.stock_points = 1U << 12U;
        const std::vector<qchopper::Setup> setups = choose_setup(piece, cell, options).setups;
        if (!setups.front().base) continue;
        const double whole = area_mm2(*piece.mesh);
        for (const qchopper::Setup& other : setups) {
            if (!check_stock_fit(other, cell).fits()) continue;
            EXPECT_LE(setups.front().access.unreachable_mm2(), other.access.unreachable_mm2() + 0.0011 * whole)
                << piece.name;
            const SurfaceAccess& taken = setups.front().access;
            const bool is_less_by_share = other.access.unreachable_share() < taken.unreachable_share();
            if (is_less_by_share && other.access.unreachable_mm2() > taken.unreachable_mm2()) ++disagree;
        }
    }
    EXPECT_GT(disagree, 0) << "no piece tells the two rules apart";
}

TEST(FlushCaps, AreaToMillIsTheMeshWithoutBaseAndFlushCaps) {
    const Piece piece = cut_by(hundred_mm_ball(), {{{0, 0, 1}, -40}, {{1, 0, 0}, -50}, {{0.5, 1, 0.2}, -60}});
    const qchopper::Setup setup = choose_setup(piece, sawn_cell()).setups.front();
    double expected = area_mm2(*piece.mesh);
    for (const CapPoints& cap : caps_with_points(*piece.mesh)) {
        if (setup.is_unmilled(cap.cut)) expected -= cap.area_mm2;
    }
    ASSERT_EQ(setup.access.method, AccessMethod::mapped);
    EXPECT_NEAR(setup.access.area_mm2, expected, 1e-6 * expected);
}

}  // namespace
}  // namespace qchopper
