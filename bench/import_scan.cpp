// Measures reading and inspecting: every figure is taken in this one run, and the ratios are between figures of this
// run.

#include <algorithm>
#include <string>

#include "base/files/file.h"
#include "base/files/temporary_folder.h"
#include "base/parallel.h"
#include "bench/child.h"
#include "bench/choice.h"
#include "bench/clock.h"
#include "bench/figures.h"
#include "bench/other_readers.h"
#include "bench/specimens.h"
#include "segment/import/inspect.h"
#include "segment/io/read_mesh.h"
#include "segment/io/write_mesh.h"
#include "segment/mesh/connectivity/manifold.h"
#include "segment/repair/fill_holes.h"
#include "segment/repair/intersections/self_intersections.h"
#include "segment/repair/weld.h"

namespace {

using namespace qchopper;
using namespace qchopper::bench;
namespace fs = std::filesystem;

constexpr const char* usage = R"(bench_import [--data DIR] [--program QCHOPPER] [--small] [--only GROUP]...
  --data     where bunny_bun_zipper.ply and ct_head_1912k.ply lie
  --program  the program whose memory is measured; without it that figure is left out
  --small    100,000 faces instead, to check that it runs; the targets do not apply
  --only     inspect, stl, deep, memory or holes; all if none is named
)";

constexpr int runs = 7;

// Two ways to do the same, run alternately so that both meet the same load of the machine; the best time of each.
struct Comparison {
    double ours = std::numeric_limits<double>::infinity();
    double theirs = std::numeric_limits<double>::infinity();
    double ratio() const { return ours / theirs; }
};

template <class Ours, class Theirs>
Comparison compare(int times, const Ours& ours, const Theirs& theirs) {
    Comparison best;
    for (int i = 0; i < times; ++i) {
        best.theirs = std::min(best.theirs, best_of(1, cpu_s, theirs));
        best.ours = std::min(best.ours, best_of(1, cpu_s, ours));
    }
    return best;
}

std::string both(const Comparison& c) {
    return time_text(c.ours) + " and " + time_text(c.theirs);
}

struct Scan {
    std::string name;
    fs::path file;
};

void measure_inspect(const Scan& scan, Figures& figures) {
    for (const bool doubles : {false, true}) {
        const Comparison c = compare(
            runs, [&] { return inspect(read_mesh(scan.file, {.weld = true})).triangles; },
            [&] { return openmesh_read(scan.file, doubles); });
        const std::string theirs = std::string("OpenMesh, ") + (doubles ? "double" : "single") + " precision";
        figures.record(scan.name, "inspect, and reading by " + theirs, both(c));
        figures.at_most(scan.name, "inspect / reading by " + theirs, c.ratio(), 0.5);
    }
    figures.record(scan.name, "of it reading", time_text(best_of(runs, cpu_s, [&] { return read_mesh(scan.file); })));
}

void measure_stl(const Scan& scan, Figures& figures) {
    const TemporaryFolder folder("qchopper-bench-");
    const fs::path file = folder.path() / "scan.stl";
    write_file(file, to_stl(read_mesh(scan.file).mesh));
    const auto ours = [&] {
        RawMesh raw = read_mesh(file, {.weld = true});
        weld(raw.mesh);
        return raw;
    };
    if (!has_assimp()) {
        figures.record(scan.name, "STL read and welded", time_text(best_of(runs, cpu_s, ours)));
        figures.add({scan.name, "STL read and welded / read by assimp", "assimp was not there when this was built",
                     "at most 1", std::nullopt});
        return;
    }
    const Comparison c = compare(runs, ours, [&] { return assimp_read(file); });
    figures.record(scan.name, "STL read and welded, and read by assimp", both(c));
    figures.at_most(scan.name, "STL read and welded / read by assimp, not welded", c.ratio(), 1);
}

