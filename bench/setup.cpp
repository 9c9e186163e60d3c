// Measures what a direction of a setup costs with all its figures, from a height field: CPU time of one thread beside
// OpenMesh's reading of the same piece as a binary PLY, and the memory beside the mesh. Also the directions that an arm
// holds, and all setups of a project beside the search that made its pieces.

#include <malloc.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <string>

#include "base/files/file.h"
#include "base/files/temporary_folder.h"
#include "base/parallel.h"
#include "bench/choice.h"
#include "bench/clock.h"
#include "bench/figures.h"
#include "bench/other_readers.h"
#include "bench/specimens.h"
#include "cam/setup/choose_setup.h"
#include "cam/setup/layout/lay_out.h"
#include "cam/setup/reachable_directions.h"
#include "cam/setup/stock_points.h"
#include "segment/access/tool_directions.h"
#include "segment/io/write_mesh.h"
#include "segment/mesh/measure.h"
#include "segment/search/search.h"
#include "tests/cam/setup/access_case.h"

namespace {

using namespace qchopper;
using namespace qchopper::bench;

constexpr const char* usage = R"(bench_setup [--small] [--only GROUP]...
  --small  100,000 faces instead, to check that it runs; the targets do not apply
  --only   map, memory, arm, layout or project; all if none is named
)";

constexpr int runs = 5;
constexpr double cell = 0.5;           // mm
constexpr double ball_radius = 3;      // mm
constexpr double longest_side = 1000;  // mm

// Scaled so that the longest side of its box is 1 m.
TriangleMesh piece(std::size_t faces) {
    TriangleMesh mesh = *one_shell("skull", Specimen::skull, faces).piece.mesh;
    const Vec3 size = bounds(mesh).size();
    const double scale = longest_side / std::max({size.x, size.y, size.z});
    for (Vec3& p : mesh.points) p = scale * p;
    return mesh;
}

test_pieces::AccessCase setup_of(const TriangleMesh& mesh) {
    test_pieces::AccessCase setup;
    setup.mesh = &mesh;
    setup.up = {0, 0, 1};
    const Box box = bounds(mesh);
    setup.piece_in_setup.shift = {0, 0, -box.min.z};
    setup.block = {box.min - Vec3{10, 10, box.min.z + 10}, box.max + Vec3{10, 10, 10 - box.min.z}};
    setup.directions = {setup.up};
    setup.tool = ToolBody{150, {{40, 50}, {180, 350}}};
    setup.smallest_ball_radius = ball_radius;
    return setup;
}

void measure_map(const TriangleMesh& mesh, const std::string& name, Figures& figures) {
    const TemporaryFolder folder("qchopper-bench-");
    write_file(folder.path() / "piece.ply", to_ply(mesh));
    const test_pieces::AccessCase setup = setup_of(mesh);
    double ours = std::numeric_limits<double>::infinity();
    double theirs = ours;
    for (int i = 0; i < runs; ++i) {
        theirs = std::min(theirs, best_of(1, cpu_s, [&] { return openmesh_read(folder.path() / "piece.ply", false); }));
        ours = std::min(ours, best_of(1, cpu_s, [&] { return mapped_access(setup, {.cell = cell}); }));
    }
    figures.record(name, "one direction, and OpenMesh's reading of the PLY",
                   time_text(ours) + " and " + time_text(theirs));
    figures.at_most(name, "one direction / OpenMesh's reading", ours / theirs, 4);

    const auto step = [&](const std::string& what, const auto& work) {
        figures.record(name, "- of it: " + what, time_text(best_of(runs, cpu_s, work)));
    };
    HeightField map = height_field(mesh, setup.up, cell);
    figures.record(name, "cells of the map", number_text(static_cast<double>(map.height.size())));
    step("height map", [&] { return height_field(mesh, setup.up, cell); });
    step("reached share, once for the map and once where the holder raises it",
         [&] { return reached_share(mesh, map).size() + reached_share(mesh, map).size(); });
    const Box box{{setup.block.min.x + 10, setup.block.min.y + 10, 0}, setup.block.max - Vec3{10, 10, 10}};
    const StockPoints all(mesh, setup.piece_in_setup, box, HeightFieldOptions{}.stock_points);
    step("points of foam outside of the piece",
         [&] { return StockPoints(mesh, setup.piece_in_setup, box, HeightFieldOptions{}.stock_points); });
    step("foam above the map taken away", [&] {
        StockPoints stock_points = all;
        stock_points.mill(map);
        return stock_points;
    });
    const HeightField wide = coarser(map, ball_radius / 3.5 / cell);
    step("closing by the ball, for the rest material",
         [&] { return closed_by_ball(coarser(map, ball_radius / 3.5 / cell), ball_radius); });
    const HeightField closed = closed_by_ball(wide, ball_radius);
    step("foam above the closing taken away", [&] {
        StockPoints stock_points = all;
        stock_points.mill(map, {&wide, &closed});
        return stock_points;
    });
    step("holder and spindle", [&] {
        HeightField raised = map;
        return raise_to_holder_clearance(raised, *setup.tool, setup.piece_in_setup);
    });
}

