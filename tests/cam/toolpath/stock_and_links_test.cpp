// Foam that stands, discs, roughing passes, the order of passes, links and times: against plain loops and closed forms.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <set>

#include "cam/toolpath/clipped_passes.h"
#include "cam/toolpath/disc_max.h"
#include "cam/toolpath/finishing_limit.h"
#include "cam/toolpath/in_process_stock.h"
#include "cam/toolpath/links.h"
#include "cam/toolpath/pass_order.h"
#include "cam/toolpath/roughing_limit.h"
#include "cam/toolpath/roughing_passes.h"
#include "cam/toolpath/time_estimate.h"
#include "cam/toolpath/tip_surface.h"
#include "tests/cam/toolpath/toolpath_pieces.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

using test_pieces::ball_tool;
using test_pieces::flat_tool;
using test_pieces::setup_of;

HeightMap random_map(std::size_t columns, std::size_t rows, double cell, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> height(0, 50);
    HeightMap map;
    map.cell = cell;
    map.columns = columns;
    map.rows = rows;
    for (std::size_t i = 0; i < columns * rows; ++i) map.height.push_back(height(random));
    return map;
}

TEST(DiscMax, IsThatOfAPlainLoop) {
    const HeightMap map = random_map(31, 23, 0.7, 1);
    for (const double radius : {0.0, 0.5, 0.7, 2.1, 5.3, 40.0}) {
        const HeightMap found = disc_max(map, radius);
        for (std::size_t r = 0; r < map.rows; ++r) {
            for (std::size_t c = 0; c < map.columns; ++c) {
                float most = HeightMap::nothing;
                for (std::size_t v = 0; v < map.rows; ++v) {
                    for (std::size_t u = 0; u < map.columns; ++u) {
                        const double x = static_cast<double>(u) - static_cast<double>(c);
                        const double y = static_cast<double>(v) - static_cast<double>(r);
                        if (x * x + y * y <= (radius / 0.7) * (radius / 0.7)) most = std::max(most, map.at(u, v));
                    }
                }
                ASSERT_EQ(found.at(c, r), most) << radius;
                const double x = 0.7 * (static_cast<double>(c) + 0.5);
                const double y = 0.7 * (static_cast<double>(r) + 0.5);
                ASSERT_GE(disc_max_at(map, x, y, radius + 1e-9), most);
            }
        }
    }
}

// A way of a tool in the map of a direction, and whether it removes a point.
struct Way {
    std::size_t direction;
    CarvingTool tool;
    Vec3 from, to;
    bool removes(Vec3 p) const {
        for (int i = 0; i <= 400; ++i) {
            const Vec3 tip = from + (i / 400.0) * (to - from);
            const double r = std::hypot(p.x - tip.x, p.y - tip.y);
            if (p.z - tip.z >= tool_profile(tool, r)) return true;
        }
        return false;
    }
};

class StockOfRandomWays {
 public:
    StockOfRandomWays(const Setup& setup, const TriangleMesh& mesh, unsigned seed) : setup_(setup), stock(setup) {
        std::mt19937 random(seed);
        std::uniform_real_distribution<double> unit(0, 1);
        for (std::size_t d = 0; d < 2; ++d) {
            HeightMap frame = target_map(setup, mesh, d, {1.3, 0, 15});
            HeightMap removed = frame;
            std::fill(removed.height.begin(), removed.height.end(), std::numeric_limits<float>::infinity());
            HeightMap other = removed;
            for (int k = 0; k < 6; ++k) {
                const auto place = [&] {
                    return Vec3{unit(random) * 1.3 * static_cast<double>(frame.columns),
                                unit(random) * 1.3 * static_cast<double>(frame.rows), 40 * unit(random) - 20};
                };
                ways.push_back({d, k % 2 == 0 ? ball_tool(12) : flat_tool(20), place(), place()});
                ToolSweep(ways.back().tool, 1.3).move(removed, other, ways.back().from, ways.back().to);
            }
            stock.remove_above(d, removed);
            frames.push_back(frame);
        }
    }
    bool is_foam(Vec3 p) const {
        return std::none_of(ways.begin(), ways.end(), [&](const Way& way) {
            return way.removes(setup_to_map(setup_, frames[way.direction], p));
        });
    }

 private:
    const Setup& setup_;

 public:
    InProcessStock stock;
    std::vector<Way> ways;
    std::vector<HeightMap> frames;
};

