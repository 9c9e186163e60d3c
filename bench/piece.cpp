// Makes the toolpath of one piece and replays it without the arm: figures of the proof, CPU time of the stages, and the
// places where most foam is left.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "base/error.h"
#include "base/timings.h"
#include "bench/clock.h"
#include "bench/job_piece.h"
#include "cam/job/read_job.h"
#include "cam/toolpath/make_toolpath.h"
#include "segment/mesh/measure.h"
#include "sim/replay/finding.h"
#include "sim/replay/gouge.h"
#include "sim/replay/leftover.h"
#include "sim/replay/mill_stock.h"
#include "sim/replay/path_time.h"
#include "sim/replay/removal_rate_check.h"

namespace {

using namespace qchopper;
using namespace qchopper::bench;

constexpr const char* usage =
    "bench_piece JOB CELL [REPLAY_CELL_MM]\n  JOB   of a piece, with a program or without; its program is not used\n";
constexpr double bytes_per_point = 46;  // of a line of a KRL program that states the position alone
constexpr double region_mm = 30;        // of the places that are listed
constexpr std::size_t listed = 12;

// The setup of a job for its mesh, which is in setup coordinates.
Setup setup_of_mesh(const ReadJob& job) {
    Setup setup = job.setup;
    for (ToolOrientation& orientation : setup.access.orientations) {
        orientation.tool_axis = normalized(rotate(job.setup.piece_in_setup, orientation.tool_axis));
    }
    setup.up = {0, 0, 1};
    setup.piece_in_setup = {};
    return setup;
}

ReplayScene scene_of(const Setup& setup, const Toolpath& path, const TriangleMesh& mesh, const Cell& cell) {
    ReplayScene scene;
    scene.cell = &cell;
    for (const ToolOrientation& orientation : setup.access.orientations)
        scene.orientations.push_back({orientation.tool_axis, 0, {}});
    for (const Operation& operation : path.operations) {
        scene.chunks.push_back({"", cell.machine->tools[operation.tool].number, operation.orientation});
        scene.scallop = std::max(operation.scallop, 0.25);
    }
    scene.block = setup.block_box();
    scene.spoil = setup.spoil;
    scene.target = &mesh;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        scene.is_unmilled.push_back(setup.is_unmilled(cap_of(mesh, t)));
    }
    return scene;
}

// Of one operation. A file of the program stands for an operation, a line for a move.
ToolPath lines_of(const Toolpath& path, std::uint32_t k, double acceleration) {
    ToolPath lines;
    {
        const Operation& operation = path.operations[k];
        std::uint32_t number = 0;
        for (const PathRun& run : operation.runs) {
            Vec3 at = run.start;
            for (std::size_t i = 0; i < run.moves.size(); ++i) {
                const PathMove& move = run.moves[i];
                TipLine line;
                line.from = at;
                line.to = at = move.tip;
                line.place = {k, ++number};
                line.chunk = k;
                line.tool = static_cast<std::uint32_t>(operation.tool);
                line.orientation = static_cast<std::uint32_t>(operation.orientation);
                line.feed = feed_of(operation, move);
                line.acceleration = acceleration;
                line.rounding = move.rounding;
                line.follows_line = i > 0;
                line.signals = {true, true, operation.rpm, true};
                lines.order.push_back({true, lines.lines.size()});
                lines.lines.push_back(line);
            }
        }
    }
    return lines;
}

void print_operations(const Toolpath& path, const Cell& cell) {
    for (std::size_t k = 0; k < path.operations.size(); ++k) {
        const Operation& operation = path.operations[k];
        std::size_t points = 0;
        double cut = 0;
        for (const PathRun& run : operation.runs) {
            points += run.moves.size() + 1;
            Vec3 at = run.start;
            for (const PathMove& move : run.moves) {
                if (move.kind == MoveKind::cut) cut += norm(move.tip - at);
                at = move.tip;
            }
        }
        std::printf("  %2zu %-14s tool %u, direction %zu: %zu runs, %.0f m of cuts, %.2f MB\n", k + 1,
                    to_word(operation.kind), cell.machine->tools[operation.tool].number, operation.orientation,
                    operation.runs.size(), 1e-3 * cut, 1e-6 * bytes_per_point * static_cast<double>(points));
    }
}