// Bytes of this process by a line of /proc/self/status; 0 where there is none.
double status_bytes(const std::string& key) {
    std::ifstream status("/proc/self/status");
    for (std::string line; std::getline(status, line);) {
        if (line.starts_with(key + ":")) return 1024 * std::stod(line.substr(key.size() + 1));
    }
    return 0;
}

// Of all memory that it needs at once; 0 if that is not known.
template <class Work>
double peak_bytes(const Work& work) {
    // Memory that was freed before is not to be used again unseen.
    mallopt(M_MMAP_THRESHOLD, 1 << 16);
    malloc_trim(0);
    if (!(std::ofstream("/proc/self/clear_refs") << "5" << std::flush)) return 0;
    const double before = status_bytes("VmRSS");
    const auto result = work();
    static_cast<void>(result);
    return status_bytes("VmHWM") - before;
}

// Two measures with cells of two sizes tell the bytes of a cell from those of a face.
void measure_memory(const TriangleMesh& mesh, const std::string& name, Figures& figures) {
    const test_pieces::AccessCase setup = setup_of(mesh);
    const auto peak = [&](double side) { return peak_bytes([&] { return mapped_access(setup, {.cell = side}); }); };
    const auto cells = [&](double side) {
        return static_cast<double>(height_field(mesh, setup.up, side).height.size());
    };
    peak(cell);
    const double coarse = peak(cell);
    const double fine = peak(cell / 4);
    if (coarse == 0) {
        figures.record(name, "memory", "not known on this machine");
        return;
    }
    const double a_cell = (fine - coarse) / (cells(cell / 4) - cells(cell));
    const double faces = static_cast<double>(mesh.triangles.size());
    figures.at_most(name, "bytes a cell of the map", a_cell, 8);
    figures.at_most(name, "bytes a face beside the mesh and 8 bytes a cell", (coarse - 8 * cells(cell)) / faces, 60);
    figures.record(name, "bytes a face, with the map", number_text(coarse / faces));
}

Cell ready_cell(const std::string& name) {
    return read_cell(std::filesystem::path(QCHOPPER_SOURCE_DIR) / "cells" / (name + ".toml"));
}

void measure_arm(Figures& figures) {
    std::vector<Vec3> directions = dense_directions(1528);
    std::erase_if(directions, [](Vec3 d) { return d.z < 0; });
    for (const char* const name : {"kr60-ha", "irb6640-185-2.8", "kr120-r2500-pro-rotary"}) {
        const Cell ready = ready_cell(name);
        for (const double side : {300.0, 900.0}) {
            const Box box{{-side / 2, -side / 2, 0}, {side / 2, side / 2, side}};
            const std::string what = ", box of " + number_text(side) + " mm";
            const double seconds =
                best_of(runs, cpu_s, [&] { return reachable_directions(ready, box, 10, directions); });
            const std::vector<std::uint8_t> flags = reachable_directions(ready, box, 10, directions);
            figures.record(
                name, "directions held" + what,
                std::to_string(std::count(flags.begin(), flags.end(), 1)) + " of " + std::to_string(flags.size()));
            figures.at_most(name, "asked for, ms" + what, 1000 * seconds, 50);
        }
    }
}

