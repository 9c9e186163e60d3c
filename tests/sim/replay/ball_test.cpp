// A ball milled by a ball: its upper half is reached from above, more of it from a second direction.

#include <gtest/gtest.h>

#include <cmath>
#include <ctime>
#include <numbers>

#include "sim/replay/path_time.h"
#include "sim/replay/replay.h"
#include "sim/replay/stock/tool_axis_frame.h"
#include "tests/shapes.h"
#include "tests/sim/replay/box_job.h"

namespace qchopper {
namespace {

constexpr double radius = 25;
constexpr double tool_radius = 6;
constexpr double step = 2;  // along the ball
const Vec3 centre{0, 0, radius};

// Circles about `out`, from the top down to an angle, with corners rounded so little that it does not count.
WrittenChunk circles(std::size_t orientation, Vec3 tool_axis, double last_angle, double last_height) {
    WrittenChunk chunk{3, orientation, 15000, {}};
    const Pose frame = tool_axis_frame(tool_axis);
    constexpr int corners = 180;
    const double far = radius + tool_radius;
    const auto tip = [&](double r, double height, double turn) {
        return centre + rotate(frame, {r * std::cos(turn), r * std::sin(turn), height - tool_radius});
    };
    chunk.moves.push_back({tip(0, 50, 0), 300, false});
    const auto circle = [&](double r, double height) {
        for (int i = 0; i <= corners; ++i) {
            // Corners a little farther out, so that the chords are tangents.
            const double outer = r / std::cos(std::numbers::pi / corners);
            chunk.moves.push_back(
                {tip(outer, height, 2 * std::numbers::pi * i / corners), i == 0 ? 20.0 : 100.0, i > 0});
        }
    };
    for (double angle = step / far; angle < last_angle; angle += step / radius) {
        circle(far * std::sin(angle), far * std::cos(angle));
    }
    for (double height = -4; height > last_height; height -= 4) circle(far, height);
    chunk.moves.push_back({tip(far, 50, 0), 300, false});
    return chunk;
}

BoxJob ball_job(bool is_tilted) {
    BoxJob job = box_job("kr60-ha");
    job.target = shapes::ball(centre, radius, 60);
    job.is_unmilled.clear();
    job.job.rounding = 0.2;
    job.job.chunks = {circles(0, {0, 0, 1}, 0.5 * std::numbers::pi, -26)};
    if (!is_tilted) return job;
    const double tilt = 30 * std::numbers::pi / 180;
    const Vec3 tool_axis{0, std::sin(tilt), std::cos(tilt)};
    job.job.orientations.push_back({tool_axis, 0, job.job.orientations[0].setup_in_cell});
    job.job.chunks.push_back(circles(1, tool_axis, 0.5 * std::numbers::pi, -14));
    return job;
}

ReplayScene scene_of(const BoxJob& job) {
    ReplayScene scene = job.scene();
    scene.block = {{-38, -38, -10}, {38, 38, 52}};
    return scene;
}

std::string findings_of(const ReplayReport& report) {
    std::string text;
    for (const Finding& finding : report.findings)
        text += std::string(to_word(finding.kind)) + " " + finding.text + "\n";
    return text;
}

TEST(BallReplay, LeavesTheUpperHalfWithinTolerance) {
    const BoxJob job = ball_job(false);
    const ReplayReport report = replay(read_back(job, job.files()), scene_of(job));
    EXPECT_TRUE(report.is_good) << findings_of(report);
    EXPECT_LT(report.largest_gouge, 0.05);
    // The upper half, and what lies within tolerance of the cylinder below it.
    EXPECT_GT(report.share_reachable(), 0.5);
    EXPECT_LT(report.share_reachable(), 0.7);
    const double scallop = std::sqrt(31.0 * 31 - 1) - std::sqrt(36.0 - 1) - 25;
    EXPECT_LT(report.leftover.percentile_99, scallop + 0.375 + 0.25 + 0.71 * 0.25);
    EXPECT_GT(report.leftover.largest_unreachable, 1);
    const double under = std::numbers::pi * radius * radius * radius * (1 - 2.0 / 3);
    EXPECT_NEAR(report.volumes.leftover_mm3, under, 0.1 * under);
}

TEST(BallReplay, ASecondDirectionReachesMore) {
    const BoxJob one = ball_job(false);
    const BoxJob two = ball_job(true);
    ReplayOptions options;
    options.cell = 0.5;
    const ReplayReport from_one = replay(read_back(one, one.files()), scene_of(one), options);
    const ReplayReport from_two = replay(read_back(two, two.files()), scene_of(two), options);
    EXPECT_LT(from_two.largest_gouge, 0.05);
    // Along the second direction the floor of the spoil layer ends the circles before what the closing reaches.
    EXPECT_GT(from_two.share_within(), 0.97);
    EXPECT_EQ(from_two.counts[static_cast<std::size_t>(FindingKind::holder_contact)], 0U) << findings_of(from_two);
    EXPECT_EQ(from_two.counts[static_cast<std::size_t>(FindingKind::below_floor)], 0U) << findings_of(from_two);
    EXPECT_EQ(from_two.counts[static_cast<std::size_t>(FindingKind::rapid_in_foam)], 0U) << findings_of(from_two);
    EXPECT_GT(from_two.share_reachable(), from_one.share_reachable() + 0.05);
    EXPECT_LT(from_two.volumes.leftover_mm3, 0.95 * from_one.volumes.leftover_mm3);
}

TEST(PathTime, IsThatOfTrapezoids) {
    ToolPath path;
    TipLine line;
    line.to = {100, 0, 0};
    line.feed = 100;
    line.acceleration = 1000;
    path.lines = {line};
    EXPECT_NEAR(time_of(path).seconds, 1 + 0.1, 1e-9);  // ramps of 0.1 s
    TipLine next = line;
    next.from = line.to;
    next.to = {200, 0, 0};
    next.follows_line = true;
    path.lines = {line, next};
    EXPECT_NEAR(time_of(path).seconds, 2.2, 1e-9);  // an exact corner is a stop
    path.lines[0].rounding = 2;
    EXPECT_NEAR(time_of(path).seconds, 2.1, 1e-9);
    path.lines[1].to = {100, 100, 0};
    EXPECT_GT(time_of(path).seconds, 2.1);
    EXPECT_LT(time_of(path).seconds, 2.2);
}

// Printed, not judged: the machine may be shared.
TEST(BallReplay, Speed) {
    const BoxJob job = ball_job(false);
    const ParsedProgram program = read_back(job, job.files());
    for (const double cell : {1.0, 0.25}) {
        ReplayOptions options;
        options.cell = cell;
        options.volume_cell = std::max(0.5, cell);
        options.leftover.reach_cell = options.volume_cell;
        const auto before = std::clock();
        const ReplayReport report = replay(program, scene_of(job), options);
        const double seconds = static_cast<double>(std::clock() - before) / CLOCKS_PER_SEC;
        std::printf("cells of %.2f mm: program %.1f s, %.0f mm, replay %.2f CPU s, %.0f x\n", cell, report.time.seconds,
                    report.time.line_mm, seconds, report.time.seconds / seconds);
    }
}

}  // namespace
}  // namespace qchopper
