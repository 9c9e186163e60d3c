#include "app/jobs/setups.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "base/error.h"
#include "cam/setup/blocks_needed.h"
#include "segment/mesh/measure.h"
#include "tests/cam/cell/short_tools.h"
#include "tests/cam/setup/pieces.h"

namespace qchopper {
namespace {

Cell cell_named(const std::string& name) {
    return read_cell(std::filesystem::path(QCHOPPER_SOURCE_DIR) / "cells" / (name + ".toml"));
}

// A square frame that lies on its underside, the cap of cut 1: walls of 50 mm around a shaft of 200 mm.
Piece frame(double height) {
    TriangleMesh mesh;
    for (const double z : {0.0, height}) {
        for (const double half : {150.0, 100.0}) {
            mesh.points.insert(mesh.points.end(),
                               {{-half, -half, z}, {half, -half, z}, {half, half, z}, {-half, half, z}});
        }
    }
    const auto quad = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
        mesh.triangles.push_back({a, b, c});
        mesh.triangles.push_back({a, c, d});
    };
    for (std::uint32_t k = 0; k < 4; ++k) {
        const std::uint32_t next = (k + 1) % 4;
        quad(k, next, next + 8, k + 8);            // outside
        quad(next + 4, k + 4, k + 12, next + 12);  // inside
        quad(k + 8, next + 8, next + 12, k + 12);  // above
        quad(next, k, k + 4, next + 4);            // below
    }
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const Vec3 area = area_vector(mesh, t);
        mesh.cap_of.push_back(area.z < 0 ? 1 : no_cap);
    }
    return {"A", std::make_shared<TriangleMesh>(mesh), {{1, {{0, 0, 1}, 0}, true}}};
}

TEST(Setups, APieceWhoseShaftIsDeeperThanTheToolIsLongCannotBeMilled) {
    Setups setups(cell_named("kr60-ha"));
    const double low = low_piece_height(setups.cell());
    const Piece high = frame(400);
    ASSERT_GT(volume_mm3(*high.mesh), 0);
    EXPECT_TRUE(setups.fits(high)) << "by its block and the poses above it";
    EXPECT_FALSE(setups.is_machinable(high));
    EXPECT_FALSE(setups.is_machinable(high)) << "asked again";
    EXPECT_TRUE(setups.is_machinable(frame(low - 1)));
}

// Pieces of which one does not fit, one cannot be milled, and the others leave different areas out of reach.
TEST(Setups, SeveralPiecesWorkedOutTogetherAreAsEachAlone) {
    const std::vector<Piece> pieces{frame(400), test_pieces::standing_box({0, 0, 0}, {3000, 3000, 3000}, 1), frame(100),
                                    test_pieces::standing_box({-60, -60, 0}, {60, 60, 220}, 1)};
    Setups alone(cell_named("kr60-ha"));
    Setups together(cell_named("kr60-ha"));
    together.work_out(pieces, {true, true, true}, nullptr);
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        const Piece& piece = pieces[i];
        EXPECT_EQ(together.fits(piece), alone.fits(piece)) << i;
        if (!alone.fits(piece)) continue;
        EXPECT_EQ(together.is_machinable(piece), alone.is_machinable(piece)) << i;
        EXPECT_EQ(together.mapped(piece).setup(), alone.mapped(piece).setup()) << i;
        const UnreachableSurface known = together.unreachable(piece);
        const UnreachableSurface asked = alone.unreachable(piece);
        EXPECT_EQ(known.mm2, asked.mm2) << i;
        EXPECT_EQ(known.share, asked.share) << i;
    }
}

TEST(Setups, AHighPieceThatTheToolReachesFromItsSidesCanBeMilled) {
    Setups setups(with_short_tools(cell_named("kr60-ha")));
    const Piece pillar = test_pieces::standing_box({-60, -60, 0}, {60, 60, 220}, 1);
    EXPECT_GT(220, low_piece_height(setups.cell()));
    EXPECT_TRUE(setups.is_machinable(pillar));
}