TEST(InProcessStock, NeverTellsLessFoamThanThereIs) {
    const TriangleMesh mesh = shapes::box({0, 0, 0}, {50, 40, 30});
    const auto setup = setup_of(mesh, 8, 50);
    std::mt19937 random(7);
    std::uniform_real_distribution<double> unit(0, 1);
    for (unsigned seed = 1; seed <= 3; ++seed) {
        const StockOfRandomWays carved(setup, mesh, seed);
        std::vector<HeightMap> highest;
        std::vector<HeightMap> lowest;
        for (std::size_t d = 0; d < 2; ++d) highest.push_back(carved.stock.highest(d, carved.frames[d]));
        for (std::size_t d = 0; d < 2; ++d) lowest.push_back(carved.stock.lowest(d, carved.frames[d]));
        std::size_t foam = 0;
        std::size_t told = 0;
        for (int k = 0; k < 20000; ++k) {
            const Vec3 size = setup.block.size;
            const Vec3 p{(unit(random) - 0.5) * size.x, (unit(random) - 0.5) * size.y,
                         unit(random) * size.z - setup.spoil};
            told += carved.stock.may_be_foam(p) ? 1 : 0;
            if (!carved.is_foam(p)) continue;
            ++foam;
            ASSERT_TRUE(carved.stock.may_be_foam(p));
            for (std::size_t d = 0; d < 2; ++d) {
                const Vec3 q = setup_to_map(setup, highest[d], p);
                const auto c = static_cast<std::size_t>(q.x / 1.3);
                const auto r = static_cast<std::size_t>(q.y / 1.3);
                ASSERT_GE(static_cast<double>(highest[d].at(c, r)), q.z - 1e-3) << seed << " direction " << d;
                ASSERT_LE(static_cast<double>(lowest[d].at(c, r)), q.z + 1e-3) << seed << " direction " << d;
            }
        }
        EXPECT_GT(foam, 1000U);
        EXPECT_LT(static_cast<double>(told), 1.35 * static_cast<double>(foam)) << "but not much more either";
    }
}

// Down or up through the middle of a cell in steps of a cell, to the first point that may be foam; none: nothing.
float first_foam(const InProcessStock& stock, const Setup& setup, const HeightMap& frame, Vec3 begin, double end) {
    const double step = end > begin.z ? frame.cell : -frame.cell;
    for (int k = 0; std::abs(step) * k < std::abs(end - begin.z); ++k) {
        const double z = begin.z + step * k;
        if (!stock.may_be_foam(map_to_setup(setup, frame, {begin.x, begin.y, z}))) continue;
        return static_cast<float>(k == 0 ? begin.z : z - step);
    }
    return HeightMap::nothing;
}

bool are_near(float a, float b) {
    return a == b || std::abs(a - b) < 1e-4F;
}

// The tilted direction has removed all above the piece, and its map is many squares wide.
TEST(InProcessStock, AlongRaysIsThatOfAPlainLoop) {
    const TriangleMesh mesh = shapes::box({0, 0, 0}, {50, 40, 30});
    const auto setup = setup_of(mesh, 8, 50);
    InProcessStock stock(setup, FoamCells::middles);
    stock.remove_above(1, target_map(setup, mesh, 1, {0.7, 0, 15}));
    const HeightMap frame = target_map(setup, mesh, 0, {0.7, 0, 15});
    const HeightMap highest = stock.highest(0, frame);
    const HeightMap lowest = stock.lowest(0, frame);
    const double bottom = setup_to_map(setup, frame, {0, 0, -setup.spoil}).z;
    const double top = bottom + setup.block.size.z;
    std::size_t between = 0;
    for (std::size_t row = 0; row < frame.rows; ++row) {
        for (std::size_t column = 0; column < frame.columns; ++column) {
            const double x = frame.cell * (static_cast<double>(column) + 0.5);
            const double y = frame.cell * (static_cast<double>(row) + 0.5);
            const float from_above = first_foam(stock, setup, frame, {x, y, top}, bottom);
            ASSERT_TRUE(are_near(highest.at(column, row), from_above)) << column << ' ' << row;
            const float from_below = first_foam(stock, setup, frame, {x, y, bottom}, top);
            ASSERT_TRUE(are_near(lowest.at(column, row), from_below)) << column << ' ' << row;
            if (from_above != HeightMap::nothing && static_cast<double>(from_above) < top - 1) ++between;
        }
    }
    EXPECT_GT(between, 1000U);
}

