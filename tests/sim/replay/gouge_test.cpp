#include "sim/replay/gouge.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <random>

#include "base/parallel.h"
#include "sim/replay/mill_stock.h"
#include "sim/replay/replay.h"
#include "sim/replay/stock/tool_axis_frame.h"
#include "tests/shapes.h"
#include "tests/sim/replay/box_job.h"

namespace qchopper {
namespace {

const std::vector<Cutter> cutters{{ToolShape::ball, 6, 6, 0, 1},
                                  {ToolShape::flat, 10, 0, 0, 1},
                                  {ToolShape::bull, 8, 3, 0, 1},
                                  {ToolShape::cone, 5, 0.5, 0.5, std::sqrt(0.75)}};

ReplayOptions coarse_options() {
    ReplayOptions options;
    options.cell = 1;
    return options;
}

// Depth of a point in the tool at one place: the least distance from its surface, of which many points are tried.
double depth_by_points(const Cutter& cutter, double r, double z) {
    if (r > cutter.radius || z < profile_height(cutter, r)) return 0;
    double least = cutter.radius - r;
    for (int i = 0; i <= 4000; ++i) {
        const double at = cutter.radius * i / 4000;
        least = std::min(least, std::hypot(at - r, profile_height(cutter, at) - z));
    }
    return least;
}

TEST(Gouge, IsThatOfManyPointsAndPlaces) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> in(-8, 8);
    int deep = 0;
    for (int round = 0; round < 40; ++round) {
        const Cutter& cutter = cutters[static_cast<std::size_t>(round) % cutters.size()];
        const Vec3 move{in(random), in(random), round % 3 == 0 ? 0 : 0.5 * in(random)};
        const std::array<Vec3, 3> triangle{Vec3{in(random), in(random), in(random)},
                                           Vec3{in(random), in(random), in(random)},
                                           Vec3{in(random), in(random), in(random)}};
        double brute = 0;
        constexpr int n = 24;
        for (int i = 0; i <= n; ++i) {
            for (int j = 0; j <= n - i; ++j) {
                const Vec3 p = triangle[0] + (double(i) / n) * (triangle[1] - triangle[0]) +
                               (double(j) / n) * (triangle[2] - triangle[0]);
                for (int k = 0; k <= n; ++k) {
                    const Vec3 q = p - (double(k) / n) * move;
                    const double r = std::hypot(q.x, q.y);
                    const double most =
                        std::min(cutter.radius - r, q.z - profile_height(cutter, std::min(r, cutter.radius)));
                    if (most > brute) brute = std::max(brute, depth_by_points(cutter, r, q.z));
                }
            }
        }
        const double found = deepest_in(SweptCutter(cutter, move), triangle, 0);
        if (brute > 0.1) ++deep;
        // Points of a lattice miss the deepest one by less than their distance.
        EXPECT_GE(found, brute - gouge_resolution - 0.01) << round;
        EXPECT_LE(found, brute + 0.5) << round;
    }
    EXPECT_GT(deep, 15);
}

// Places of a ball and points about it, also of moves that go nowhere or straight down.
TEST(Gouge, ABallIsBeyondAPointByItsDistanceFromIt) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> in(-9, 9);
    std::array<int, 2> count{};
    for (int i = 0; i < 20'000; ++i) {
        Vec3 move{in(random), in(random), i % 4 == 0 ? 0 : in(random)};
        if (i % 7 == 0) move = {0, 0, i % 2 == 0 ? move.z : 0};
        const SweptCutter swept(cutters[0], move);
        const Vec3 point{in(random), in(random), in(random)};
        const double distance = swept.distance(point);
        EXPECT_TRUE(swept.is_ball_beyond(point, distance - 1e-9)) << i;
        EXPECT_FALSE(distance > -6 + 1e-9 && swept.is_ball_beyond(point, distance + 1e-9)) << i;
        ++count[distance < 0 ? 0 : 1];
    }
    EXPECT_GT(std::min(count[0], count[1]), 2000) << "inside and outside";
}

TEST(Gouge, OfAPlaneIsTheDepthBelowIt) {
    const std::array<Vec3, 3> plane{Vec3{-50, -50, 0.3}, Vec3{50, -50, 0.3}, Vec3{0, 60, 0.3}};
    for (const Cutter& cutter : {cutters[0], cutters[1], cutters[2]}) {
        EXPECT_NEAR(deepest_in(SweptCutter(cutter, {10, 0, 0}), plane, 0), 0.3, gouge_resolution);
    }
    // A wall that the side of the tool is 0.2 mm in.
    const std::array<Vec3, 3> wall{Vec3{-50, 5.8, -50}, Vec3{50, 5.8, -50}, Vec3{0, 5.8, 60}};
    EXPECT_NEAR(deepest_in(SweptCutter(cutters[0], {10, 0, 0}), wall, 0), 0.2, gouge_resolution);
    const std::array<Vec3, 3> clear{Vec3{-50, 6.1, -50}, Vec3{50, 6.1, -50}, Vec3{0, 6.1, 60}};
    EXPECT_EQ(deepest_in(SweptCutter(cutters[0], {10, 0, 0}), clear, 0), 0);
}