// Surface out of tolerance by cubes of a grid, the largest first.
void print_places(const TriangleMesh& mesh, const LeftoverFigures& left, double tolerance) {
    struct Place {
        double area = 0;
        double most = 0;
        Vec3 at;
        Vec3 normal;
    };
    std::map<std::tuple<int, int, int>, Place> places;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const auto distance = static_cast<double>(left.distance[t]);
        if (!left.is_reachable[t] || distance <= tolerance) continue;
        const auto corners = corners_of(mesh, t);
        const Vec3 at = (1.0 / 3) * (corners[0] + corners[1] + corners[2]);
        const auto square = [](double x) { return static_cast<int>(std::floor(x / region_mm)); };
        Place& place = places[{square(at.x), square(at.y), square(at.z)}];
        const Vec3 normal = area_vector(mesh, t);
        place.area += norm(normal);
        place.normal = place.normal + normal;
        if (distance > place.most) place.most = distance, place.at = at;
    }
    std::vector<Place> sorted;
    sorted.reserve(places.size());
    for (const auto& [key, place] : places) sorted.push_back(place);
    std::sort(sorted.begin(), sorted.end(), [](const Place& a, const Place& b) { return a.area > b.area; });
    for (std::size_t i = 0; i < std::min(listed, sorted.size()); ++i) {
        const Place& p = sorted[i];
        const Vec3 n = normalized(p.normal);
        std::printf("  triangles of %.0f mm2, up to %.2f mm of foam at %.0f %.0f %.0f, facing %.2f %.2f %.2f\n", p.area,
                    p.most, p.at.x, p.at.y, p.at.z, n.x, n.y, n.z);
    }
}

Toolpath timed_toolpath(const Setup& setup, const TriangleMesh& mesh, const Cell& cell) {
    Context context;
    double before = process_cpu_s();
    context.on_progress = [&](const Progress& step) {
        if (step.what != "operations of the toolpath") return;
        const double now = process_cpu_s();
        std::fprintf(stderr, "  operation %zu of %zu, the one before took %.1f s\n", step.done, step.total,
                     now - before);
        before = now;
    };
    return make_toolpath(setup, mesh, cell, {}, context);
}

// One operation after the other, with what each costs.
MillingFigures mill(const Toolpath& path, const ReplayScene& scene, const Cell& cell, StockModel& stock_model,
                    FindingLog& log) {
    MillingFigures sum;
    PathTime whole;
    for (std::uint32_t k = 0; k < path.operations.size(); ++k) {
        const Operation& operation = path.operations[k];
        const ToolPath lines = lines_of(path, k, cell.machine->program.acceleration);
        const MillingFigures own = mill_stock(stock_model, lines, scene, true, log, {});
        check_removal_rate(lines, own.lines, scene, log);
        const PathTime time = time_of(lines);
        double at_feed = 0;
        double links = 0;
        std::size_t stops = 0;
        for (const TipLine& line : lines.lines) {
            const double length = norm(line.to - line.from);
            (line.feed > operation.feed ? links : at_feed) += length / line.feed;
            if (!(line.rounding > 0)) ++stops;
        }
        const CuttingTool& tool = cell.machine->tools[operation.tool];
        std::printf(
            "  %2u %-14s tool %u, direction %zu: %5.0f s: %5.0f at feed, %5.0f links, %5.0f acceleration; %.0f m at "
            "feed, "
            "of them air %.0f; %zu lines, %zu exact; %.2f l, %.1f of %.0f cm3/s\n",
            k + 1, to_word(operation.kind), tool.number, operation.orientation, time.seconds, at_feed, links,
            time.seconds - at_feed - links, 1e-3 * own.feed_mm, 1e-3 * own.air_mm, lines.lines.size(), stops,
            1e-6 * own.removed_mm3, 1e-3 * own.removed_mm3 / time.seconds, 1e-3 * tool.removal_mm3_per_s);
        sum.removed_mm3 += own.removed_mm3;
        sum.feed_mm += own.feed_mm;
        sum.air_mm += own.air_mm;
        whole.seconds += time.seconds;
        whole.line_mm += time.line_mm;
    }
    std::printf("in all %.0f s, %.0f m, %.2f l\n", whole.seconds, 1e-3 * whole.line_mm, 1e-6 * sum.removed_mm3);
    return sum;
}

