// Height fields, CL surfaces and finishing passes of one direction: CPU time, points, length, and what a replay of the
// passes leaves. bench_toolpath [SCAN|ball [SIZE_MM [ROUNDING_MM [CELL_MM]]]]

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <string>

#include "bench/clock.h"
#include "bench/specimens.h"
#include "cam/stock/cl_surface.h"
#include "cam/toolpath/finishing/finishing.h"
#include "segment/mesh/measure.h"
#include "tests/cam/toolpath/replay.h"
#include "tests/shapes.h"

namespace qchopper::bench {
namespace {

constexpr std::size_t max_replayed_cells = 4'000'000;

// As it lies, in a block with 10 mm around it.
Setup standing(const TriangleMesh& mesh) {
    Setup setup;
    const Box box = bounds(mesh);
    setup.piece_in_setup.shift = {-box.centre().x, -box.centre().y, -box.min.z};
    setup.box = {box.min + setup.piece_in_setup.shift, box.max + setup.piece_in_setup.shift};
    setup.spoil = 15;
    setup.block.size = box.size() + Vec3{20, 20, 25};
    setup.access.orientations.push_back({{0, 0, 1}, 0, 0, 0});
    return setup;
}

CuttingTool ball_tool(double diameter) {
    CuttingTool tool;
    tool.diameter = diameter;
    tool.corner_radius = 0.5 * diameter;
    tool.flute_length = 60;
    tool.stick_out = 400;
    return tool;
}

void measure_tips(const Setup& setup, const TriangleMesh& mesh, double cell) {
    const double begin = process_cpu_s();
    const HeightField map = piece_height_field(setup, mesh, 0, {cell, -6, 6});
    const double mapped = process_cpu_s();
    const HeightField tip = cl_surface(map, ball_tool(12));
    const double end = process_cpu_s();
    const double millions = 1e-6 * static_cast<double>(map.height.size());
    std::printf("cell %.2f mm: %.2f M cells, map %.2f s, tips %.2f s: %.1f M positions per core-second\n", cell,
                millions, mapped - begin, end - mapped, millions / (end - mapped));
}

void print_passes(const char* name, const std::vector<Pass>& passes, double milled_m2) {
    std::size_t rounded = 0;
    for (const Pass& pass : passes) {
        for (const PassPoint& point : pass.points) rounded += point.is_rounded ? 1 : 0;
    }
    const auto points = static_cast<double>(test_pieces::points_of(passes));
    const double metres = 1e-3 * test_pieces::length_of(passes);
    std::printf(
        "  %s: %zu passes, %.0f m, %.0f points, %.0f %% rounded; of %.3f m2: %.0f m, %.0f points, %.2f MB per m2\n",
        name, passes.size(), metres, points, 100 * static_cast<double>(rounded) / points, milled_m2, metres / milled_m2,
        points / milled_m2, 46e-6 * points / milled_m2);
}

bool is_level(const Pass& pass) {
    return std::all_of(pass.points.begin(), pass.points.end(),
                       [&](const PassPoint& p) { return p.tip.z == pass.points.front().tip.z; });
}

// What is left over the points that the tool reaches to within `reach`.
void print_leftover(const std::vector<test_pieces::SurfacePoint>& points, const HeightField& closing,
                    const HeightField& left, double reach, double allowed) {
    double all = 0;
    double reachable = 0;
    double within = 0;
    double most = 0;
    for (const auto& p : points) {
        all += p.area;
        if (test_pieces::foam_over(closing, p, 2) > reach) continue;
        reachable += p.area;
        const double foam = test_pieces::foam_over(left, p, 20);
        most = std::max(most, foam);
        if (foam <= allowed) within += p.area;
    }
    std::printf("  within %.2f mm reachable: %.2f %%; of that at most %.2f mm left on %.3f %%; most %.2f mm\n", reach,
                100 * reachable / all, allowed, 100 * within / reachable, most);
}

// Finishing of all that is seen from above.
void measure_finishing(const Setup& setup, const TriangleMesh& mesh, double cell, double rounding) {
    const CuttingTool tool = ball_tool(12);
    FinishingOptions options;
    options.rounding = rounding;
    const double begin = process_cpu_s();
    const HeightField map = piece_height_field(setup, mesh, 0, {cell, -6, 6});
    const HeightField tip = cl_surface(map, tool);
    const HeightField closing = remaining_surface(tip, tool);
    const FinishingRegion region = RestMaterial(mesh, Setup()).take(closing, 0.5 * options.scallop + 0.75 * cell, 2);
    const double ready = process_cpu_s();
    std::vector<Pass> passes = finishing_passes(tip, tool, region, options);
    const double end = process_cpu_s();
    std::printf("cell %.2f mm: maps and region %.2f s, passes %.2f s\n", cell, ready - begin, end - ready);
    const auto points = test_pieces::surface_points(mesh, map, 1);
    double milled = 0;
    for (const auto& p : points) milled += 1e-6 * p.area;
    const auto rows = std::stable_partition(passes.begin(), passes.end(), is_level);
    print_passes("levels", {passes.begin(), rows}, milled);
    print_passes("rows", {rows, passes.end()}, milled);
    print_passes("all", passes, milled);
    if (map.height.size() > max_replayed_cells) return;
    HeightField stock = map;
    std::fill(stock.height.begin(), stock.height.end(), 1e6F);
    const HeightField left = test_pieces::replayed(stock, passes, tool);
    for (const double cells : {0.75, 2.0}) {
        print_leftover(points, closing, left, options.scallop + cells * cell, options.scallop + 0.5);
    }
    std::printf("  deepest cut into a point of the surface: %.4f mm\n",
                test_pieces::deepest_gouge(passes, tool, points, map));
}

}  // namespace
}  // namespace qchopper::bench

int main(int argc, char** argv) {
    using namespace qchopper;
    using namespace qchopper::bench;
    const std::string name = argc > 1 ? argv[1] : "igea_268k.ply";
    const double size = argc > 2 ? std::atof(argv[2]) : 250;
    const double rounding = argc > 3 ? std::atof(argv[3]) : 5;
    TriangleMesh mesh;
    if (name == "ball") {
        mesh = shapes::ball({0, 0, 0}, 50, 200);
    } else {
        const auto scanned = scan(default_data() / name, 1);
        if (!scanned) return 1;
        mesh = *scanned;
    }
    const Vec3 box = bounds(mesh).size();
    for (Vec3& p : mesh.points) p = (size / std::max({box.x, box.y, box.z})) * p;
    const auto setup = standing(mesh);
    const double cell = argc > 4 ? std::atof(argv[4]) : 0.25;
    if (argc <= 4) {
        for (const double each : {0.5, 0.25, 0.2}) measure_tips(setup, mesh, each);
    }
    measure_finishing(setup, mesh, cell, rounding);
    return 0;
}