// The side of the tool passes the upright edge of a long triangle, so that much of it is nearly as deep as the edge.
TEST(Gouge, OfALongTriangleIsBoundedClosely) {
    const Vec3 from{3.801724446534422, 4.60097154127746, 0};
    const Vec3 move{0.262325574802048, -0.2470434136324, 0};
    const std::array<Vec3, 3> wall{Vec3{0, 0, 21.562502006156961} - from,
                                   Vec3{-143.862701415, 0, 164.54245195732884} - from,
                                   Vec3{0, 0, 29.554506400688211} - from};
    double nearest = 1e9;
    for (int i = 0; i <= 1000; ++i) nearest = std::min(nearest, norm(from + 0.001 * i * move));
    EXPECT_NEAR(deepest_in(SweptCutter(cutters[0], move), wall, 0.0278), 6 - nearest, gouge_resolution);
}

// Lines with rounded corners over a ball, some of them through it.
ToolPath random_lines(std::size_t count, const Pose& frame, std::uint32_t tool) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> in(-1, 1);
    ToolPath path;
    Vec3 at{-20, -20, 30};
    for (std::size_t i = 0; i < count; ++i) {
        TipLine line;
        line.from = apply(frame, at);
        at = {20 * in(random), 20 * in(random), 17 + 6 * in(random)};
        line.to = apply(frame, at);
        line.tool = tool;
        line.rounding = i % 4 == 0 ? 0 : 3 + 2 * in(random);
        line.follows_line = i > 0;
        path.lines.push_back(line);
    }
    return path;
}

// By asking every triangle about every part of every line, in their order.
std::vector<float> depths_by_all(const ToolPath& path, const TriangleMesh& mesh, const Pose& frame,
                                 const Cutter& cutter, double floor) {
    std::vector<float> depth(mesh.triangles.size(), 0);
    for (std::size_t i = 0; i < path.lines.size(); ++i) {
        std::vector<Vec3> way = rounded_way(nullptr, path.lines[i], path.after(i));
        const std::size_t chords = path.lines[i].rounding > 0 && path.after(i) != nullptr ? way.size() - 2 : 0;
        for (std::size_t k = 0; k <= chords; ++k) {
            const Vec3 from = apply_inverse(frame, k == 0 ? path.lines[i].from : way[k]);
            const Vec3 to = apply_inverse(frame, k == 0 ? path.lines[i].to : way[k + 1]);
            const SweptCutter swept(cutter, to - from);
            for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
                std::array<Vec3, 3> corners = corners_of(mesh, t);
                for (Vec3& corner : corners) corner = apply_inverse(frame, corner) - from;
                const double enough = std::max<double>(floor, depth[t]);
                const double found = deepest_in(swept, corners, enough);
                if (found > enough) depth[t] = static_cast<float>(found);
            }
        }
    }
    return depth;
}

TEST(Gouge, OfLinesWithRoundedCornersIsThatOfAllTrianglesUnderAllParts) {
    const Cell cell = read_cell(std::filesystem::path(QCHOPPER_SOURCE_DIR) / "cells" / "kr60-ha.toml");
    const TriangleMesh mesh = shapes::ball({0, 0, 0}, 18, 16);
    ReplayScene scene;
    scene.cell = &cell;
    scene.target = &mesh;
    constexpr double floor = 0.01;
    for (const Vec3 tool_axis : {Vec3{0, 0, 1}, normalized(Vec3{0.5, -0.2, 1})}) {
        scene.orientations = {{tool_axis, 0, {}}};
        const Pose frame = tool_axis_frame(tool_axis);
        for (std::uint32_t tool = 0; tool < cell.machine->tools.size(); ++tool) {
            if (is_drill(cell.machine->tools[tool])) continue;
            const ToolPath path = random_lines(12, frame, tool);
            const GougeFigures figures = find_gouges(path, scene, floor, {});
            EXPECT_GT(figures.largest, 1);
            EXPECT_EQ(figures.depth, depths_by_all(path, mesh, frame, cutter_of(cell.machine->tools[tool]), floor))
                << cell.machine->tools[tool].number;
        }
    }
}

TEST(Gouge, AShiftedPassIsFoundWithItsLineAndDepth) {
    BoxJob job = box_job("kr60-ha");
    job.job.chunks[0].moves[5].tip.z -= 0.6;
    const ReplayReport report = replay(read_back(job, job.files()), job.scene(), coarse_options());
    EXPECT_FALSE(report.is_good);
    // On the piece the line is between its lowered end, 28 mm beside the piece's edge, and its other end.
    EXPECT_GT(report.largest_gouge, 0.3);
    EXPECT_LE(report.largest_gouge, 0.6 + 1e-6);
    EXPECT_EQ(read_back(job, job.files()).files[report.gouge_place.file], "qc_1_001.src");
}

TEST(Gouge, AndAllFiguresAreTheSameOnAnyNumberOfThreads) {
    BoxJob job = box_job("kr60-ha");
    job.job.chunks[0].moves[5].tip.z -= 0.6;
    const ParsedProgram program = read_back(job, job.files());
    const ReplayReport one = [&] {
        const ThreadLimit limit(1);
        return replay(program, job.scene(), coarse_options());
    }();
    const ReplayReport many = replay(program, job.scene(), coarse_options());
    EXPECT_EQ(one.largest_gouge, many.largest_gouge);
    EXPECT_EQ(one.gouge_place, many.gouge_place);
    EXPECT_EQ(one.gouge_at, many.gouge_at);
    EXPECT_EQ(one.deviation, many.deviation);
    EXPECT_EQ(one.leftover.within_mm2, many.leftover.within_mm2);
    EXPECT_EQ(one.volumes.leftover_mm3, many.volumes.leftover_mm3);
    EXPECT_EQ(one.counts, many.counts);
}

}  // namespace
}  // namespace qchopper
