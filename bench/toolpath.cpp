// Height maps, tip surfaces and finishing passes: CPU time, points and length.

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>

#include "bench/specimens.h"
#include "cam/toolpath/finishing.h"
#include "cam/toolpath/tip_surface.h"
#include "segment/mesh/measure.h"
#include "tests/cam/toolpath/replay.h"
#include "tests/shapes.h"

namespace qchopper::bench {
namespace {

double cpu_s() {
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

// The piece at a size of its longest side, as it lies, in a block with 10 mm around it.
Setup standing(const TriangleMesh& mesh) {
    Setup setup;
    const Box box = bounds(mesh);
    setup.piece_in_setup.shift = {-box.centre().x, -box.centre().y, -box.min.z};
    setup.box = {box.min + setup.piece_in_setup.shift, box.max + setup.piece_in_setup.shift};
    setup.spoil = 15;
    setup.block.size = box.size() + Vec3{20, 20, 25};
    setup.reach.directions.push_back({{0, 0, 1}, 0, 0, 0});
    return setup;
}

CarvingTool ball_tool(double diameter) {
    CarvingTool tool;
    tool.diameter = diameter;
    tool.corner_radius = 0.5 * diameter;
    tool.flute_length = 60;
    tool.stick_out = 400;
    return tool;
}

void measure_tips(const Setup& setup, const TriangleMesh& mesh, double cell) {
    const double begin = cpu_s();
    const HeightMap map = target_map(setup, mesh, 0, {cell, -6, 6});
    const double mapped = cpu_s();
    const HeightMap tip = tip_surface(map, ball_tool(12));
    const double end = cpu_s();
    const auto cells = static_cast<double>(map.height.size());
    std::printf("cell %.2f mm: %.2f M cells, map %.2f s, tips %.2f s: %.2f M positions per core-second\n", cell,
                1e-6 * cells, mapped - begin, end - mapped, 1e-6 * cells / (end - mapped));
}

// Finishing of all that is seen from above, replayed.
void measure_finishing(const Setup& setup, const TriangleMesh& mesh, double cell, double rounding) {
    const CarvingTool tool = ball_tool(12);
    const double begin = cpu_s();
    const HeightMap map = target_map(setup, mesh, 0, {cell, -6, 6});
    const HeightMap tip = tip_surface(map, tool);
    const HeightMap closing = remaining_surface(tip, tool);
    const double mapped = cpu_s();
    SurfaceLeft surface(mesh, std::nullopt);
    const FinishingRegion region = surface.take(closing, 0.125 + 0.75 * cell, 2);
    double carved = 0;
    FinishingOptions options;
    options.rounding = rounding;
    const double ready = cpu_s();
    const std::vector<Pass> passes = finishing_passes(tip, tool, region, options);
    const double end = cpu_s();
    const auto points = test_pieces::surface_points(mesh, map, 1);
    for (const auto& p : points) carved += p.area;
    const std::size_t count = test_pieces::points_of(passes);
    std::size_t rounded = 0;
    for (const Pass& pass : passes) {
        rounded += static_cast<std::size_t>(
            std::count_if(pass.points.begin(), pass.points.end(), [](const PassPoint& p) { return p.is_rounded; }));
    }
    for (const bool is_level : {true, false}) {
        std::size_t n = 0, pts = 0;
        double len = 0;
        for (const Pass& pass : passes) {
            if ((pass.points.front().tip.z == pass.points[pass.points.size() / 2].tip.z &&
                 pass.points.front().tip.z == pass.points.back().tip.z) != is_level)
                continue;
            ++n;
            pts += pass.points.size();
            len += test_pieces::length_of({pass});
        }
        std::printf("  %s: %zu passes, %.1f m, %zu points: %.2f mm a point\n", is_level ? "levels" : "rows", n,
                    1e-3 * len, pts, len / static_cast<double>(pts));
    }
    const double metres = 1e-3 * test_pieces::length_of(passes);
    std::printf(
        "cell %.2f: maps %.2f s, passes %.2f s: %zu passes, %.0f m, %zu points (%.0f %% rounded); carved %.3f m2: %.0f "
        "m/m2, %.0f points/m2 = %.2f MB/m2\n",
        cell, mapped - begin, end - ready, passes.size(), metres, count,
        100.0 * static_cast<double>(rounded) / static_cast<double>(count), 1e-6 * carved, metres / (1e-6 * carved),
        static_cast<double>(count) / (1e-6 * carved), 46e-6 * static_cast<double>(count) / (1e-6 * carved));
    if (map.height.size() > 4000000) return;
    HeightMap stock = map;
    std::fill(stock.height.begin(), stock.height.end(), 1e6F);
    const HeightMap left = test_pieces::replayed(stock, passes, tool);
    double reachable = 0, within = 0, within_h = 0, all = 0, most = 0;
    for (const auto& p : points) {
        all += p.area;
        if (test_pieces::foam_over(closing, p, 1) > options.scallop + 0.75 * cell) continue;
        reachable += p.area;
        const double foam = test_pieces::foam_over(left, p, 20);
        most = std::max(most, foam);
        within += foam <= options.scallop + 0.5 ? p.area : 0;
        within_h += foam <= options.scallop + options.path_tolerance + cell ? p.area : 0;
    }
    std::printf(
        "  reachable %.2f %%; leftover <= h + 0.5: %.3f %%, <= h + tolerance + cell: %.3f %%, most %.2f; gouge %.4f\n",
        100 * reachable / all, 100 * within / reachable, 100 * within_h / reachable, most,
        test_pieces::deepest_gouge(passes, tool, points, map));
}

}  // namespace
}  // namespace qchopper::bench

int main(int argc, char** argv) {
    using namespace qchopper;
    using namespace qchopper::bench;
    const std::string name = argc > 1 ? argv[1] : "igea_268k.ply";
    const double size = argc > 2 ? std::atof(argv[2]) : 500;
    const auto mesh = scan(default_data() / (name == "ball" ? "igea_268k.ply" : name), 1);
    if (!mesh) return 1;
    const Vec3 box = bounds(*mesh).size();
    TriangleMesh scaled = *mesh;
    for (Vec3& p : scaled.points) p = (size / std::max({box.x, box.y, box.z})) * p;
    if (name == "ball") scaled = shapes::ball({0, 0, 0}, 0.5 * size, 200);
    const auto setup = standing(scaled);
    for (const double cell : {0.5}) measure_tips(setup, scaled, cell);
    for (const double cell : {0.25}) measure_finishing(setup, scaled, cell, argc > 3 ? std::atof(argv[3]) : 5);
    return 0;
}