TEST(InProcessStock, OfAWholeBlockIsItsTop) {
    const TriangleMesh mesh = shapes::box({0, 0, 0}, {50, 40, 30});
    const auto setup = setup_of(mesh, 8);
    const HeightMap frame = target_map(setup, mesh, 0, {1, 0, 5});
    const HeightMap top = InProcessStock(setup).highest(0, frame);
    const Vec3 middle = setup_to_map(setup, frame, {0, 0, 38});
    EXPECT_NEAR(top.at(static_cast<std::size_t>(middle.x), static_cast<std::size_t>(middle.y)), middle.z, 1e-4);
    EXPECT_EQ(top.at(0, 0), HeightMap::nothing);
}

TEST(InProcessStock, OfAWholeBlockTheLowestFoamOfATiltedRayIsOnItsFarSide) {
    const TriangleMesh mesh = shapes::box({0, 0, 0}, {50, 40, 30});
    const auto setup = setup_of(mesh, 8, 50);
    const HeightMap frame = target_map(setup, mesh, 1, {1, 0, 15});
    const HeightMap lowest = InProcessStock(setup, FoamCells::middles).lowest(1, frame);
    const Vec3 half{0.5 * setup.block.size.x, 0.5 * setup.block.size.y, 0};
    std::size_t on_bottom = 0;
    std::size_t on_sides = 0;
    for (std::size_t row = 0; row < frame.rows; ++row) {
        for (std::size_t column = 0; column < frame.columns; ++column) {
            const auto z = static_cast<double>(lowest.at(column, row));
            if (lowest.at(column, row) == HeightMap::nothing) continue;
            const Vec3 p =
                map_to_setup(setup, frame, {static_cast<double>(column) + 0.5, static_cast<double>(row) + 0.5, z});
            const double beside = std::max(std::abs(p.x) - half.x, std::abs(p.y) - half.y);
            const double above = p.z + setup.spoil;
            EXPECT_NEAR(std::min(std::abs(beside), std::abs(above)), 0, 1e-3);
            ++(std::abs(beside) < std::abs(above) ? on_sides : on_bottom);
        }
    }
    EXPECT_GT(on_bottom, 500U);
    EXPECT_GT(on_sides, 500U);
}

TEST(RaiseToFoam, KeepsTheTipAtMostALevelBelowTheLowestFoamUnderTheTool) {
    const HeightMap before = random_map(40, 30, 1, 3);
    HeightMap lowest = random_map(40, 30, 1, 4);
    for (std::size_t i = 0; i < lowest.height.size(); ++i) {
        lowest.height[i] += 20;
        if (i % 40 > 12) lowest.height[i] = HeightMap::nothing;  // no foam there
    }
    HeightMap tip = before;
    raise_to_foam(tip, lowest, flat_tool(2), 5);
    std::size_t raised = 0;
    for (std::size_t row = 0; row < tip.rows; ++row) {
        for (std::size_t column = 0; column < tip.columns; ++column) {
            const float was = before.at(column, row);
            raised += tip.at(column, row) > was ? 1 : 0;
            float least = std::numeric_limits<float>::infinity();
            for (std::size_t r = 0; r < tip.rows; ++r) {
                for (std::size_t c = 0; c < tip.columns; ++c) {
                    const double far = std::hypot(static_cast<double>(c) - static_cast<double>(column),
                                                  static_cast<double>(r) - static_cast<double>(row));
                    if (far <= 1 && lowest.at(c, r) != HeightMap::nothing) least = std::min(least, lowest.at(c, r));
                }
            }
            if (least < std::numeric_limits<float>::infinity()) {
                EXPECT_LE(tip.at(column, row), std::max(was, least - 5)) << "the foam under the tool is reached";
            } else if (column > 20) {
                EXPECT_EQ(tip.at(column, row), was) << "far from all foam";
            }
            EXPECT_GE(tip.at(column, row), was);
        }
    }
    EXPECT_GT(raised, 20U);
}

LevelRegion random_region(unsigned seed) {
    std::mt19937 random(seed);
    LevelRegion region{1.5, 60, 45, {}, {}};
    const HeightMap noise = disc_max(random_map(60, 45, 1, seed), 2.3);
    for (const float height : noise.height) region.is_allowed.push_back(height < 47.5F ? 1 : 0);
    region.is_wanted.assign(region.is_allowed.size(), 1);
    for (std::size_t i = 0; i < 600; ++i) region.is_wanted[i] = 0;
    return region;
}

