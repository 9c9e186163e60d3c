// Measures the work envelope of a setup of a 1 m piece with four directions: CPU time of one thread beside that of the
// height fields of its directions, and the predicate of the stop rule. Also how often the search for a place of the
// block finds one where a scan of all places does.

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <string>

#include "base/parallel.h"
#include "bench/choice.h"
#include "bench/clock.h"
#include "bench/figures.h"
#include "bench/specimens.h"
#include "cam/setup/block.h"
#include "cam/setup/choose_setup.h"
#include "cam/setup/placement/place_block.h"
#include "cam/setup/stock_fit.h"
#include "segment/mesh/measure.h"
#include "segment/raster/height_field.h"
#include "segment/search/search.h"
#include "tests/cam/setup/random_setups.h"

namespace {

using namespace qchopper;
using namespace qchopper::bench;

constexpr const char* usage = R"(bench_envelope [--small] [--only GROUP]...
  --small  100,000 faces instead, and 3 setups, to check that it runs; the targets do not apply
  --only   time, project or scan; all if none is named
)";

constexpr int runs = 3;
constexpr double longest_side = 1000;  // mm
constexpr double cells_of_side = 700;  // as mapped_access() takes them
constexpr double degree = std::numbers::pi / 180;

Cell ready_cell(const std::string& name) {
    return read_cell(std::filesystem::path(QCHOPPER_SOURCE_DIR) / "cells" / (name + ".toml"));
}

// Scaled to a longest side, which lies along y, where the tables are longest; its height is halved, as the blocks of
// the cells are no higher.
TriangleMesh piece(std::size_t faces, double side) {
    TriangleMesh mesh = *one_shell("skull", Specimen::skull, faces).piece.mesh;
    const Vec3 size = bounds(mesh).size();
    const double scale = side / std::max({size.x, size.y, size.z});
    for (Vec3& p : mesh.points) p = {scale * p.x, scale * p.y, 0.5 * scale * p.z};
    return mesh;
}

// Straight up, and further directions with a tilt all around.
Setup setup_of(const TriangleMesh& mesh, const Cell& cell, std::size_t directions, double tilt) {
    Setup setup;
    const Box box = bounds(mesh);
    setup.piece_in_setup.shift = -Vec3{box.centre().x, box.centre().y, box.min.z};
    setup.box = {box.min + setup.piece_in_setup.shift, box.max + setup.piece_in_setup.shift};
    const Margins margins = margins_of(cell);
    setup.spoil = margins.spoil;
    setup.block.size = box.size() + Vec3{2 * margins.sides, 2 * margins.sides, margins.top + margins.spoil};
    setup.access.orientations.push_back({{0, 0, 1}, 0, 0, 0});
    for (std::size_t i = 1; i < directions; ++i) {
        const double azimuth = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(directions - 1);
        const Vec3 tool_axis{std::sin(tilt) * std::cos(azimuth), std::sin(tilt) * std::sin(azimuth), std::cos(tilt)};
        setup.access.orientations.push_back({tool_axis, tilt / degree, 0, 0});
    }
    return setup;
}

void measure_time(const std::string& name, const TriangleMesh& mesh, double tilt, Figures& figures) {
    const Cell cell = ready_cell(name);
    const bool is_gantry = !cell.machine->robot;
    const Setup setup = setup_of(mesh, cell, is_gantry ? 1 : 4, tilt);
    const double maps = best_of(runs, cpu_s, [&] {
        std::size_t cells = 0;
        for (const ToolOrientation& d : setup.access.orientations) {
            cells += height_field(mesh, d.tool_axis, longest_side / cells_of_side).height.size();
        }
        return cells;
    });
    MachineReachability reachability;
    const double seconds = best_of(runs, cpu_s, [&] {
        reachability = place_block(setup, mesh, cell);
        return reachability.places;
    });
    const std::string what = name + ", " + number_text(static_cast<double>(mesh.triangles.size())) + " faces, tilt " +
                             number_text(tilt / degree);
    figures.record(what, "result", describe_reachability("A", reachability));
    figures.record(what, "poses, regions and places",
                   std::to_string(reachability.poses) + ", " + std::to_string(reachability.regions.size()) + ", " +
                       std::to_string(reachability.places));
    figures.record(what, "- of it: the poses",
                   time_text(best_of(runs, cpu_s, [&] { return milling_poses(setup, mesh, cell).size(); })));
    figures.record(what, "height maps and envelope", time_text(maps) + " and " + time_text(seconds));
    figures.at_most(what, "envelope / height maps", seconds / maps, 20);
    bool fits = false;
    const double predicate = best_of(runs, cpu_s, [&] {
        fits = fits_machine(setup, mesh, cell);
        return fits;
    });
    figures.at_most(what, std::string("predicate, CPU-s (") + (fits ? "fits)" : "does not fit)"), predicate, 0.2);
}

