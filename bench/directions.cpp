// Measures what the directions of a setup cost, rays apart, and where a ball fits: CPU time of one thread, beside the
// time in which OpenMesh reads the same scan.

#include <algorithm>
#include <array>
#include <numeric>
#include <string>
#include <vector>

#include "base/files/file.h"
#include "base/files/temporary_folder.h"
#include "base/parallel.h"
#include "bench/choice.h"
#include "bench/clock.h"
#include "bench/figures.h"
#include "bench/other_readers.h"
#include "segment/access/piece_access.h"
#include "segment/access/tool_fit.h"
#include "segment/cut/cut_piece.h"
#include "segment/cut/nudge.h"
#include "segment/io/write_mesh.h"
#include "segment/mesh/oriented_box.h"
#include "segment/mesh/triangle_tree.h"

namespace {

using namespace qchopper;
using namespace qchopper::bench;
namespace fs = std::filesystem;

constexpr const char* usage = R"(bench_directions [--small] [--data FOLDER] [--only GROUP]...
  --small  the sample skull with 20,000 faces instead, to check that it runs; the targets do not apply
  --data   where ct_head_1912k.ply lies; without it the sample skull with 1.9 million faces is taken
  --only   directions, piece or ball; all if none is named
)";

constexpr int runs = 5;

void measure_directions(const Measured& measured, double reading_s, Figures& figures) {
    const std::array<Piece, 1> pieces{measured.piece};
    const std::array<Vec3, 3> axes = oriented_box(measured.piece.mesh->points).axis;
    const SampledScan scan = sampled_scan(pieces, tool_directions(axes));
    const PieceAccessibility accessibility = uncut_accessibility(scan)[0];
    const JudgedPiece judged{scan, accessibility, {}};
    std::vector<std::uint32_t> possible(scan.directions.size());
    std::iota(possible.begin(), possible.end(), 0U);
    DirectionOptions options;
    options.min_gain = 0;
    const auto choose = [&] { return choose_directions(judged, {axes[2], std::nullopt}, possible, {}, options); };
    const std::string what = "choosing " + std::to_string(choose().chosen.size()) + " of " +
                             std::to_string(possible.size()) + " directions on " +
                             number_text(static_cast<double>(accessibility.sample.size())) + " samples, rays apart";
    const double time = best_of(runs, cpu_s, choose);
    figures.record(measured.name, what, time_text(time));
    figures.at_most(measured.name, what + " / reading by OpenMesh", time / reading_s, 8);
}

// Half of the scan, on the cap of the cut.
void measure_piece(const Measured& measured, Figures& figures) {
    const Vec3 normal = canonical({oriented_box(measured.piece.mesh->points).axis[0], 0}).normal;
    const Extent range = extent(*measured.piece.mesh, normal);
    const auto nudged = nudge(measured.piece, normal, std::array{range.low + 0.45 * range.size()});
    const auto made = nudged[0] ? cut_piece(measured.piece, {normal, nudged[0]->offset}, 1) : std::nullopt;
    if (!made) return;
    const Piece& piece = made->pieces[0];
    const std::string name = measured.name + ", a half";
    const std::vector<PieceBase> bases = bases_of(piece);
    const PieceAccessOptions options;
    const auto reach_all = [&] { return piece_access(piece, {bases.data(), 1}, options); };
    figures.record(name, "faces", number_text(static_cast<double>(piece.mesh->triangles.size())));
    figures.record(name, "bases", time_text(best_of(runs, cpu_s, [&] { return bases_of(piece); })));
    figures.record(name, "reach from one base, 4,000 samples", time_text(best_of(runs, cpu_s, reach_all)));
    const PieceAccess access = reach_all();
    const JudgedPiece judged = access.samples->judged();
    const TiltBase& base = bases[0].base;
    const std::vector<std::uint32_t> possible = allowed_directions(judged.scan.directions, base.up, options.tilt_deg);
    std::vector<Vec3> dense = dense_directions();
    std::erase_if(dense, [&](const Vec3& d) { return !is_allowed(d, base.up, options.tilt_deg); });
    const auto choose = [&](std::span<const Vec3> asked) {
        return best_of(runs, cpu_s, [&] { return choose_directions(judged, base, possible, asked); });
    };
    const ChosenDirections chosen = choose_directions(judged, base, possible, dense);
    figures.record(name,
                   "of it choosing " + std::to_string(chosen.chosen.size()) + " of " + std::to_string(possible.size()) +
                       " directions",
                   time_text(choose({})));
    figures.record(name, "the same with " + std::to_string(dense.size()) + " dense directions",
                   time_text(choose(dense)));
    const auto share = [&](const UnreachableArea& area) {
        return number_text(100 * area.total_mm2(options.tilt_deg) / access.best().area_mm2) + " %";
    };
    figures.record(name, "unreachable by the chosen, and by all",
                   share(chosen.by_chosen) + ", " + share(chosen.by_all));
}

void measure_ball(const Measured& measured, Figures& figures) {
    const TriangleMesh& mesh = *measured.piece.mesh;
    const SurfaceSamples samples = surface_samples(std::array{SampledSurface{&mesh, {}}});
    const double tree = best_of(runs, cpu_s, [&] { return TriangleTree(mesh); });
    figures.record(measured.name, "tree for balls", time_text(tree));
    for (const double radius : {1.5, 3.0, 5.0, 10.0}) {
        const BallFit ball{radius};
        std::size_t narrow = 0;
        const double time = best_of(runs, cpu_s, [&] {
            const std::vector<bool> is_narrow = too_narrow(mesh, {}, samples.sample, ball);
            narrow = static_cast<std::size_t>(std::count(is_narrow.begin(), is_narrow.end(), true));
            return narrow;
        });
        const double share = 100.0 * static_cast<double>(narrow) / static_cast<double>(samples.sample.size());
        figures.record(measured.name, "20,000 balls of radius " + number_text(radius) + " mm, tree included",
                       time_text(time) + "; " + number_text(share) + " % do not fit");
    }
}

// The sample skull, written to a file for the reader that this is compared with.
fs::path written(const Measured& measured, const TemporaryFolder& folder) {
    fs::path file = folder.path() / "scan.ply";
    write_file(file, to_ply(*measured.piece.mesh));
    return file;
}

void measure(const Choice& choice, Figures& figures) {
    const ThreadLimit one(1);
    const TemporaryFolder folder("qchopper-bench-");
    fs::path file = choice.data / "ct_head_1912k.ply";
    const auto head = choice.is_small ? nullptr : scan(file, 1);
    const Measured measured =
        head ? biggest("ct_head", *head) : one_shell("skull", Specimen::skull, choice.is_small ? 20'000 : 1'900'000);
    if (!head) file = written(measured, folder);
    const double reading = best_of(runs, cpu_s, [&] { return openmesh_read(file, false); });
    figures.record(measured.name, "reading by OpenMesh, single precision", time_text(reading));
    if (choice.wants("directions")) measure_directions(measured, reading, figures);
    if (choice.wants("piece")) measure_piece(measured, figures);
    if (choice.wants("ball")) measure_ball(measured, figures);
}

}  // namespace

int main(int argc, char** argv) {
    return print_figures(argc, argv, usage, measure);
}