// Within an eighth of a cell, by which a line may pass the corner of another cell.
bool is_allowed_near(const LevelRegion& region, Vec3 p) {
    for (const double x : {-0.126, 0.126}) {
        for (const double y : {-0.126, 0.126}) {
            if (region.allowed(std::lround(p.x / 1.5 - 0.5 + x), std::lround(p.y / 1.5 - 0.5 + y))) return true;
        }
    }
    return false;
}

TEST(RoughingPasses, StayInTheRegionAndReachAllOfIt) {
    for (unsigned seed = 1; seed <= 5; ++seed) {
        const LevelRegion region = random_region(seed);
        const double step = 6;
        std::vector<Vec3> places;
        for (const Pass& pass : roughing_passes(region, 4.5, step)) {
            ASSERT_GE(pass.points.size(), 2U);
            for (std::size_t i = 1; i < pass.points.size(); ++i) {
                const Vec3 from = pass.points[i - 1].tip;
                const Vec3 way = pass.points[i].tip - from;
                for (int k = 0; k <= 100; ++k) {
                    const Vec3 p = from + (k / 100.0) * way;
                    ASSERT_EQ(p.z, 4.5);
                    ASSERT_TRUE(is_allowed_near(region, p)) << p.x << " " << p.y;
                    places.push_back(p);
                }
            }
        }
        for (std::size_t i = 0; i < region.is_allowed.size(); ++i) {
            const auto column = static_cast<std::ptrdiff_t>(i % 60);
            const auto row = static_cast<std::ptrdiff_t>(i / 60);
            // A cell alone has no way that is longer than nothing.
            const bool is_joined = region.wanted(column - 1, row) || region.wanted(column + 1, row);
            if (!region.wanted(column, row) || !is_joined) continue;
            double least = 1e9;
            for (const Vec3& p : places) {
                least = std::min(least, std::hypot(p.x - 1.5 * (static_cast<double>(column) + 0.5),
                                                   p.y - 1.5 * (static_cast<double>(row) + 0.5)));
            }
            EXPECT_LE(least, 0.5 * step + 1.5) << seed << ": " << column << " " << row;
        }
    }
}

TEST(PassOrder, TakesEachOnceAndAlwaysTheNearest) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> unit(0, 100);
    std::vector<Pass> passes;
    for (int i = 0; i < 80; ++i) {
        Pass pass;
        for (int k = 0; k < 3; ++k) pass.points.push_back({{unit(random), 0.3 * unit(random), 0}, false});
        pass.is_closed = i % 4 == 0;
        if (pass.is_closed) pass.points.push_back(pass.points.front());
        passes.push_back(pass);
    }
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
        space.tip_limit = &tip;
        space.foam = tip;
        std::fill(space.foam.height.begin(), space.foam.height.end(), 30.0F);
        space.removed = tip;
        std::fill(space.removed.height.begin(), space.removed.height.end(), std::numeric_limits<float>::infinity());
        space.middle_foam = space.foam;
        space.middle_removed = space.removed;
        space.holder_limit = tip;
        std::fill(space.holder_limit.height.begin(), space.holder_limit.height.end(), HeightMap::nothing);
        space.retract = 60;
        operation.feed = 100;
        operation.approach_feed = 50;
        operation.link_feed = 300;
    }
    HeightMap tip;
    CarvingSpace space;
    Operation operation;
};

Pass line(Vec3 from, Vec3 to) {
    return {{{from, false}, {to, false}}, false};
}

