// Toolpaths of small pieces, milled once more by a plain replay; bad settings; the same for any number of threads.

#include "cam/toolpath/make_toolpath.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <limits>
#include <string>

#include "base/error.h"
#include "base/parallel.h"
#include "tests/cam/cell/short_tools.h"
#include "tests/cam/toolpath/plain_replay.h"
#include "tests/cam/toolpath/toolpath_pieces.h"
#include "tests/shapes.h"

namespace qchopper {
namespace {

using test_pieces::bumpy;
using test_pieces::PlainReplay;
using test_pieces::setup_of;

Cell ready_cell(const std::string& name = "kr60-ha.toml") {
    return with_short_tools(read_cell(std::filesystem::path(QCHOPPER_SOURCE_DIR) / "cells" / name));
}

ToolpathSettings coarse_settings() {
    ToolpathSettings settings;
    settings.cell = 0.5;
    return settings;
}

void expect_clean(const PlainReplay& replay, const std::string& name) {
    EXPECT_EQ(replay.faults().link_in_stock, 0U) << name << ": " << replay.faults().first;
    EXPECT_EQ(replay.faults().above_flute, 0U) << name << ": " << replay.faults().first;
    EXPECT_EQ(replay.faults().holder, 0U) << name << ": " << replay.faults().first;
    EXPECT_EQ(replay.faults().below_spoil, 0U) << name << ": " << replay.faults().first;
    EXPECT_EQ(replay.faults().not_at_retract, 0U) << name << ": " << replay.faults().first;
}

TEST(MakeToolpath, RoughingOfABoxLeavesTheAllowanceAndNothingElse) {
    const TriangleMesh mesh = shapes::box({0, 0, 0}, {60, 40, 50});
    const auto setup = setup_of(mesh, 18);
    const Cell cell = ready_cell();
    const Toolpath path = make_toolpath(setup, mesh, cell, coarse_settings());
    ASSERT_FALSE(path.operations.empty());
    const Operation& first = path.operations.front();
    ASSERT_EQ(first.kind, OperationKind::roughing);
    PlainReplay replay(setup, cell, 2.5);
    replay.mill(first);
    expect_clean(replay, "box");
    std::size_t left = 0;
    for (std::size_t i = 0; i < replay.points().size(); ++i) {
        const Vec3 p = replay.points()[i];
        const Vec3 beside{std::max(0.0, std::abs(p.x) - 30), std::max(0.0, std::abs(p.y) - 20),
                          std::max(0.0, p.z - 50)};
        const bool is_piece = beside == Vec3{0, 0, 0} && p.z >= 0;
        if (is_piece || norm(beside) < first.allowance - 0.3) {
            EXPECT_TRUE(replay.is_stock(i) || p.z < 0) << p.x << " " << p.y << " " << p.z;
        }
        // On the floor, around the piece as far as a cell of the map may lie, and in the corner between both.
        if (!replay.is_stock(i) || p.z < first.allowance + 0.1) continue;
        // Above the piece a level may end nowhere nearer than the height of one.
        const bool is_far = std::max(beside.x, beside.y) > first.allowance + 3.5;
        if (is_far || beside.z > first.allowance + first.stepdown) ++left;
    }
    EXPECT_EQ(left, 0U);
}

TEST(MakeToolpath, EachOperationIsAskedAsSoonAsItIsMade) {
    const TriangleMesh mesh = shapes::box({0, 0, 0}, {60, 40, 50});
    const auto setup = setup_of(mesh, 18);
    std::vector<Operation> asked;
    const OperationCheck keep = [&](const std::vector<Operation>& so_far) {
        ASSERT_EQ(so_far.size(), asked.size() + 1);
        asked.push_back(so_far.back());
    };
    const Toolpath path = make_toolpath(setup, mesh, ready_cell(), coarse_settings(), {}, nullptr, keep);
    EXPECT_EQ(path.operations, asked);
    ASSERT_GT(asked.size(), 1U);
    int times = 0;
    const OperationCheck refuse = [&](const std::vector<Operation>&) {
        ++times;
        throw InputError(InputFault::use, "out of reach", "");
    };
    EXPECT_THROW(make_toolpath(setup, mesh, ready_cell(), coarse_settings(), {}, nullptr, refuse), InputError);
    EXPECT_EQ(times, 1) << "nothing is made after it";
}

// Levels that are evenly spaced would leave up to the height of one on it, which finishing would have to cut.
TEST(MakeToolpath, RoughingLeavesTheAllowanceAloneOnALargeFlat) {
    constexpr double half = 80;
    constexpr double high = 45;
    const auto setup = setup_of(shapes::box({-half, -half, 0}, {half, half, high}), 18);
    const TriangleMesh mesh = shapes::box({-half, -half, 0}, {half, half, high});
    const Cell cell = ready_cell();
    const Toolpath path = make_toolpath(setup, mesh, cell, coarse_settings());
    const Operation& first = path.operations.front();
    ASSERT_EQ(first.kind, OperationKind::roughing);
    PlainReplay replay(setup, cell, 2.5);
    replay.mill(first);
    expect_clean(replay, "flat");
    std::size_t above = 0;
    for (std::size_t i = 0; i < replay.points().size(); ++i) {
        const Vec3 p = replay.points()[i];
        if (std::max(std::abs(p.x), std::abs(p.y)) > half || p.z <= high) continue;
        ++above;
        const double over = p.z - high - first.allowance;
        if (over > -0.3 && over < 0.5) continue;
        EXPECT_EQ(replay.is_stock(i), over < 0) << p.x << " " << p.y << " " << p.z;
    }
    EXPECT_GT(above, 1000U);
}

TEST(MakeToolpath, AToolWithLessFeedGoesTheSameWay) {
    const TriangleMesh mesh = shapes::box({0, 0, 0}, {60, 40, 50});
    const auto setup = setup_of(mesh, 18);
    const Cell cell = ready_cell();
    ToolpathSettings settings = coarse_settings();
    const Toolpath usual = make_toolpath(setup, mesh, cell, settings);
    const CuttingTool& slowed = cell.machine->tools[usual.operations.front().tool];
    settings.feed_shares[slowed.number] = 0.6;
    const double feed = std::max(slowed.feed_min_mm_per_s, 0.6 * slowed.feed_max_mm_per_s);
    const Toolpath slow = make_toolpath(setup, mesh, cell, settings);
    ASSERT_EQ(slow.operations.size(), usual.operations.size());
    for (std::size_t i = 0; i < usual.operations.size(); ++i) {
        const Operation& now = slow.operations[i];
        const Operation& before = usual.operations[i];
        ASSERT_EQ(now.tool, before.tool);
        const bool is_slowed = now.tool == usual.operations.front().tool;
        EXPECT_EQ(now.feed, is_slowed ? feed : before.feed);
        ASSERT_EQ(now.runs.size(), before.runs.size());
        for (std::size_t r = 0; r < now.runs.size(); ++r) {
            ASSERT_EQ(now.runs[r].moves.size(), before.runs[r].moves.size());
            for (std::size_t m = 0; m < now.runs[r].moves.size(); ++m) {
                const PathMove& move = now.runs[r].moves[m];
                EXPECT_EQ(move.tip, before.runs[r].moves[m].tip);
                if (is_slowed && move.kind == MoveKind::cut) {
                    EXPECT_LE(feed_of(now, move), feed);
                }
            }
        }
    }
}

TEST(MakeToolpath, EveryOperationIsCleanInAPlainReplay) {
    const Cell cell = ready_cell();
    const auto mill = [&](const TriangleMesh& mesh, double tilt, const std::string& name) {
        const auto setup = setup_of(mesh, 8, tilt);
        PlainReplay replay(setup, cell, 3);
        for (const Operation& operation : make_toolpath(setup, mesh, cell, coarse_settings()).operations) {
            replay.mill(operation);
            expect_clean(replay, name + ", tool " + std::to_string(operation.tool) + ", direction " +
                                     std::to_string(operation.orientation));
        }
    };
    mill(bumpy(50, 16, 40, 4), 45, "tilted bumps");
    mill(shapes::ball({0, 0, 0}, 25, 24), 60, "ball");
}

// Of a ball milled along two directions: bodies without a crevice, where fine finishing has little to do.
TEST(MakeToolpath, EachBallEndedToolIsUsedAlongADirectionOrListedWithTheReason) {
    const TriangleMesh mesh = shapes::ball({0, 0, 0}, 25, 24);
    const auto setup = setup_of(mesh, 8, 60);
    const Cell cell = ready_cell();
    const Toolpath path = make_toolpath(setup, mesh, cell, coarse_settings());
    std::size_t listed = 0;
    for (const std::size_t tool : {0, 2, 3}) {  // the balls of 20, 12 and 6 mm
        for (std::size_t d = 0; d < setup.access.orientations.size(); ++d) {
            const bool is_used = std::any_of(
                path.operations.begin(), path.operations.end(),
                [&](const Operation& operation) { return operation.tool == tool && operation.orientation == d; });
            const auto count = std::count_if(path.unused.begin(), path.unused.end(), [&](const UnusedTool& unused) {
                EXPECT_FALSE(unused.because.empty());
                return unused.tool.value_or(tool) == tool && unused.orientation.value_or(d) == d;
            });
            EXPECT_EQ(count, is_used ? 0 : 1) << tool << " " << d;
            listed += static_cast<std::size_t>(count);
        }
    }
    EXPECT_GT(listed, 0U);
    const auto left_out = std::find_if(path.unused.begin(), path.unused.end(), [](const UnusedTool& unused) {
        return unused.tool.has_value() && !unused.orientation.has_value();
    });
    ASSERT_NE(left_out, path.unused.end());
    EXPECT_EQ(left_out->because.substr(0, 14), "tool 8 roughs,");
    EXPECT_NE(left_out->because.find("or add less than 0.3 % of the surface"), std::string::npos);
}

// The cells of the foam follow from the finest tool, those of the piece do not.
TEST(MakeToolpath, ABallOfAnySizeTouchesABoxOnAllItsSides) {
    const TriangleMesh mesh = shapes::box({0, 0, 0}, {60, 40, 30});
    const auto setup = setup_of(mesh, 18);
    const Cell cell = ready_cell();
    for (const std::size_t tool : {0, 3}) {  // the balls of 20 and 6 mm
        ToolpathSettings settings;
        settings.finishing_tools = {tool};
        const double radius = 0.5 * cell.machine->tools[tool].diameter;
        std::array<double, 4> nearest;  // of the centre of the ball to each side, where it passes beside the box
        nearest.fill(std::numeric_limits<double>::infinity());
        for (const Operation& operation : make_toolpath(setup, mesh, cell, settings).operations) {
            if (operation.kind == OperationKind::roughing) continue;
            for (const PathRun& run : operation.runs) {
                Vec3 from = run.start;
                for (const PathMove& move : run.moves) {
                    // The middle: a pass round the box has its ends beside corners.
                    const Vec3 centre = 0.5 * (from + move.tip) + Vec3{0, 0, radius};
                    from = move.tip;
                    if (move.kind != MoveKind::cut || centre.z > 30) continue;
                    const std::array<double, 4> away{centre.x - 30, -30 - centre.x, centre.y - 20, -20 - centre.y};
                    const bool is_beside_one = std::ranges::count_if(away, [](double a) { return a > 0; }) == 1;
                    for (std::size_t k = 0; k < away.size() && is_beside_one; ++k) {
                        if (away[k] > 0) nearest[k] = std::min(nearest[k], away[k]);
                    }
                }
            }
        }
        for (const double side : nearest) EXPECT_NEAR(side, radius, 0.2) << "radius " << radius;
    }
}

TEST(MakeToolpath, LeavesABallAndNothingAboveIt) {
    const TriangleMesh mesh = shapes::ball({0, 0, 0}, 25, 32);
    const auto setup = setup_of(mesh, 8, 60);
    const Cell cell = ready_cell();
    PlainReplay replay(setup, cell, 2.3);
    const Toolpath path = make_toolpath(setup, mesh, cell, coarse_settings());
    for (const Operation& operation : path.operations) replay.mill(operation);
    for (std::size_t i = 0; i < replay.points().size(); ++i) {
        const Vec3 p = replay.points()[i];
        const double r = norm(p - Vec3{0, 0, 25});
        // The facets lie up to 0.12 mm inside of the ball; a gouge of 0.25 mm is too much.
        const bool is_piece = r < 25 - 0.37;
        ASSERT_TRUE(!is_piece || replay.is_stock(i)) << p.x << " " << p.y << " " << p.z;
        // Scallop height, path tolerance and two cells of the map.
        const bool is_away = r > 25 + 1.4 && p.z > 25;
        ASSERT_FALSE(is_away && replay.is_stock(i)) << p.x << " " << p.y << " " << p.z;
    }
}

TEST(MakeToolpath, TiltedToolsGoBelowTheBaseToReachWhatLeansOverIt) {
    const TriangleMesh mesh = shapes::ball({0, 0, 0}, 25, 24);
    const auto setup = setup_of(mesh, 8, 60);
    const Cell cell = ready_cell();
    double lowest = 0;
    ToolpathSettings settings = coarse_settings();
    settings.finishing_tools = {2};  // the ball of 12 mm
    for (const Operation& operation : make_toolpath(setup, mesh, cell, settings).operations) {
        for (const PathRun& run : operation.runs) {
            for (const PathMove& move : run.moves) lowest = std::min(lowest, move.tip.z);
        }
    }
    // The ball stands on its lowest point; the tip of a tool that leans by 60 degrees comes under it.
    EXPECT_LT(lowest, -0.5 * 12 - 0.5);
    EXPECT_GE(lowest, -setup.spoil + 2 - 1e-6);
}

TEST(MakeToolpath, HolderAndSpindleStayClearBesideATallPiece) {
    // A tower of 200 mm with a stick-out of 150: the holder is deep beside it.
    const TriangleMesh mesh =
        shapes::joined({shapes::box({-40, -40, 0}, {40, 40, 20}), shapes::box({-10, -10, 20}, {10, 10, 200})});
    const auto setup = setup_of(mesh, 5, 30);
    const Cell cell = ready_cell();
    PlainReplay replay(setup, cell, 4);
    const Toolpath path = make_toolpath(setup, mesh, cell, coarse_settings());
    for (const Operation& operation : path.operations) replay.mill(operation);
    expect_clean(replay, "tower");
}

TEST(MakeToolpath, MillsTheFootOfAWallThatTheHolderJustPasses) {
    // Above 160 mm the tower stands 13 mm farther in: the holder of the finishing tool (radius 16, 150 mm above the
    // tip) passes it while the tool (radius 6) mills the foot, but not before the allowance on the tower is gone.
    const TriangleMesh mesh =
        shapes::joined({shapes::box({-20, -20, 0}, {20, 20, 160}), shapes::box({-7, -7, 160}, {7, 7, 190})});
    const auto setup = setup_of(mesh, 5);
    const Cell cell = ready_cell();
    PlainReplay replay(setup, cell, 3.1);
    for (const Operation& operation : make_toolpath(setup, mesh, cell, coarse_settings()).operations) {
        if (operation.kind != OperationKind::fine_finishing) replay.mill(operation);
    }
    expect_clean(replay, "tower");
    for (std::size_t i = 0; i < replay.points().size(); ++i) {
        const Vec3 p = replay.points()[i];
        const double beside = std::max(std::abs(p.x), std::abs(p.y)) - 20;
        const bool is_at_foot = beside > 0.8 && p.z > 18 && p.z < 150;
        ASSERT_FALSE(is_at_foot && replay.is_stock(i)) << p.x << " " << p.y << " " << p.z;
    }
}

TEST(MakeToolpath, FinishesAWallDownToWhereTheHolderMeetsItsTop) {
    // The holder of the finishing tool, 150 mm above its tip, lets the tip come to a height of 50 beside the wall.
    const TriangleMesh mesh = shapes::box({0, 0, 0}, {16, 16, 200});
    const auto setup = setup_of(mesh, 5);
    const Cell cell = ready_cell();
    ToolpathSettings settings;
    settings.finishing_tools = {2};  // the ball of 12 mm
    PlainReplay replay(setup, cell, 1.9);
    double on_air = 0;  // length of cuts that come nowhere near the piece
    for (const Operation& operation : make_toolpath(setup, mesh, cell, settings).operations) {
        replay.mill(operation);
        if (operation.kind != OperationKind::finishing) continue;
        for (const PathRun& run : operation.runs) {
            Vec3 at = run.start;
            for (const PathMove& move : run.moves) {
                const bool is_far = std::max(std::abs(move.tip.x), std::abs(move.tip.y)) > 8 + 6 + 1.5;
                if (move.kind == MoveKind::cut && is_far && move.tip.z > 2) on_air += norm(move.tip - at);
                at = move.tip;
            }
        }
    }
    expect_clean(replay, "wall");
    EXPECT_LT(on_air, 200) << "along the limit of the holder nothing is finished";
    for (std::size_t i = 0; i < replay.points().size(); ++i) {
        const Vec3 p = replay.points()[i];
        const double beside = std::max(std::abs(p.x), std::abs(p.y)) - 8;
        const bool is_on_wall = beside > 0.8 && beside < 4.5 && p.z > 53.8 && p.z < 190;
        ASSERT_FALSE(is_on_wall && replay.is_stock(i)) << p.x << " " << p.y << " " << p.z;
    }
}

// A wall on a plate, and tools with wide holders: foam that stands beside the wall, because no direction comes to it,
// keeps them away from the plate.
struct WallAndPlate {
    TriangleMesh mesh = shapes::joined({shapes::box({0, 0, 0}, {160, 30, 10}), shapes::box({0, 0, 10}, {20, 30, 330})});
    Setup setup;
    Cell cell = ready_cell();

