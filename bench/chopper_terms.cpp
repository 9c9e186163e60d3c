// Times Chopper's objectives over 132 normals x 200 planes: against the same planes with the four terms of the thesis,
// with and without the terms that are slow, and with these only for normals that can win. One thread, CPU seconds.

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>

#include "base/parallel.h"
#include "bench/clock.h"
#include "bench/measures.h"
#include "segment/access/tool_directions.h"
#include "segment/mesh/oriented_box.h"
#include "segment/objectives/seam_cost.h"
#include "segment/objectives/sweep/sweep.h"
#include "segment/search/late_rank.h"

namespace qchopper::bench {
namespace {

namespace fs = std::filesystem;

constexpr int offsets_per_normal = 200;

struct Run {
    double seconds = 0;
    std::size_t planes = 0;
};

double peak_mb() {
    std::ifstream status("/proc/self/status");
    for (std::string line; std::getline(status, line);) {
        if (line.starts_with("VmHWM:")) return std::stod(line.substr(6)) / 1024;
    }
    return 0;
}

Run swept(const Piece& piece, const std::vector<Planes>& planes, const Objectives& objectives, const OrientedBox& box) {
    Run run;
    const double started = cpu_s();
    const PreparedPiece prepared = prepare(piece, objectives, &box.axis);
    for (const Planes& p : planes) {
        for (const auto& evaluation : sweep(prepared, p.normal, p.offsets, objectives))
            run.planes += evaluation ? 1 : 0;
    }
    run.seconds = cpu_s() - started;
    return run;
}

Objectives thesis() {
    Objectives o;
    o.fragility_form = FragilityForm::thesis;
    return o;
}

Objectives quick(const Vec3& box) {
    Objectives o;
    o.weights = {0, 1, 0, 0, 0, 1, 0.05, 0, 0.1, 0};
    o.fragility_form = FragilityForm::binary;
    o.scope = TermScope::cut;
    o.print_volume = box;
    return o;
}

Objectives all(const Vec3& box) {
    Objectives o = quick(box);
    o.weights.connector = 1;
    o.weights.symmetry = 0.25;
    o.symmetry_plane = Plane{{1, 0, 0}, 0};
    return o;
}

void row(const char* what, const Run& run, double against, double most) {
    std::printf("| %s | %zu | %.1f | %.2f | %.1f |\n", what, run.planes, run.seconds, run.seconds / against, most);
    std::fflush(stdout);
}

void measure(const fs::path& data, bool is_small) {
    const auto head = is_small ? nullptr : scan(data / "ct_head_1912k.ply", 1);
    Measured m = head ? biggest("ct_head", *head) : one_shell("skull", Specimen::skull, is_small ? 20'000 : 1'900'000);
    const double length = norm(bounds(*m.piece.mesh).size());
    TriangleMesh mesh = *m.piece.mesh;
    const double longest = std::max({bounds(mesh).size().x, bounds(mesh).size().y, bounds(mesh).size().z});
    for (Vec3& p : mesh.points) p = (1000 / longest) * p;
    m.piece.mesh = std::make_shared<const TriangleMesh>(std::move(mesh));
    const OrientedBox box = oriented_box(m.piece.mesh->points);
    SearchSettings settings;
    settings.candidates.normals = CandidateNormals::sphere;
    settings.candidates.offsets_per_normal = offsets_per_normal;
    const std::vector<Planes> planes = by_normal(candidate_planes(m.piece, box, settings.candidates));
    std::printf("%s, %zu faces, %.0f mm scaled to 1 m; %zu normals\n\n", m.name.c_str(), m.faces(), length,
                planes.size());
    std::printf("| terms | planes | CPU s | x the four terms | at most |\n|---|---|---|---|---|\n");
    const Vec3 volume{400, 400, 400};
    const Run four = swept(m.piece, planes, thesis(), box);
    row("the four of the thesis", four, four.seconds, 1);
    const double peak = peak_mb();
    const double costs_started = cpu_s();
    find_seam_costs({&m.piece, 1});
    const double costs_s = cpu_s() - costs_started;
    row("parts, utilization, binary fragility, seam", swept(m.piece, planes, quick(volume), box), four.seconds, 1.6);
    row("and connector at 5 mm, symmetry", swept(m.piece, planes, all(volume), box), four.seconds, 2.8);
    const double more = (peak_mb() - peak) * 1024 * 1024 / static_cast<double>(m.faces());
    settings.objectives = all(volume);
    Segmentation s;
    s.pieces.push_back(m.piece);
    s.scan = measure_scan(s);
    EvaluationCache cache(settings.objectives, settings.candidates);
    Run late;
    const double started = cpu_s();
    late.planes = rank_late(s, 0, settings, cache, {}, max_own_boxes).size();
    late.seconds = cpu_s() - started;
    row("all, slow ones only where a normal can win", late, four.seconds, 1.5);
    std::printf(
        "\nSeam costs of the points, once per scan: %.1f s. Peak memory: %.0f bytes a face more than with the "
        "four terms.\n",
        costs_s, more);
}

}  // namespace
}  // namespace qchopper::bench

int main(int argc, char** argv) {
    std::filesystem::path data = qchopper::bench::default_data();
    bool is_small = false;
    for (int i = 1; i < argc; ++i) {
        const std::string argument = argv[i];
        if (argument == "--small") {
            is_small = true;
        } else if (argument == "--data" && i + 1 < argc) {
            data = argv[++i];
        } else {
            std::fputs("bench_chopper_terms [--small] [--data DIR]\n", stderr);
            return 64;
        }
    }
    const qchopper::ThreadLimit one_thread(1);
    qchopper::bench::measure(data, is_small);
    return 0;
}