TEST(RunBuilder, EntersOnARampAndComesDownToJustAboveTheFoam) {
    Plate plate;
    const CarvingTool tool = flat_tool(20);
    LinkOptions options;
    options.has_ramps = true;
    RunBuilder builder(plate.space, tool, plate.operation, options);
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

TEST(RunBuilder, StaysDownWhereTheWayMayBeCutAndGoesOverWhatMayNot) {
    Plate plate;
    const CarvingTool tool = ball_tool(12);
    const std::vector<Pass> passes{line({50, 60, 12}, {100, 60, 12}), line({100, 64, 12}, {50, 64, 12})};
    {
        Plate open;
        RunBuilder builder(open.space, tool, open.operation, {});
        builder.add(passes);
        const std::vector<PathRun> runs = builder.finish();
        ASSERT_EQ(runs.size(), 1U);
        for (std::size_t i = 2; i + 1 < runs[0].moves.size(); ++i) EXPECT_EQ(runs[0].moves[i].tip.z, 12);
    }
    for (std::size_t c = 0; c < 200; ++c) {
        plate.tip.height[62 * 200 + c] = 45;
        plate.space.foam.height[62 * 200 + c] = 45;
    }
    RunBuilder builder(plate.space, tool, plate.operation, {});
    builder.add(passes);
    const std::vector<PathRun> runs = builder.finish();
    double highest = 0;
    for (const PathRun& run : runs) {
        for (std::size_t i = 2; i + 2 < run.moves.size(); ++i) highest = std::max(highest, run.moves[i].tip.z);
    }
    EXPECT_GE(highest, 45);
}

// Retracts but for the last move of each run, of two levels along a wall at x = 100.
std::size_t retracts_along_wall(bool knows_tool) {
    const CarvingTool tool = ball_tool(12);
    HeightMap target = random_map(200, 200, 1, 1);
    for (std::size_t i = 0; i < target.height.size(); ++i) target.height[i] = i % 200 < 100 ? 60.0F : 0.0F;
    const TipDilation dilation(target, tool);
    Plate plate;
    plate.tip = tip_surface(target, tool);
    if (knows_tool) plate.space.tool = &dilation;
    RunBuilder builder(plate.space, tool, plate.operation, {});
    builder.add({line({106.02, 50, 20}, {106.02, 80, 20}), line({106.02, 80, 17}, {106.02, 50, 17})});
    std::size_t retracts = 0;
    for (const PathRun& run : builder.finish()) {
        for (std::size_t i = 0; i + 1 < run.moves.size(); ++i) {
            retracts += run.moves[i].kind == MoveKind::retract ? 1 : 0;
        }
    }
    return retracts;
}

TEST(RunBuilder, GoesDownAlongAWallWhereTheEdgeIsBetweenMiddlesOfCells) {
    EXPECT_EQ(retracts_along_wall(true), 0U);
    EXPECT_GT(retracts_along_wall(false), 0U) << "the map alone does not tell";
}

TEST(RunBuilder, NoRunIsTooLongForAChunk) {
    Plate plate;
    Pass pass;
    for (int i = 0; i < 3000; ++i) pass.points.push_back({{20 + 0.05 * i, 100.0 + (i % 2), 12}, false});
    RunBuilder builder(plate.space, ball_tool(12), plate.operation, {});
    builder.add({pass});
    const std::vector<PathRun> runs = builder.finish();
    EXPECT_GE(runs.size(), 3U);
    for (const PathRun& run : runs) EXPECT_LE(run.moves.size(), 1000U);
}

TEST(Clipped, LeavesOutWhatIsDeeperThanTheFluteOrUnderTheHolder) {
    Plate plate;
    for (std::size_t r = 0; r < 200; ++r) {
        for (std::size_t c = 90; c < 200; ++c) plate.space.middle_foam.height[r * 200 + c] = 90;
    }
    const CarvingTool tool = ball_tool(12);  // with a flute of 60
    const Pass across = line({20, 50, 12}, {180, 50, 12});
    const ClippedPasses parts = clipped({across}, plate.space, tool);
    ASSERT_EQ(parts.free.size(), 1U);
    EXPECT_EQ(parts.free[0].points.front().tip.x, 20);
    EXPECT_NEAR(parts.free[0].points.back().tip.x, 85, 3);
    ASSERT_EQ(parts.blocked.size(), 1U);
    EXPECT_EQ(parts.blocked[0].points.front().tip, parts.free[0].points.back().tip);
    EXPECT_EQ(parts.blocked[0].points.back().tip.x, 180);
    for (float& height : plate.space.holder_limit.height) height = 13;
    EXPECT_TRUE(clipped({across}, plate.space, tool).free.empty());
    EXPECT_EQ(clipped({line({20, 50, 40}, {180, 50, 40})}, plate.space, tool).free.size(), 1U);
}

TEST(Clipped, FreeAndBlockedPartsAddUpToThePasses) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> at(10, 190);
    const CarvingTool tool = ball_tool(12);
    Plate plate;
    for (float& height : plate.space.holder_limit.height) height = random() % 9 == 0 ? 20.0F : 0.0F;
    std::vector<Pass> passes;
    for (int i = 0; i < 40; ++i) {
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
            EXPECT_LE(least_height(plate.space.holder_limit, point.tip.x, point.tip.y), point.tip.z);
        }
    }
}