TEST(Setups, ToolsThatTheOperatorDoesNotAllowAreNotPlannedWith) {
    Setups setups(with_short_tools(cell_named("kr60-ha")));
    const Piece high = frame(120);
    const auto with_all = setups.mapped(high).setup();
    EXPECT_TRUE(with_all.tools.empty());
    setups.set_tools({4});  // 100 mm long, the others 150
    EXPECT_LT(low_piece_height(setups.planned()), low_piece_height(setups.cell()) - 40);
    const auto with_finest = setups.mapped(high).setup();
    EXPECT_EQ(with_finest.tools, std::vector<std::uint16_t>{4});
    EXPECT_GT(with_finest.access.holder_mm2, with_all.access.holder_mm2 + 1000) << "its holder meets the walls";
    setups.set_orders({{"A", {}, {}, {3, 4}}});
    EXPECT_EQ(setups.placed(high).setup().tools, (std::vector<std::uint16_t>{3, 4})) << "of one piece";
    EXPECT_THROW(setups.set_tools({9}), InputError);
}

// A workshop that buys a longer tool of a kind keeps what it could mill before, and mills more.
TEST(Setups, TakeTheShorterOfTwoToolsOfAKindUnlessThatReachesTooLittle) {
    Cell cell = with_short_tools(cell_named("kr120-r2500-pro-rotary"));
    for (const std::size_t of : {std::size_t{0}, std::size_t{7}}) {
        CuttingTool longer = cell.machine->tools[of];
        longer.number = static_cast<std::uint16_t>(9 + of);
        longer.stick_out = 300;
        cell.machine->tools.push_back(longer);
    }
    Setups setups(std::move(cell));
    const std::vector<std::uint16_t> shorter{1, 2, 3, 4, 5, 6, 7, 8};
    const std::vector<std::uint16_t> longest{2, 3, 4, 5, 6, 7, 9, 16};
    EXPECT_EQ(setups.placed(frame(100)).setup().tools, shorter);
    const PlacedSetup& deep = setups.placed(frame(270));
    EXPECT_EQ(deep.setup().tools, longest) << "its shaft is deeper than 150";
    EXPECT_TRUE(deep.fits());
    Setups without(with_short_tools(cell_named("kr120-r2500-pro-rotary")));
    EXPECT_LT(deep.setup().access.holder_mm2 + 1e4, without.placed(frame(270)).setup().access.holder_mm2);
    EXPECT_TRUE(setups.placed(frame(100)).setup().access == without.placed(frame(100)).setup().access);
}

// Of a piece that only long tools reach, and whose toolpath the arm does not follow.
TEST(Setups, APieceThatIsRefusedWithLongToolsIsCutAgain) {
    Setups setups(cell_named("kr120-r2500-pro-rotary"));
    const Piece deep = frame(270);
    const Piece flat = frame(100);
    EXPECT_TRUE(setups.is_machinable(deep));
    EXPECT_TRUE(setups.refuse_with_long_tools(deep));
    EXPECT_FALSE(setups.is_machinable(deep));
    EXPECT_FALSE(setups.refuse_with_long_tools(deep)) << "once";
    EXPECT_FALSE(setups.refuse_with_long_tools(flat)) << "short tools mill it";
    EXPECT_TRUE(setups.is_machinable(flat));
    Setups without(with_short_tools(cell_named("kr120-r2500-pro-rotary")));
    EXPECT_FALSE(without.refuse_with_long_tools(deep)) << "there are no shorter ones";
}

TEST(Setups, ACellWithoutAMachineKnowsNoToolAndMillsWhatFits) {
    Setups setups(cell_named("foam-1"));
    EXPECT_TRUE(setups.is_machinable(frame(400)));
}

}  // namespace
}  // namespace qchopper
