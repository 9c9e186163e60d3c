// Measures whole toolpaths: CPU time beside OpenMesh's reading of the same file, memory, and points per area carved.

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "bench/choice.h"
#include "bench/clock.h"
#include "bench/figures.h"
#include "bench/other_readers.h"
#include "cam/post/krl_text.h"
#include "cam/post/post.h"
#include "cam/program/make_program.h"
#include "cam/setup/choose_setup.h"
#include "cam/toolpath/make_toolpath.h"
#include "segment/mesh/measure.h"

namespace {

using namespace qchopper;
using namespace qchopper::bench;
namespace fs = std::filesystem;

constexpr const char* usage = R"(bench_whole_toolpath [--small] [--data FOLDER] [--only GROUP]...
  --small  pieces of a tenth of the size, to check that it runs; the targets do not apply
  --data   where ct_head_1912k.ply, bunny_bun_zipper.ply and igea_268k.ply lie
  --only   head, bunny or igea; all if none is named
)";

// Large enough for everything, a gantry, with tools as long as the piece is high.
Cell large_cell(double length) {
    Cell cell = read_cell(fs::path(QCHOPPER_SOURCE_DIR) / "cells" / "kr60-ha.toml");
    cell.workspace = {{-5000, -5000, -1000}, {5000, 5000, 5000}};
    cell.table = {0, 0, 4000, 4000, 0};
    cell.stock = {{"sawn", {3000, 3000, 3000}, Material::pu_foam, true, 3}};
    cell.machine->robot.reset();
    for (CuttingTool& tool : cell.machine->tools) tool.stick_out = length;
    return cell;
}

// The longest side of the box becomes `longest` mm.
Piece scaled(const Measured& measured, double longest) {
    auto mesh = std::make_shared<TriangleMesh>(*measured.piece.mesh);
    const Vec3 size = bounds(*mesh).size();
    const double factor = longest / std::max({size.x, size.y, size.z});
    for (Vec3& p : mesh->points) p = factor * p;
    Piece piece = measured.piece;
    piece.mesh = mesh;
    return piece;
}

struct Totals {
    std::size_t points = 0;
    std::size_t cuts = 0;  // points that end one
    std::size_t runs = 0;
    double cut_mm = 0;
    std::size_t bytes = 0;  // of the lines of a KRL program, which state the position alone
};

// Lines of one run as cam/post writes them: speeds where they change, and the positions.
std::size_t krl_bytes(const Operation& operation, const PathRun& run) {
    constexpr std::size_t around = std::string_view("LIN {}\r\n").size();
    constexpr std::size_t rounded = std::string_view(" C_DIS").size();
    constexpr std::size_t speed = std::string_view("$VEL.CP = 0.1000\r\n").size();
    std::size_t bytes = around + krl::position(run.start, 2).size();
    double feed = operation.link_feed;
    for (const PathMove& move : run.moves) {
        bytes += around + krl::position(move.tip, 2).size() + (move.rounding > 0 ? rounded : 0);
        if (feed_of(operation, move.kind) != feed) bytes += speed;
        feed = feed_of(operation, move.kind);
    }
    return bytes;
}

std::map<OperationKind, Totals> totals_of(const Toolpath& path) {
    std::map<OperationKind, Totals> totals;
    for (const Operation& operation : path.operations) {
        Totals& own = totals[operation.kind];
        for (const PathRun& run : operation.runs) {
            own.points += run.moves.size() + 1;
            ++own.runs;
            own.bytes += krl_bytes(operation, run);
            Vec3 at = run.start;
            for (const PathMove& move : run.moves) {
                if (move.kind == MoveKind::cut) {
                    own.cut_mm += norm(move.tip - at);
                    ++own.cuts;
                }
                at = move.tip;
            }
        }
    }
    return totals;
}

double reached_m2(const Setup& setup) {
    const SurfaceAccess& access = setup.access;
    return 1e-6 * (access.area_mm2 - access.unreachable_mm2());
}