// How often the search finds a place, where places 5 cm and 10 degrees apart are all tried where it does not.
void measure_scan(const std::string& name, int setups, double& missed, Figures& figures) {
    const Cell cell = ready_cell(name);
    std::mt19937 random(50);
    int found = 0;
    int by_scan = 0;
    for (int i = 0; i < setups; ++i) {
        const test_setups::BoxSetup s = test_setups::random_setup(cell, random);
        PlacementOptions options;
        options.poses.step = 50;
        const std::vector<OrientationPoses> poses = milling_poses(s.setup, s.mesh, cell, options.poses);
        if (place_block(s.setup, poses, cell, options).holds()) {
            ++found;
        } else if (test_setups::scan_holds(s.setup, poses, cell, {50, 10})) {
            ++by_scan;
        }
    }
    figures.record(name, "of " + std::to_string(setups) + " setups: found by the search, and by the scan alone",
                   std::to_string(found) + " and " + std::to_string(by_scan));
    missed += by_scan;
}

// All pieces of a scan, each in the setup that is chosen for it.
void measure_project(std::size_t faces, Figures& figures) {
    const Measured m = whole("sample skull", piece(faces, longest_side));
    SearchSettings settings;
    settings.objectives.fragment_volume_mm3 = m.fragment_volume_mm3;
    settings.stop.min_cuts = 19;
    Segmentation pieces = uncut(*m.piece.mesh, m.fragment_volume_mm3);
    EvaluationCache cache(settings.objectives, settings.candidates);
    qchopper::search(pieces, settings, cache, {}, [](const Segmentation&) {}, {});
    for (const char* const name : {"kr60-ha", "irb6640-185-2.8", "kr120-r2500-pro-rotary", "gantry-3axis"}) {
        const Cell cell = ready_cell(name);
        std::vector<Setup> setups;
        const double choosing = best_of(1, cpu_s, [&] {
            for (const Piece& p : pieces.pieces) setups.push_back(choose_setup(p, cell).setups.front());
            return setups.size();
        });
        std::size_t held = 0;
        std::size_t in_boxes = 0;
        const double placing = best_of(1, cpu_s, [&] {
            for (std::size_t i = 0; i < setups.size(); ++i) {
                const MachineReachability reachability = place_block(setups[i], *pieces.pieces[i].mesh, cell);
                const bool fits = check_stock_fit(setups[i], cell).fits();
                held += reachability.holds() ? 1 : 0;
                in_boxes += fits ? 1 : 0;
                if (fits && !reachability.holds()) {
                    figures.record(name, "refused though its boxes fit",
                                   describe_reachability(pieces.pieces[i].name, reachability));
                }
            }
            return held;
        });
        const double asking = best_of(1, cpu_s, [&] {
            return std::count_if(pieces.pieces.begin(), pieces.pieces.end(),
                                 [&](const Piece& p) { return fits_cell_and_machine(p, cell, bases_of(p)); });
        });
        figures.record(
            name, "pieces, of them in the cell by boxes, and held",
            std::to_string(setups.size()) + ", " + std::to_string(in_boxes) + " and " + std::to_string(held));
        figures.record(name, "all setups, all envelopes, all stop rules",
                       time_text(choosing) + ", " + time_text(placing) + " and " + time_text(asking));
        figures.at_most(name, "stop rule, CPU-s a piece", asking / static_cast<double>(setups.size()), 0.2);
    }
}

void measure(const Choice& choice, Figures& figures) {
    const ThreadLimit one(1);
    const std::size_t faces = choice.is_small ? 100'000 : 1'900'000;
    if (choice.wants("time")) {
        const TriangleMesh mesh = piece(faces, longest_side);
        for (const char* const name : {"kr60-ha", "irb6640-185-2.8", "kr120-r2500-pro-rotary", "gantry-3axis"}) {
            measure_time(name, mesh, 30 * degree, figures);
        }
    }
    if (choice.wants("project")) measure_project(faces, figures);
    if (!choice.wants("scan")) return;
    double missed = 0;
    for (const char* const name : {"kr60-ha", "irb6640-185-2.8", "kr120-r2500-pro-rotary", "gantry-3axis"}) {
        measure_scan(name, choice.is_small ? 3 : 50, missed, figures);
    }
    figures.at_most("all cells", "setups for which the scan alone finds a place", missed, 0);
}

}  // namespace

int main(int argc, char** argv) {
    return print_figures(argc, argv, usage, measure);
}
