// The order of passes, links, and what holder and flute allow: against plain loops and closed forms.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <set>

#include "cam/setup/holder_clearance.h"
#include "cam/stock/cl_surface.h"
#include "cam/toolpath/clipped_passes.h"
#include "cam/toolpath/finishing_limit.h"
#include "cam/toolpath/pass_order.h"
#include "cam/toolpath/pass_stretches.h"
#include "cam/toolpath/roughing.h"
#include "cam/toolpath/toolpath_linker.h"
#include "segment/raster/disc_dilation.h"
#include "tests/cam/toolpath/toolpath_pieces.h"

namespace qchopper {
namespace {

using test_pieces::ball_tool;
using test_pieces::flat_tool;
using test_pieces::random_map;

// Every fourth is closed.
std::vector<Pass> random_passes(int count, double length, std::mt19937& random) {
    std::uniform_real_distribution<double> unit(0, 100);
    std::uniform_real_distribution<double> step(-length, length);
    std::vector<Pass> passes;
    for (int i = 0; i < count; ++i) {
        Pass pass;
        pass.points.push_back({{unit(random), 0.3 * unit(random), 0}, false});
        for (int k = 0; k < 2; ++k) {
            const Vec3 last = pass.points.back().tip;
            pass.points.push_back({last + Vec3{step(random), step(random), 0}, false});
        }
        pass.is_closed = i % 4 == 0;
        if (pass.is_closed) pass.points.push_back(pass.points.front());
        passes.push_back(pass);
    }
    return passes;
}

// Of the ways to passes and between them.
double length_of_ways(std::span<const Pass> passes, std::span<const PassEntry> order, Vec3 from) {
    double length = 0;
    for (const PassEntry& entry : order) {
        const Pass begun = begun_at(passes[entry.pass], entry.point);
        const Vec3 to = begun.points.front().tip;
        length += std::hypot(to.x - from.x, to.y - from.y);
        from = begun.points.back().tip;
    }
    return length;
}

std::vector<PassEntry> nearest_order(std::span<const Pass> passes, Vec3 at) {
    std::vector<PassEntry> entries;
    PassOrder order(passes);
    while (const auto entry = order.take_nearest(at)) {
        entries.push_back(*entry);
        at = begun_at(passes[entry->pass], entry->point).points.back().tip;
    }
    return entries;
}

TEST(ShortOrder, HasEachPassOnceAndShorterWaysThanTheNearest) {
    std::mt19937 random(5);
    const Vec3 from{-40, 90, 5};
    for (const int count : {0, 1, 2, 40, 300}) {
        const std::vector<Pass> passes = random_passes(count, 8, random);
        const std::vector<PassEntry> order = short_order(passes, from);
        std::set<std::size_t> left;
        for (std::size_t i = 0; i < passes.size(); ++i) left.insert(i);
        for (const PassEntry& entry : order) {
            EXPECT_EQ(left.erase(entry.pass), 1U);
            const std::size_t last = passes[entry.pass].points.size() - 1;
            EXPECT_TRUE(passes[entry.pass].is_closed ? entry.point < last : entry.point == 0 || entry.point == last);
        }
        EXPECT_TRUE(left.empty());
        const double shorter = length_of_ways(passes, order, from);
        const double nearest = length_of_ways(passes, nearest_order(passes, from), from);
        EXPECT_LE(shorter, nearest + 1e-9);
        if (count >= 40) {
            EXPECT_LT(shorter, 0.95 * nearest) << count;
        }
        std::printf("%d passes: ways of %.0f mm, nearest first %.0f\n", count, shorter, nearest);
    }
}

TEST(ShortOrder, OfFewPassesIsNearlyTheShortestOfAll) {
    std::mt19937 random(6);
    const Vec3 from{0, 0, 0};
    double all_shortest = 0;
    double all_found = 0;
    for (int seed = 0; seed < 20; ++seed) {
        std::vector<Pass> passes = random_passes(5, 30, random);
        for (Pass& pass : passes) pass.is_closed = false;
        double shortest = 1e9;
        std::vector<std::size_t> turn{0, 1, 2, 3, 4};
        do {
            for (unsigned ends = 0; ends < 32; ++ends) {
                std::vector<PassEntry> order;
                for (const std::size_t pass : turn) {
                    order.push_back({pass, (ends >> pass & 1U) != 0 ? passes[pass].points.size() - 1 : 0});
                }
                shortest = std::min(shortest, length_of_ways(passes, order, from));
            }
        } while (std::next_permutation(turn.begin(), turn.end()));
        const double found = length_of_ways(passes, short_order(passes, from), from);
        EXPECT_GE(found, shortest - 1e-9);
        all_shortest += shortest;
        all_found += found;
    }
    EXPECT_LT(all_found, 1.1 * all_shortest);
}

TEST(PassOrder, TakesEachOnceAndAlwaysTheNearest) {
    std::mt19937 random(3);
    std::vector<Pass> passes = random_passes(80, 40, random);
    PassOrder order(passes);
    std::set<std::size_t> left;
    for (std::size_t i = 0; i < passes.size(); ++i) left.insert(i);
    Vec3 at{-40, 90, 5};
    while (const auto entry = order.take_nearest(at)) {
        const Pass begun = begun_at(passes[entry->pass], entry->point);
        double least = 1e9;
        for (const std::size_t i : left) {
            const std::vector<PassPoint>& points = passes[i].points;
            for (std::size_t k = 0; k < points.size(); ++k) {
                if (!passes[i].is_closed && k != 0 && k + 1 != points.size()) continue;
                least = std::min(least, std::hypot(points[k].tip.x - at.x, points[k].tip.y - at.y));
            }
        }
        const Vec3 begin = begun.points.front().tip;
        EXPECT_NEAR(std::hypot(begin.x - at.x, begin.y - at.y), least, 1e-9);
        EXPECT_EQ(begun.points.size(), passes[entry->pass].points.size());
        EXPECT_EQ(left.erase(entry->pass), 1U);
        at = begun.points.back().tip;
    }
    EXPECT_TRUE(left.empty());
}

// A plate of foam 30 mm high with a tip limit at 10.
struct Plate {
    Plate() : tip(random_map(200, 200, 1, 1)) {
        std::fill(tip.height.begin(), tip.height.end(), 10.0F);
        space.cl_limit = &tip;
        space.stock = tip;
        std::fill(space.stock.height.begin(), space.stock.height.end(), 30.0F);
        space.removed = tip;
        std::fill(space.removed.height.begin(), space.removed.height.end(), std::numeric_limits<float>::infinity());
        space.centre_stock = space.stock;
        space.centre_removed = space.removed;
        space.holder_clearance_height = tip;
        std::fill(space.holder_clearance_height.height.begin(), space.holder_clearance_height.height.end(),
                  HeightField::nothing);
        space.retract = 60;
        operation.feed = 100;
        operation.approach_feed = 50;
        operation.link_feed = 300;
    }
    HeightField tip;
    MillingSpace space;
    Operation operation;
};

Pass line(Vec3 from, Vec3 to) {
    return {{{from, false}, {to, false}}, false};
}

TEST(ToolpathLinker, EntersOnARampAndComesDownToJustAboveTheFoam) {
    Plate plate;
    const CuttingTool tool = flat_tool(20);
    LinkOptions options;
    options.has_ramps = true;
    ToolpathLinker builder(plate.space, tool, plate.operation, options);
    builder.add({line({60, 100, 15}, {140, 100, 15})});
    const std::vector<PathRun> runs = builder.finish();
    ASSERT_EQ(runs.size(), 1U);
    const std::vector<PathMove>& moves = runs[0].moves;
    EXPECT_EQ(runs[0].start.z, 60);
    EXPECT_EQ(moves.back().tip.z, 60);
    EXPECT_EQ(moves.back().kind, MoveKind::retract);
    EXPECT_EQ(moves.front().kind, MoveKind::link);
    EXPECT_NEAR(moves.front().tip.z, 32, 1e-6) << "the gap above the foam";
    Vec3 at = runs[0].start;
    for (const PathMove& move : moves) {
        const double across = std::hypot(move.tip.x - at.x, move.tip.y - at.y);
        if (move.kind == MoveKind::cut && move.tip.z < at.z) {
            EXPECT_LE(at.z - move.tip.z, 0.37 * across + 1e-9) << "20 degrees";
        }
        at = move.tip;
    }
}

// To and fro over at least its own width, so that what the middle leaves is cut by the rim; a shorter pass is left out.
TEST(ToolpathLinker, AToolWhoseCentreDoesNotCutHasRampsAsLongAsItIsWide) {
    Plate plate;
    CuttingTool tool = flat_tool(20);
    tool.is_centre_cutting = false;
    LinkOptions options;
    options.has_ramps = true;
    ToolpathLinker builder(plate.space, tool, plate.operation, options);
    builder.add({line({60, 100, 28}, {140, 100, 28}), line({20, 20, 28}, {35, 20, 28})});
    Vec3 at;
    for (const PathRun& run : builder.finish()) {
        at = run.start;
        for (const PathMove& move : run.moves) {
            EXPECT_EQ(move.tip.y, 100) << "the pass of 15 mm is left out";
            const double across = std::hypot(move.tip.x - at.x, move.tip.y - at.y);
            const bool is_down = move.kind == MoveKind::cut && move.tip.z < std::min(at.z, 30.0) - 1e-9;
            if (is_down && at.z <= 30) {
                EXPECT_GE(across, 20 - 1e-9);
            }
            at = move.tip;
        }
    }
}

TEST(ToolpathLinker, StaysDownWhereTheWayMayBeCutAndGoesOverWhatMayNot) {
    Plate plate;
    const CuttingTool tool = ball_tool(12);
    const std::vector<Pass> passes{line({50, 60, 12}, {100, 60, 12}), line({100, 64, 12}, {50, 64, 12})};
    {
        Plate open;
        ToolpathLinker builder(open.space, tool, open.operation, {});
        builder.add(passes);
        const std::vector<PathRun> runs = builder.finish();
        ASSERT_EQ(runs.size(), 1U);
        for (std::size_t i = 2; i + 1 < runs[0].moves.size(); ++i) EXPECT_EQ(runs[0].moves[i].tip.z, 12);
    }
    for (std::size_t c = 0; c < 200; ++c) {
        plate.tip.height[62 * 200 + c] = 45;
        plate.space.stock.height[62 * 200 + c] = 45;
    }
    ToolpathLinker builder(plate.space, tool, plate.operation, {});
    builder.add(passes);
    const std::vector<PathRun> runs = builder.finish();
    double highest = 0;
    for (const PathRun& run : runs) {
        for (std::size_t i = 2; i + 2 < run.moves.size(); ++i) highest = std::max(highest, run.moves[i].tip.z);
    }
    EXPECT_GE(highest, 45);
}

// A wall at x = 100, 60 mm high.
HeightField wall_map() {
    HeightField target = random_map(200, 200, 1, 1);
    for (std::size_t i = 0; i < target.height.size(); ++i) target.height[i] = i % 200 < 100 ? 60.0F : 0.0F;
    return target;
}

// Retracts but for the last move of each run, of two levels along the wall.
std::size_t retracts_along_wall(bool knows_tool) {
    const CuttingTool tool = ball_tool(12);
    const HeightField target = wall_map();
    const ToolDilation dilation(target, tool);
    Plate plate;
    plate.tip = cl_surface(target, tool);
    if (knows_tool) plate.space.tool = &dilation;
    ToolpathLinker builder(plate.space, tool, plate.operation, {});
    builder.add({line({106.02, 50, 20}, {106.02, 80, 20}), line({106.02, 80, 17}, {106.02, 50, 17})});
    std::size_t retracts = 0;
    for (const PathRun& run : builder.finish()) {
        for (std::size_t i = 0; i + 1 < run.moves.size(); ++i) {
            retracts += run.moves[i].kind == MoveKind::retract ? 1 : 0;
        }
    }
    return retracts;
}

TEST(ToolpathLinker, GoesDownAlongAWallWhereTheEdgeIsBetweenMiddlesOfCells) {
    EXPECT_EQ(retracts_along_wall(true), 0U);
    EXPECT_GT(retracts_along_wall(false), 0U) << "the map alone does not tell";
}

// Below its top the wall keeps the middle of the ball 6 mm away, near the top less: a straight line from a pass below
// to one near the top is less than a cell long, seen from above, and cuts into the wall between its ends.
TEST(ToolpathLinker, NoLinkUpAlongAWallCutsIntoIt) {
    const CuttingTool tool = ball_tool(12);
    const HeightField target = wall_map();
    const ToolDilation dilation(target, tool);
    for (const double low : {20.0, 40.0, 50.0}) {
        Plate plate;
        plate.tip = cl_surface(target, tool);
        plate.space.tool = &dilation;
        ToolpathLinker builder(plate.space, tool, plate.operation, {});
        builder.add({line({106.02, 50, low}, {106.02, 80, low}), line({105.3, 80, 57.5}, {105.3, 50, 57.5})});
        for (const PathRun& run : builder.finish()) {
            Vec3 at = run.start;
            for (const PathMove& move : run.moves) {
                for (int i = 0; i <= 200; ++i) {
                    const Vec3 p = at + (i / 200.0) * (move.tip - at);
                    // As if the tool were 0.1 mm farther off.
                    ASSERT_LE(dilation.height(p.x + 0.1, p.y), p.z + 1e-3) << p.x << ' ' << p.y << ' ' << p.z;
                }
                at = move.tip;
            }
        }
    }
}

// The replay gives a rounded corner to the line that ends in it.
TEST(ToolpathLinker, ALinkIsRoundedOnlyWhereItsCornerTouchesNoFoam) {
    Plate plate;
    constexpr double level = 15;
    constexpr double edge = 110;  // foam is at x from here on; besides, a post that the first pass removes
    for (HeightField* stock : {&plate.space.stock, &plate.space.centre_stock}) {
        for (std::size_t i = 0; i < stock->height.size(); ++i) {
            const std::size_t x = i % stock->columns;
            const std::size_t y = i / stock->columns;
            const bool is_post = x > 30 && x < 50 && y > 95 && y < 105;
            if (!is_post && static_cast<double>(x) < edge) stock->height[i] = 5;
        }
    }
    plate.operation.rounding = 5;
    const CuttingTool tool = flat_tool(20);
    LinkOptions options;
    options.has_ramps = true;
    options.stay_down = 100;
    ToolpathLinker builder(plate.space, tool, plate.operation, options);
    builder.add({line({15, 100, level}, {65, 100, level}), line({97, 100, level}, {140, 100, level})});
    const std::vector<PathRun> runs = builder.finish();
    ASSERT_EQ(runs.size(), 1U);
    Vec3 at = runs[0].start;
    std::size_t links = 0;
    for (const PathMove& move : runs[0].moves) {
        if (move.kind == MoveKind::link && move.tip.z == level && at.z == level) {
            ++links;
            EXPECT_LE(move.tip.x + 0.5 * tool.diameter, edge);
            EXPECT_GT(move.tip.x + 0.5 * tool.diameter, edge - 8);
            EXPECT_LE(move.tip.x + move.rounding + 0.5 * tool.diameter, edge);
        }
        at = move.tip;
    }
    EXPECT_EQ(links, 1U);
}

// Roughing leaves the beginning of the first pass out, and all of the second, which meets a strip of 0.5 mm.
TEST(ToolpathLinker, RoughingGoesWhereItRemovesFoam) {
    Plate plate;
    constexpr double level = 15;
    const CuttingTool tool = flat_tool(20);
    for (HeightField* stock : {&plate.space.stock, &plate.space.centre_stock}) {
        for (std::size_t i = 0; i < stock->height.size(); ++i) {
            const std::size_t row = i / stock->columns;
            if (i % stock->columns < 110 || row > 150) stock->height[i] = 5;
            if (row == 170) stock->height[i] = 20;
        }
    }
    LinkOptions options;
    options.has_ramps = true;
    ToolpathLinker builder(plate.space, tool, plate.operation, options);
    builder.add({line({30, 100, level}, {140, 100, level}), line({30, 180, level}, {140, 180, level})});
    double first = std::numeric_limits<double>::infinity();
    double highest_y = 0;
    for (const PathRun& run : builder.finish()) {
        for (const PathMove& move : run.moves) {
            if (move.tip.z != level) continue;
            first = std::min(first, move.tip.x);
            highest_y = std::max(highest_y, move.tip.y);
        }
    }
    EXPECT_LT(first + 0.5 * tool.diameter, 110);
    EXPECT_GT(first + 0.5 * tool.diameter, 102);
    EXPECT_EQ(highest_y, 100);
}

TEST(ToolpathLinker, NoRunIsTooLongForAChunk) {
    Plate plate;
    Pass pass;
    for (int i = 0; i < 3000; ++i) pass.points.push_back({{20 + 0.05 * i, 100.0 + (i % 2), 12}, false});
    const CuttingTool tool = ball_tool(12);
    ToolpathLinker builder(plate.space, tool, plate.operation, {});
    builder.add({pass});
    const std::vector<PathRun> runs = builder.finish();
    EXPECT_GE(runs.size(), 3U);
    for (const PathRun& run : runs) EXPECT_LE(run.moves.size(), 1000U);
}

// The second pass lies where the first has cut, which is known only when the first has been made.
TEST(ToolpathLinker, APassThatAnotherHasMilledIsNotMade) {
    const CuttingTool tool = ball_tool(12);
    const auto cut_length = [&](double film) {
        Plate plate;
        for (HeightField* foam : {&plate.space.stock, &plate.space.centre_stock}) {
            std::fill(foam->height.begin(), foam->height.end(), 13.0F);
        }
        LinkOptions options;
        options.film = film;
        ToolpathLinker builder(plate.space, tool, plate.operation, options);
        builder.add({line({50, 60, 12}, {100, 60, 12}), line({100, 60.02, 12}, {50, 60.02, 12})});
        double length = 0;
        for (const PathRun& run : builder.finish()) {
            Vec3 at = run.start;
            for (const PathMove& move : run.moves) {
                if (move.tip.z == 12 && at.z == 12) length += norm(move.tip - at);
                at = move.tip;
            }
        }
        return length;
    };
    EXPECT_NEAR(cut_length(0), 100, 1);
    EXPECT_NEAR(cut_length(0.5), 50, 1);
}

// Roughing goes down as far as the flute cuts and comes back for the levels between. On the way up the spindle passes
// what it clears at the height where the way ends, not where it begins. Pieces of random boxes in a block of 120 mm.
TEST(Roughing, TheSpindleStaysClearOfThePieceOnAllWays) {
    CuttingTool tool;
    tool.shape = ToolShape::flat;
    tool.diameter = 10;
    tool.flute_length = 60;
    tool.stick_out = 100;
    const ToolBody body{tool.stick_out, {{44, 200}}};
    RoughingOptions options;
    options.deepest = 45;
    std::mt19937 random(7);
    for (int i = 0; i < 170; ++i) {
        Plate plate;
        HeightField piece = plate.tip;
        HeightField stock = plate.tip;
        std::fill(piece.height.begin(), piece.height.end(), 0.0F);
        std::fill(stock.height.begin(), stock.height.end(), 0.0F);
        const auto fill = [&](HeightField& map, std::size_t x, std::size_t y, std::size_t size, float top) {
            for (std::size_t row = y; row < std::min(y + size, map.rows); ++row) {
                for (std::size_t column = x; column < std::min(x + size, map.columns); ++column) {
                    float& height = map.height[row * map.columns + column];
                    height = std::max(height, top);
                }
            }
        };
        fill(stock, 30, 30, 140, 120);
        for (int k = 0; k < 8; ++k) {
            const std::size_t size = 10 + random() % 40;
            const std::size_t x = 30 + random() % (140 - size);
            const std::size_t y = 30 + random() % (140 - size);
            fill(piece, x, y, size, static_cast<float>(10 + random() % 160));
        }
        for (std::size_t k = 0; k < stock.height.size(); ++k)
            stock.height[k] = std::max(stock.height[k], piece.height[k]);
        const HeightField tip = dilate_by_disc(piece, 0.5 * tool.diameter + 1);
        plate.space.cl_limit = &tip;
        plate.space.is_limit_between = false;
        plate.space.stock = plate.space.centre_stock = stock;
        plate.space.retract = 180;
        plate.operation.kind = OperationKind::roughing;
        plate.operation.stepdown = 15;
        plate.operation.stepover = 8;
        plate.operation.allowance = 0.5;
        const HeightField under = dilate_by_disc(piece, 0.5 * body.steps[0].diameter - 1);
        for (const PathRun& run : rough(plate.space, tool, body, plate.operation, options, {}).runs) {
            Vec3 at = run.start;
            for (const PathMove& move : run.moves) {
                const auto parts = static_cast<std::size_t>(norm(move.tip - at)) + 1;
                for (std::size_t k = 0; k <= parts; ++k) {
                    const Vec3 p = at + (static_cast<double>(k) / static_cast<double>(parts)) * (move.tip - at);
                    EXPECT_LE(under.height_under(p.x, p.y), p.z + tool.stick_out)
                        << i << ": " << p.x << " " << p.y << " " << p.z << ", kind " << static_cast<int>(move.kind);
                }
                at = move.tip;
            }
        }
    }
}

TEST(Clipped, LeavesOutWhatIsDeeperThanTheFluteOrUnderTheHolder) {
    Plate plate;
    for (std::size_t r = 0; r < 200; ++r) {
        for (std::size_t c = 90; c < 200; ++c) plate.space.centre_stock.height[r * 200 + c] = 90;
    }
    const CuttingTool tool = ball_tool(12);  // with a flute of 60
    const Pass across = line({20, 50, 12}, {180, 50, 12});
    const ClippedPasses parts = clipped({across}, plate.space, tool);
    ASSERT_EQ(parts.free.size(), 1U);
    EXPECT_EQ(parts.free[0].points.front().tip.x, 20);
    EXPECT_NEAR(parts.free[0].points.back().tip.x, 85, 3);
    ASSERT_EQ(parts.blocked.size(), 1U);
    EXPECT_EQ(parts.blocked[0].points.front().tip, parts.free[0].points.back().tip);
    EXPECT_EQ(parts.blocked[0].points.back().tip.x, 180);
    for (float& height : plate.space.holder_clearance_height.height) height = 13;
    EXPECT_TRUE(clipped({across}, plate.space, tool).free.empty());
    EXPECT_EQ(clipped({line({20, 50, 40}, {180, 50, 40})}, plate.space, tool).free.size(), 1U);
}

TEST(Clipped, FreeAndBlockedPartsAddUpToThePasses) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> at(10, 190);
    const CuttingTool tool = ball_tool(12);
    Plate plate;
    for (float& height : plate.space.holder_clearance_height.height) height = random() % 9 == 0 ? 20.0F : 0.0F;
    std::vector<Pass> passes;
    for (int i = 0; i < 170; ++i) {
        Pass pass;
        for (int k = 0; k < 6; ++k) pass.points.push_back({{at(random), at(random), 12}, true});
        pass.is_closed = i % 2 == 0;
        if (pass.is_closed) pass.points.push_back(pass.points.front());
        passes.push_back(pass);
    }
    const ClippedPasses parts = clipped(passes, plate.space, tool);
    EXPECT_FALSE(parts.free.empty());
    EXPECT_FALSE(parts.blocked.empty());
    EXPECT_NEAR(length_of(parts.free) + length_of(parts.blocked), length_of(passes), 1e-6 * length_of(passes));
    for (const Pass& part : parts.free) {
        for (const PassPoint& point : part.points) {
            EXPECT_LE(plate.space.holder_clearance_height.height_under(point.tip.x, point.tip.y), point.tip.z);
        }
    }
}

TEST(Clipped, PartsOfADottedPassAreFreeAsAWholeWhenTheFoamIsGone) {
    const CuttingTool tool = ball_tool(12);
    Plate plate;
    // Blocked and free by turns of 1 mm from x = 60 on, for 40 mm, and one blocked cell beyond.
    HeightField& limit = plate.space.holder_clearance_height;
    for (std::size_t r = 0; r < limit.rows; ++r) {
        for (std::size_t c = 60; c < 100; c += 2) limit.height[r * limit.columns + c] = 50;
        limit.height[r * limit.columns + 150] = 50;
    }
    const ClippedPasses parts = clipped({line({20.1, 50, 12}, {180.3, 50, 12})}, plate.space, tool);
    ASSERT_EQ(parts.free.size(), 3U);
    ASSERT_EQ(parts.blocked.size(), 2U);
    EXPECT_NEAR(length_of(parts.blocked[0]), 40, 1);
    for (const Pass& part : parts.blocked) EXPECT_GE(length_of(part), 2 - 1e-9);
    EXPECT_NEAR(length_of(parts.free) + length_of(parts.blocked), 160.2, 1e-9);
    std::fill(limit.height.begin(), limit.height.end(), HeightField::nothing);
    EXPECT_TRUE(clipped(parts.blocked, plate.space, tool).blocked.empty());
}

TEST(NearSurface, LeavesOutWhereTheToolIsHeldAway) {
    HeightField tip;
    tip.cell = 0.25;
    tip.columns = 400;
    tip.rows = 40;
    // A wall at x = 50: lower beside it.
    for (std::size_t i = 0; i < tip.columns * tip.rows; ++i) tip.height.push_back(i % tip.columns < 200 ? 80.0F : 5.0F);
    EXPECT_EQ(near_surface({line({50.5, 1, 40}, {50.5, 9, 40})}, tip).size(), 1U) << "along the wall";
    EXPECT_TRUE(near_surface({line({70, 1, 40}, {70, 9, 40})}, tip).empty()) << "in the air";
    const std::vector<Pass> on_floor = near_surface({line({99, 5, 5}, {60, 5, 5}), line({60, 5, 5}, {52, 5, 8})}, tip);
    ASSERT_EQ(on_floor.size(), 2U);
    EXPECT_EQ(length_of(on_floor[0]), 39);
    EXPECT_LT(on_floor[1].points.back().tip.z, 7) << "where it leaves the floor";
}

TEST(RaiseToLimit, NoLineBetweenNeighboursIsBelowTheLimit) {
    const HeightField limit = random_map(12, 9, 0.5, 4);
    HeightField tip;
    tip.cell = 0.2;
    tip.columns = 30;
    tip.rows = 22;
    tip.height.assign(tip.columns * tip.rows, 20);
    FieldTiles all(tip.columns, tip.rows);
    for (std::size_t i = 0; i < tip.height.size(); ++i) all.add(i);
    raise_to_limit(tip, limit, all);
    const auto at = [&](std::size_t c, std::size_t r) {
        return Vec3{0.2 * (static_cast<double>(c) + 0.5), 0.2 * (static_cast<double>(r) + 0.5), tip.at(c, r)};
    };
    for (std::size_t r = 0; r + 1 < tip.rows; ++r) {
        for (std::size_t c = 0; c + 1 < tip.columns; ++c) {
            for (const Vec3 to : {at(c + 1, r), at(c, r + 1), at(c + 1, r + 1)}) {
                for (const double t : {0.0, 0.2, 0.4, 0.499, 0.501, 0.7, 1.0}) {
                    const Vec3 p = at(c, r) + t * (to - at(c, r));
                    ASSERT_GE(p.z + 1e-5, limit.height_under(p.x, p.y));
                }
            }
        }
    }
}

TEST(HolderClearance, KeepsEveryStepAboveTheFoam) {
    Plate plate;
    plate.space.stock.height[100 * 200 + 100] = 80;
    const HeightField limit = holder_clearance_over(plate.space.stock, {40, {{30, 50}, {120, 100}}});
    EXPECT_GE(limit.at(100 + 14, 100), 80 - 40);
    EXPECT_GE(limit.at(100 + 59, 100), 80 - 90) << "the wide step is 50 mm higher";
    EXPECT_LT(limit.at(100 + 59, 100), 80 - 40);
    EXPECT_LT(limit.at(199, 199), 0);
}

}  // namespace
}  // namespace qchopper