void record(const std::string& name, const Setup& setup, const Toolpath& path, Figures& figures) {
    const double area = reached_m2(setup);
    figures.record(name, "surface reached, directions",
                   number_text(area) + " m2, " + std::to_string(setup.access.orientations.size()));
    for (const auto& [kind, totals] : totals_of(path)) {
        const double points = static_cast<double>(totals.points);
        figures.record(name, std::string(to_word(kind)) + ": length of cuts, points, of them at the end of cuts, runs",
                       number_text(1e-3 * totals.cut_mm) + " m, " + number_text(points) + ", " +
                           number_text(static_cast<double>(totals.cuts)) + ", " + std::to_string(totals.runs));
        const std::string what = std::string(to_word(kind)) + ": megabytes of KRL per m2";
        const double megabytes = 1e-6 * static_cast<double>(totals.bytes) / area;
        // One direction alone; scripts/prove has the figure of all directions of all pieces, which may be at most 4.
        figures.record(name, what, number_text(megabytes));
    }
}

void measure_one(const Choice& choice, const std::string& name, const std::string& file, double longest, double cell,
                 Figures& figures) {
    const auto mesh = scan(choice.data / file, 1000);
    if (!mesh) return;
    const double reading = best_of(3, cpu_s, [&] { return openmesh_read(choice.data / file, false); });
    const Piece piece = scaled(biggest(name, *mesh), choice.is_small ? 0.1 * longest : longest);
    const Cell machine = large_cell(1.5 * longest);
    SetupOptions options;
    options.samples = 1000;
    options.mapped = 1;
    const SetupChoice chosen = choose_setup(piece, machine, options);
    const Setup& setup = chosen.setups.front();
    ToolpathSettings settings;
    settings.cell = cell;
    figures.record(name, "faces", number_text(static_cast<double>(piece.mesh->triangles.size())));
    figures.record(name, "reading by OpenMesh, CPU time", time_text(reading));
    Toolpath path;
    for (const bool has_fine : {false, true}) {
        settings.fine = has_fine ? FineTools::all : FineTools::none;
        const double before = process_cpu_s();
        path = make_toolpath(setup, *piece.mesh, machine, settings);
        const double made = process_cpu_s();
        const std::vector<ProgramPart> parts = post_program(make_program(path, setup, {}, machine), machine, {1});
        const double spent = process_cpu_s() - before;
        const std::string what = std::string("roughing, finishing") + (has_fine ? ", fine finishing" : "") +
                                 " and post, cells of " + number_text(cell) + " mm";
        figures.record(name, what + ", CPU time (of that the post)",
                       time_text(spent) + " (" + time_text(spent - (made - before)) + ")");
        if (mesh->triangles.size() > 1'000'000 && !has_fine) {
            figures.at_most(name, what + " / reading by OpenMesh", spent / reading, 100);
        } else {
            figures.record(name, what + " / reading by OpenMesh", number_text(spent / reading));
        }
    }
    record(name, setup, path, figures);
}

double peak_megabytes() {
    std::ifstream status("/proc/self/status");
    for (std::string line; std::getline(status, line);) {
        if (line.starts_with("VmHWM:")) return 1e-3 * std::stod(line.substr(6));
    }
    return 0;
}

void measure(const Choice& choice, Figures& figures) {
    if (choice.wants("head")) measure_one(choice, "ct_head", "ct_head_1912k.ply", 1000, 0.5, figures);
    if (choice.wants("bunny")) measure_one(choice, "bunny", "bunny_bun_zipper.ply", 1500, 0.5, figures);
    if (choice.wants("igea")) measure_one(choice, "igea", "igea_268k.ply", 1000, 0.5, figures);
    // Of everything that was measured in this process.
    figures.at_most("all", "peak memory, GB", 1e-3 * peak_megabytes(), 1.5);
}

}  // namespace

int main(int argc, char** argv) {
    return print_figures(argc, argv, usage, measure);
}