// The pieces of 19 cuts.
Segmentation searched(const Measured& m) {
    SearchSettings settings;
    settings.objectives.fragment_volume_mm3 = m.fragment_volume_mm3;
    settings.stop.min_cuts = 19;
    Segmentation s = uncut(*m.piece.mesh, m.fragment_volume_mm3);
    EvaluationCache cache(settings.objectives, settings.candidates);
    qchopper::search(s, settings, cache, {}, [](const Segmentation&) {}, {});
    return s;
}

// What it takes to find the flush caps of a piece on one base, its turn and its block, beside what it took without
// blocks that are sawn.
void measure_layout(std::size_t faces, Figures& figures) {
    const Cell sawn = ready_cell("kr60-ha");
    Cell unsawn = sawn;
    for (Stock& stock : unsawn.stock) stock.is_sawn = false;
    double most = 0;
    double most_added = 0;
    std::size_t bases = 0;
    for (const Piece& piece : searched(one_shell("sample skull", Specimen::skull, faces)).pieces) {
        for (const PieceBase& base : bases_of(piece)) {
            const auto ms_with = [&](const Cell& of) {
                const double seconds =
                    best_of(runs, cpu_s, [&] { return lay_out(piece, base, of, caps_to_saw(*piece.mesh, of)); });
                return 1000 * seconds * 1e5 / static_cast<double>(piece.mesh->triangles.size());
            };
            if (!base.base.cut) continue;
            const double ms = ms_with(sawn);
            most = std::max(most, ms);
            most_added = std::max(most_added, ms - ms_with(unsawn));
            ++bases;
        }
    }
    const std::string name = "pieces of the skull, " + std::to_string(bases) + " bases";
    figures.record(name, "piece laid out, ms per 100,000 faces, the slowest", number_text(most));
    figures.at_most(name, "- of it for flush caps, turn and sawn block", most_added, 5);
}

// CPU time of one thread.
void measure_project(std::size_t faces, Figures& figures) {
    const Measured m = one_shell("sample skull", Specimen::skull, faces);
    Segmentation s;
    const double search = best_of(1, cpu_s, [&] {
        s = searched(m);
        return s.pieces.size();
    });
    const Cell ready = ready_cell("irb6640-185-2.8");
    std::size_t maps = 0;
    const double setups = best_of(1, cpu_s, [&] {
        for (const Piece& piece : s.pieces) {
            const SetupChoice choice = choose_setup(piece, ready);
            maps += static_cast<std::size_t>(
                std::count_if(choice.setups.begin(), choice.setups.end(),
                              [](const Setup& setup) { return setup.access.method == AccessMethod::mapped; }));
        }
        return maps;
    });
    const std::string name = "sample skull, " + number_text(static_cast<double>(m.faces()));
    figures.record(name, "search for " + std::to_string(s.pieces.size()) + " pieces, and all their setups",
                   time_text(search) + " and " + time_text(setups));
    figures.record(name, "- of them judged by height maps", std::to_string(maps));
    figures.at_most(name, "all setups / search", setups / search, 2);
}

void measure(const Choice& choice, Figures& figures) {
    const ThreadLimit one(1);
    if (choice.wants("project")) measure_project(choice.is_small ? 100'000 : 1'900'000, figures);
    if (choice.wants("layout")) measure_layout(choice.is_small ? 100'000 : 1'900'000, figures);
    if (choice.wants("arm")) measure_arm(figures);
    if (!choice.wants("map") && !choice.wants("memory")) return;
    const TriangleMesh mesh = piece(choice.is_small ? 100'000 : 1'900'000);
    const std::string name = "skull of 1 m, " + number_text(static_cast<double>(mesh.triangles.size()));
    if (choice.wants("memory")) measure_memory(mesh, name, figures);
    if (choice.wants("map")) measure_map(mesh, name, figures);
}

}  // namespace

int main(int argc, char** argv) {
    return print_figures(argc, argv, usage, measure);
}
