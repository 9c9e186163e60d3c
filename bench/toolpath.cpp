// Height maps, tip surfaces and finishing passes: CPU time, points and length.

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>

#include "bench/specimens.h"
#include "cam/toolpath/tip_surface.h"
#include "segment/mesh/measure.h"

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

}  // namespace
}  // namespace qchopper::bench

int main(int argc, char** argv) {
    using namespace qchopper;
    using namespace qchopper::bench;
    const std::string name = argc > 1 ? argv[1] : "igea_268k.ply";
    const double size = argc > 2 ? std::atof(argv[2]) : 500;
    const auto mesh = scan(default_data() / name, 1);
    if (!mesh) return 1;
    const Vec3 box = bounds(*mesh).size();
    TriangleMesh scaled = *mesh;
    for (Vec3& p : scaled.points) p = (size / std::max({box.x, box.y, box.z})) * p;
    const auto setup = standing(scaled);
    for (const double cell : {0.5, 0.25, 0.2}) measure_tips(setup, scaled, cell);
    return 0;
}