int measure(const std::string& job_file, const std::string& cell_file, double replay_cell) {
    const ReadJob job = parse_job(read_job(job_file), job_file);
    const Cell cell = read_cell(cell_file);
    const TriangleMesh mesh = mesh_of(job);
    const Setup setup = setup_of_mesh(job);
    const Vec3 size = setup.block.size;
    std::printf("piece %s: %zu faces, block %.0f x %.0f x %.0f\n", job.piece.c_str(), mesh.triangles.size(), size.x,
                size.y, size.z);
    for (const ToolOrientation& d : setup.access.orientations) {
        std::printf("  direction %.3f %.3f %.3f\n", d.tool_axis.x, d.tool_axis.y, d.tool_axis.z);
    }
    double before = process_cpu_s();
    const auto lap = [&](const char* what) {
        const double now = process_cpu_s();
        std::printf("%s: %.1f s CPU\n", what, now - before);
        std::fflush(stdout);
        before = now;
    };
    double to_mill = 0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        if (!setup.is_unmilled(cap_of(mesh, t))) to_mill += norm(area_vector(mesh, t));
    }
    std::printf("  surface to mill %.0f cm2\n", 0.01 * to_mill);
    const Toolpath path = timed_toolpath(setup, mesh, cell);
    lap("toolpath");
    print_operations(path, cell);
    const ReplayScene scene = scene_of(setup, path, mesh, cell);
    FindingLog log;
    std::vector<Vec3> tool_axes;
    for (const SceneOrientation& orientation : scene.orientations) tool_axes.push_back(orientation.tool_axis);
    StockModel stock_model(scene.block, tool_axes, replay_cell);
    const MillingFigures carving = mill(path, scene, cell, stock_model, log);
    lap("foam");
    ToolPath lines;
    for (std::uint32_t k = 0; k < path.operations.size(); ++k) {
        const ToolPath own = lines_of(path, k, cell.machine->program.acceleration);
        for (const TipLine& line : own.lines) {
            lines.order.push_back({true, lines.lines.size()});
            lines.lines.push_back(line);
        }
    }
    const GougeFigures gouges = find_gouges(lines, scene, 0.01, {});
    lap("gouges");
    const LeftoverFigures left = measure_leftover(stock_model, scene, gouges.depth, {}, {});
    lap("leftover");
    std::printf(
        "within tolerance %.2f %% of the reachable surface, which is %.1f %%; most foam %.2f mm, gouge %.3f mm, "
        "air %.0f %%\n",
        100 * left.within_mm2 / left.reachable_mm2, 100 * left.reachable_mm2 / left.area_mm2, left.largest,
        gouges.largest, 100 * carving.air_mm / carving.feed_mm);
    print_places(mesh, left, scene.scallop + LeftoverOptions{}.too_much);
    for (const Finding& finding : log.findings()) {
        std::printf("  operation %u: %s\n", finding.place.file + 1, finding.text.c_str());
    }
    std::printf("peak memory %.0f MB\n", 1e-6 * static_cast<double>(Timings().so_far().peak_memory_bytes));
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 3 && argc != 4) {
        std::cerr << usage;
        return 64;
    }
    const double replay_cell = argc == 4 ? std::strtod(argv[3], nullptr) : 0.5;
    if (!(replay_cell > 0)) {
        std::cerr << usage;
        return 64;
    }
    try {
        return measure(argv[1], argv[2], replay_cell);
    } catch (const InputError& error) {
        std::cerr << error.what() << "\n";
        return 66;
    }
}