TEST(Clipped, PartsOfADottedPassAreFreeAsAWholeWhenTheFoamIsGone) {
    const CarvingTool tool = ball_tool(12);
    Plate plate;
    // Blocked and free by turns of 1 mm from x = 60 on, for 40 mm, and one blocked cell beyond.
    HeightMap& limit = plate.space.holder_limit;
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
    std::fill(limit.height.begin(), limit.height.end(), HeightMap::nothing);
    EXPECT_TRUE(clipped(parts.blocked, plate.space, tool).blocked.empty());
}

TEST(NearSurface, LeavesOutWhereTheToolIsHeldAway) {
    HeightMap tip;
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
    const HeightMap limit = random_map(12, 9, 0.5, 4);
    HeightMap tip;
    tip.cell = 0.2;
    tip.columns = 30;
    tip.rows = 22;
    tip.height.assign(tip.columns * tip.rows, 20);
    raise_to_limit(tip, limit);
    const auto at = [&](std::size_t c, std::size_t r) {
        return Vec3{0.2 * (static_cast<double>(c) + 0.5), 0.2 * (static_cast<double>(r) + 0.5), tip.at(c, r)};
    };
    for (std::size_t r = 0; r + 1 < tip.rows; ++r) {
        for (std::size_t c = 0; c + 1 < tip.columns; ++c) {
            for (const Vec3 to : {at(c + 1, r), at(c, r + 1), at(c + 1, r + 1)}) {
                for (const double t : {0.0, 0.2, 0.4, 0.499, 0.501, 0.7, 1.0}) {
                    const Vec3 p = at(c, r) + t * (to - at(c, r));
                    ASSERT_GE(p.z + 1e-5, least_height(limit, p.x, p.y));
                }
            }
        }
    }
}

TEST(HolderLimit, KeepsEveryStepAboveTheFoam) {
    Plate plate;
    plate.space.foam.height[100 * 200 + 100] = 80;
    const HeightMap limit = holder_limit_over(plate.space.foam, {40, {{30, 50}, {120, 100}}});
    EXPECT_GE(limit.at(100 + 14, 100), 80 - 40);
    EXPECT_GE(limit.at(100 + 59, 100), 80 - 90) << "the wide step is 50 mm higher";
    EXPECT_LT(limit.at(100 + 59, 100), 80 - 40);
    EXPECT_LT(limit.at(199, 199), 0);
}

TEST(TimeEstimate, OfAMoveIsATrapezoidOrATriangle) {
    EXPECT_NEAR(move_seconds(100, 100, 0, 0, 2000), 100 / 100.0 + 100 / 2000.0, 1e-12);
    EXPECT_NEAR(move_seconds(2, 100, 0, 0, 2000), 2 * std::sqrt(2 / 2000.0), 1e-12) << "the feed is not reached";
    EXPECT_NEAR(move_seconds(50, 100, 100, 100, 2000), 0.5, 1e-12);
    EXPECT_EQ(move_seconds(0, 100, 0, 0, 2000), 0);
}

TEST(TimeEstimate, CountsStopsAtCornersThatAreNotRounded) {
    Toolpath path;
    Operation operation;
    operation.feed = operation.approach_feed = operation.link_feed = 100;
    operation.rounding = 2;
    const auto with_corner = [&](bool is_rounded) {
        Toolpath one;
        Operation own = operation;
        own.runs = {{{0, 0, 0}, {{{100, 0, 0}, MoveKind::cut, is_rounded}, {{100, 100, 0}, MoveKind::retract, false}}}};
        one.operations = {own};
        TimeSettings settings;
        settings.direction_s = 0;
        return time_estimate(one, settings).total_s();
    };
    EXPECT_NEAR(with_corner(false), 2 * 1.05, 1e-9);
    EXPECT_LT(with_corner(true), 2.1 - 0.02);
    EXPECT_GT(with_corner(true), 2.05) << "the corner is passed below the feed";
    path.operations = {operation, operation};
    path.operations[1].tool = 3;
    TimeSettings settings;
    EXPECT_EQ(time_estimate(path, settings).total_s(), settings.tool_change_s + 2 * settings.direction_s);
}

}  // namespace
}  // namespace qchopper
