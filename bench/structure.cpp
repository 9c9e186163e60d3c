// Measures the stress analysis: CPU time of one thread with at most 300,000 unknowns, its iterations, and the pass over
// the voxels for every normal.

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "base/parallel.h"
#include "bench/choice.h"
#include "bench/clock.h"
#include "segment/access/tool_directions.h"
#include "segment/mesh/measure.h"
#include "segment/sample/sample.h"
#include "segment/structure/section_stress.h"

namespace {

using namespace qchopper;
using namespace qchopper::bench;

constexpr const char* usage = R"(bench_structure [--small] [--data FOLDER] [--only NAME]...
  --small  20,000 unknowns, to check that it runs
  --data   where ct_head_371k.ply and the other scans lie
  --only   femur, vertebra, skull, ct_head, ct_head_coarse or bunny; all if none is named
)";

// The longest side of the box becomes 1 m.
TriangleMesh of_one_metre(TriangleMesh mesh) {
    const Vec3 size = bounds(mesh).size();
    const double factor = 1000 / std::max({size.x, size.y, size.z});
    for (Vec3& p : mesh.points) p = factor * p;
    return mesh;
}

// Foam of 0.1 g/cm3 under its own weight.
StructureOptions foam(Vec3 up, std::size_t unknowns) {
    StructureOptions o;
    o.up = up;
    o.density_kg_per_m3 = 100;
    o.strength_mpa = 0.5;
    o.unknowns = unknowns;
    return o;
}

std::string share(std::size_t part, std::size_t all) {
    return number_text(100.0 * static_cast<double>(part) / static_cast<double>(all)) + " %";
}

// All planes of 129 normals of the octahedron x 200 offsets.
void measure_planes(const std::string& name, const TriangleMesh& mesh, std::shared_ptr<const StressedModel> model,
                    Figures& figures) {
    const double started = cpu_s();
    const StressedPart part = stressed_part(std::move(model), mesh);
    figures.record(name, "voxels of a piece", time_text(cpu_s() - started));
    const std::vector<Vec3> normals = octahedron_normals();
    const double before = cpu_s();
    for (const Vec3 normal : normals) {
        double low = height(normal, mesh.points.front());
        double high = low;
        for (const Vec3 p : mesh.points) {
            low = std::min(low, height(normal, p));
            high = std::max(high, height(normal, p));
        }
        std::vector<double> offsets;
        for (int k = 1; k <= 200; ++k) offsets.push_back(low + (high - low) * k / 201);
        static_cast<void>(section_stress(part, normal, offsets));
    }
    figures.record(name, std::to_string(normals.size()) + " normals x 200 planes", time_text(cpu_s() - before));
}

void measure_stress(const std::string& name, const TriangleMesh& mesh, const StructureOptions& options,
                    Figures& figures) {
    const double started = cpu_s();
    const auto model = std::make_shared<const StressedModel>(stress_of(mesh, options, {}));
    const StressedModel& m = *model;
    const double time = cpu_s() - started;
    const StructureReport& r = m.report;
    std::size_t floating = 0;
    for (const FloatingSolid& f : r.floating) floating += f.voxels;
    figures.record(name, "unknowns", std::to_string(r.unknowns));
    figures.record(name, "side of a voxel, mm", number_text(m.grid.size));
    figures.record(name, "iterations", std::to_string(r.iterations));
    figures.at_most(name, "stress analysis, s CPU on one thread", time, 60);
    figures.record(name, "an iteration", time_text(time / static_cast<double>(r.iterations)));
    figures.record(name, "floating solids",
                   std::to_string(r.floating.size()) + ", " + share(floating, m.voxels.size()) + " of the voxels");
    figures.record(name, "voxels of walls under 3 voxels", share(r.thin_voxels, r.standing_voxels));
    figures.record(name, "hinges", std::to_string(r.hinges));
    figures.record(name, "largest tension / strength",
                   number_text(100 * r.largest_tension_mpa / m.strength_mpa) + " % at " +
                       number_text(r.largest_tension_at.x) + ", " + number_text(r.largest_tension_at.y) + ", " +
                       number_text(r.largest_tension_at.z));
    measure_planes(name, mesh, model, figures);
}

void measure(const Choice& choice, Figures& figures) {
    const ThreadLimit one(1);
    const std::size_t unknowns = choice.is_small ? 20'000 : 300'000;
    const auto take = [&](const std::string& name, const TriangleMesh& mesh, Vec3 up, std::size_t most) {
        measure_stress(name, of_one_metre(mesh), foam(up, most), figures);
    };
    if (choice.wants("femur")) take("femur", sample(Specimen::femur, {}), {0, 0, 1}, unknowns);
    if (choice.wants("vertebra")) take("vertebra", sample(Specimen::vertebra, {}), {0, 0, 1}, unknowns);
    if (choice.wants("skull")) take("skull", sample(Specimen::skull, {}), {0, 0, 1}, unknowns);
    const auto head =
        choice.wants("ct_head") || choice.wants("ct_head_coarse") ? scan(choice.data / "ct_head_371k.ply", 1) : nullptr;
    if (head && choice.wants("ct_head")) take("ct_head_371k", *head, {0, 0, 1}, unknowns);
    if (head && choice.wants("ct_head_coarse")) take("ct_head_371k, coarse", *head, {0, 0, 1}, unknowns / 10);
    const auto bunny = choice.wants("bunny") ? scan(choice.data / "bunny_bun_zipper.ply", 1000) : nullptr;
    if (bunny) take("bunny", *bunny, {0, 1, 0}, unknowns);
}

}  // namespace

int main(int argc, char** argv) {
    return print_figures(argc, argv, usage, measure);
}