    explicit WallAndPlate(double tilt_deg) : setup(setup_of(mesh, 2, tilt_deg)) {
        cell.machine->spindle.body_radius = 0;
        for (CuttingTool& tool : cell.machine->tools) tool.holder = {{120, 50}};
    }
};

TEST(MakeToolpath, SurfaceThatStaysBlockedIsLeftToAnotherDirection) {
    // Seen from above the tip may come to x = 80, but foam stands as far as x = 50 and up to z = 180: the holder meets
    // it where the tip is nearer than x = 110. In the other direction, 8 degrees from there, the holder is farther
    // away.
    const WallAndPlate piece(8);
    ToolpathSettings settings = coarse_settings();
    settings.finishing_tools = {2};  // the ball of 12 mm
    double from_above = 0;
    double tilted = 0;
    const Toolpath path = make_toolpath(piece.setup, piece.mesh, piece.cell, settings);
    for (const Operation& operation : path.operations) {
        if (operation.kind != OperationKind::finishing) continue;
        for (const PathRun& run : operation.runs) {
            Vec3 at = run.start;
            for (const PathMove& move : run.moves) {
                // On the plate, whose middle is at x = 80 in the mesh.
                const bool is_in = std::abs(move.tip.z - 10) < 1 && move.tip.x > 15 && move.tip.x < 25;
                if (move.kind == MoveKind::cut && is_in)
                    (operation.orientation == 0 ? from_above : tilted) += norm(move.tip - at);
                at = move.tip;
            }
        }
    }
    EXPECT_LT(from_above, 1);
    EXPECT_GT(tilted, 50);
}

TEST(MakeToolpath, PassesThatFoamBlocksAreTakenUpAgainWhenAnotherDirectionHasRemovedIt) {
    // Roughing from both directions leaves foam on the wall, which the holder meets until the tilted tool finishes it.
    const WallAndPlate piece(30);
    ToolpathSettings settings = coarse_settings();
    settings.finishing_tools = {2};  // the ball of 12 mm
    bool has_tilted = false;
    double again = 0;
    for (const Operation& operation : make_toolpath(piece.setup, piece.mesh, piece.cell, settings).operations) {
        if (operation.kind != OperationKind::finishing) continue;
        has_tilted = has_tilted || operation.orientation == 1;
        if (operation.orientation != 0 || !has_tilted) continue;
        for (const PathRun& run : operation.runs) {
            Vec3 at = run.start;
            for (const PathMove& move : run.moves) {
                if (move.kind == MoveKind::cut) again += norm(move.tip - at);
                at = move.tip;
            }
        }
    }
    EXPECT_GT(again, 50);
}

TEST(MakeToolpath, RoughingStaysBesideTheBlockAsNarrowAsItIsAsked) {
    const TriangleMesh mesh = shapes::box({0, 0, 0}, {40, 30, 60});
    const auto setup = setup_of(mesh, 5, 40);
    const Cell cell = ready_cell();
    const auto farthest = [&](const ToolpathSettings& settings) {
        double most = 0;
        PlainReplay replay(setup, cell, 2.5);
        for (const Operation& operation : make_toolpath(setup, mesh, cell, settings).operations) {
            replay.mill(operation);
            if (operation.kind != OperationKind::roughing || operation.orientation != 0) continue;
            for (const PathRun& run : operation.runs) {
                for (const PathMove& move : run.moves) {
                    most = std::max({most, std::abs(move.tip.x) - 25, std::abs(move.tip.y) - 20});
                }
            }
        }
        expect_clean(replay, "box");
        return most;
    };
    ToolpathSettings settings = coarse_settings();
    EXPECT_GT(farthest(settings), 6);
    settings.beside_block = 2;
    const double narrow = farthest(settings);
    EXPECT_LE(narrow, 2.5);
    EXPECT_GT(narrow, 0.5);
}

TEST(MakeToolpath, ATiltedToolStaysBesideTheFoamThatItRoughs) {
    // Under the plate stands foam that is thicker than finishing cuts.
    const TriangleMesh mesh =
        shapes::joined({shapes::box({-10, -10, 0}, {10, 10, 80}), shapes::box({-70, -70, 80}, {70, 70, 95})});
    const auto setup = setup_of(mesh, 10, 50);
    const Cell cell = ready_cell();
    const Vec3 half{0.5 * setup.block.size.x, 0.5 * setup.block.size.y, 0};
    std::size_t cuts = 0;
    for (const Operation& operation : make_toolpath(setup, mesh, cell, coarse_settings()).operations) {
        if (operation.kind != OperationKind::roughing || operation.orientation != 1) continue;
        // A level under the lowest foam, the radius beside it, and some cells for the map.
        const double most = operation.stepdown + 0.5 * cell.machine->tools[operation.tool].diameter + 12;
        for (const PathRun& run : operation.runs) {
            for (const PathMove& move : run.moves) {
                if (move.kind != MoveKind::cut) continue;
                ++cuts;
                EXPECT_LE(std::hypot(std::max(0.0, std::abs(move.tip.x) - half.x),
                                     std::max(0.0, std::abs(move.tip.y) - half.y)),
                          most);
            }
        }
    }
    EXPECT_GT(cuts, 50U);
}

TEST(MakeToolpath, NeverCutsFoamAboveTheFlute) {
    // The wall is nearly twice as high as the flute of the finishing tool (80 mm), and roughing leaves a skin on it.
    const TriangleMesh mesh = shapes::box({0, 0, 0}, {24, 24, 150});
    const auto setup = setup_of(mesh, 9);
    const Cell cell = ready_cell();
    ToolpathSettings settings = coarse_settings();
    settings.finishing_tools = {2};  // the ball of 12 mm
    PlainReplay replay(setup, cell, 2.1);
    for (const Operation& operation : make_toolpath(setup, mesh, cell, settings).operations) replay.mill(operation);
    expect_clean(replay, "tall box");
}

// A flat tool roughs the hole of a ring, whose levels are entered from above. Finishing, of which no tool without a
// centre is taken, shows that the replay sees what goes straight down.
TEST(MakeToolpath, AToolWhoseCentreDoesNotCutNeverPlunges) {
    const TriangleMesh mesh = shapes::torus({0, 0, 15}, 70, 18);
    const auto setup = setup_of(mesh, 9);
    Cell cell = ready_cell();
    ToolpathSettings settings = coarse_settings();
    settings.roughing_tool = 1;
    ASSERT_EQ(cell.machine->tools[1].shape, ToolShape::flat);
    cell.machine->tools[1].is_centre_cutting = false;
    const Toolpath path = make_toolpath(setup, mesh, cell, settings);
    for (CuttingTool& tool : cell.machine->tools) tool.is_centre_cutting = false;
    PlainReplay replay(setup, cell, 2.1);
    for (const Operation& operation : path.operations) {
        const std::size_t before = replay.faults().plunge;
        replay.mill(operation);
        if (operation.kind == OperationKind::roughing) {
            EXPECT_EQ(replay.faults().plunge, before) << replay.faults().first;
        }
    }
    EXPECT_GT(replay.faults().plunge, 0U);
    EXPECT_EQ(replay.faults().all(), replay.faults().plunge) << replay.faults().first;
}

TEST(MakeToolpath, IsTheSameForAnyNumberOfThreads) {
    const TriangleMesh mesh = bumpy(70, 20, 40, 5);
    const auto setup = setup_of(mesh, 6, 40);
    const Cell cell = ready_cell();
    const Toolpath path = make_toolpath(setup, mesh, cell, coarse_settings());
    for (const std::size_t threads : {1U, 2U, 4U}) {
        const ThreadLimit limit(threads);
        EXPECT_TRUE(make_toolpath(setup, mesh, cell, coarse_settings()) == path) << threads;
    }
}

TEST(MakeToolpath, NamesTheSettingThatIsNotValid) {
    const TriangleMesh mesh = shapes::box({0, 0, 0}, {20, 20, 20});
    const auto setup = setup_of(mesh);
    const Cell cell = ready_cell();
    const auto refused = [&](const ToolpathSettings& settings, const std::string& name, const Cell& in) {
        try {
            make_toolpath(setup, mesh, in, settings);
            FAIL() << name;
        } catch (const InputError& error) {
            EXPECT_NE(std::string(error.what()).find(name), std::string::npos) << error.what();
        }
    };
    ToolpathSettings settings;
    settings.stepdown = 120;
    refused(settings, "step_down is deeper than the flute", cell);
    settings = {};
    settings.path_tolerance = 0;
    refused(settings, "path_tolerance", cell);
    settings = {};
    settings.scallop = 0;
    refused(settings, "scallop", cell);
    settings = {};
    settings.cell = std::numeric_limits<double>::quiet_NaN();
    refused(settings, "cell", cell);
    settings = {};
    settings.roughing_tool = 9;
    refused(settings, "roughing_tool", cell);
    settings = {};
    settings.finishing_tools = {1};
    refused(settings, "not ball-ended", cell);
    settings.finishing_tools = {2, 0};
    refused(settings, "larger than the one before it", cell);
    settings = {};
    settings.finest_tool = 20.5;
    refused(settings, "finest_tool: no ball-ended tool of the cell has a diameter of 20.5 mm or more", cell);
    Cell no_ball = cell;
    std::erase_if(no_ball.machine->tools, [](const CuttingTool& t) { return t.shape == ToolShape::ball; });
    refused({}, "ball-ended", no_ball);
    refused({}, "no machine", ready_cell("foam-1.toml"));
}

TEST(MakeToolpath, CanBeCancelled) {
    const TriangleMesh mesh = shapes::box({0, 0, 0}, {40, 40, 40});
    const auto setup = setup_of(mesh);
    const std::atomic<bool> cancelled = true;
    Context context;
    context.cancelled = &cancelled;
    EXPECT_THROW(make_toolpath(setup, mesh, ready_cell(), {}, context), Cancelled);
}

}  // namespace
}  // namespace qchopper