void measure_deep(const Scan& scan, Figures& figures) {
    TriangleMesh mesh = read_mesh(scan.file).mesh;
    weld(mesh);
    split_non_manifold_vertices(mesh, edges(mesh));
    const CgalSurface surface(mesh);
    const ThreadLimit one(1);
    const Comparison all = compare(
        3, [&] { return self_intersections(mesh); }, [&] { return surface.self_intersections(); });
    figures.record(scan.name, "all self-intersections, and by CGAL (self_intersections)", both(all));
    figures.at_most(scan.name, "all self-intersections / by CGAL", all.ratio(), 1);
    InspectOptions deep;
    deep.deep = true;
    const Comparison whole = compare(
        3, [&] { return inspect(read_mesh(scan.file, {.weld = true}), deep); },
        [&] { return surface.does_self_intersect(); });
    figures.record(scan.name, "inspect --deep, and CGAL's test (does_self_intersect)", both(whole));
    figures.at_most(scan.name, "inspect --deep, reading included / CGAL's test alone", whole.ratio(), 1);
    const bool is_equal = self_intersections(mesh).pairs.size() == surface.self_intersections();
    figures.add({scan.name, "pairs are as many as CGAL's", is_equal ? "yes" : "no", "yes", is_equal});
}

void measure_memory(const Choice& choice, const Scan& scan, Figures& figures) {
    const auto measure = [&](const std::string& name, const fs::path& file, std::size_t faces) {
        const ChildResult ended = run({choice.program.string(), "inspect", file.string(), "--json"});
        if (ended.status != 0) {
            figures.add({name, "peak memory of inspect", "it ended with status " + std::to_string(ended.status),
                         "at most 120 bytes a face", std::nullopt});
            return;
        }
        figures.record(name, "inspect as a program of its own, CPU", time_text(ended.cpu));
        figures.at_most(name, "peak memory of inspect, bytes a face", ended.peak_bytes / static_cast<double>(faces),
                        120);
    };
    measure(scan.name, scan.file, read_mesh(scan.file).mesh.triangles.size());
    const TemporaryFolder folder("qchopper-bench-");
    SampleOptions options;
    options.faces = choice.is_small ? 500'000 : 10'000'000;
    std::size_t faces = 0;
    {
        const TriangleMesh large = sample(Specimen::skull, options);
        faces = large.triangles.size();
        write_file(folder.path() / "skull.ply", to_ply(large));
        write_file(folder.path() / "skull.stl", to_stl(large));
    }
    const std::string name = "skull " + number_text(static_cast<double>(faces));
    measure(name + ", PLY", folder.path() / "skull.ply", faces);
    measure(name + ", STL", folder.path() / "skull.stl", faces);
}

void measure_holes(const Choice& choice, Figures& figures) {
    const fs::path file = choice.data / "bunny_bun_zipper.ply";
    if (!fs::exists(file)) return;
    TriangleMesh mesh = read_mesh(file).mesh;
    weld(mesh);
    const std::vector<Triangle> before = mesh.triangles;
    const std::vector<Vec3> points = mesh.points;
    const double seconds = best_of(1, cpu_s, [&] { return fill_holes(mesh); });
    const bool is_same = std::equal(before.begin(), before.end(), mesh.triangles.begin()) && mesh.points == points;
    figures.record("bunny", "holes closed in", time_text(seconds));
    figures.add({"bunny", "faces when its holes are closed", std::to_string(mesh.triangles.size()), "69664",
                 mesh.triangles.size() == 69'664});
    figures.add({"bunny", "its own 69,451 faces and their points keep every bit", is_same ? "yes" : "no", "yes",
                 is_same && before.size() == 69'451});
}

void measure(const Choice& choice, Figures& figures) {
    const TemporaryFolder folder("qchopper-bench-");
    Scan scan{"CT head", choice.data / "ct_head_1912k.ply"};
    if (choice.is_small || !fs::exists(scan.file)) {
        SampleOptions options;
        options.faces = choice.is_small ? 100'000 : 1'912'000;
        scan = {"skull", folder.path() / "skull.ply"};
        write_file(scan.file, to_ply(sample(Specimen::skull, options)));
    }
    // First: the peak of a child includes the memory of this program at its start.
    if (choice.wants("memory") && !choice.program.empty()) measure_memory(choice, scan, figures);
    if (choice.wants("inspect")) measure_inspect(scan, figures);
    if (choice.wants("stl")) measure_stl(scan, figures);
    if (choice.wants("deep")) measure_deep(scan, figures);
    if (choice.wants("holes")) measure_holes(choice, figures);
}

}  // namespace

int main(int argc, char** argv) {
    return print_figures(argc, argv, usage, measure);
}
