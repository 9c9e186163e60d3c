// Measures what the directions of a setup cost, rays apart, and where a ball fits: CPU time of one thread, beside the
// time in which OpenMesh reads the same scan.

#include <algorithm>
#include <array>
#include <numeric>
#include <string>
#include <vector>

#include "base/file.h"
#include "base/parallel.h"
#include "base/temporary_folder.h"
#include "bench/choice.h"
#include "bench/clock.h"
#include "bench/figures.h"
#include "bench/other_readers.h"
#include "segment/io/write_ply.h"
#include "segment/mesh/oriented_box.h"
#include "segment/mesh/triangle_tree.h"
#include "segment/score/chosen_directions.h"
#include "segment/score/tool_fit.h"

namespace {

using namespace qchopper;
using namespace qchopper::bench;
namespace fs = std::filesystem;

constexpr const char* usage = R"(bench_setup [--small] [--data FOLDER] [--only GROUP]...
  --small  the sample skull with 20,000 faces instead, to check that it runs; the targets do not apply
  --data   where ct_head_1912k.ply lies; without it the sample skull with 1.9 million faces is taken
  --only   directions or ball; both if none is named
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
    options.least_gain = 0;
    const auto choose = [&] { return choose_directions(judged, {axes[2], std::nullopt}, possible, {}, options); };
    const std::string what = "choosing " + std::to_string(choose().chosen.size()) + " of " +
                             std::to_string(possible.size()) + " directions on " +
                             number_text(static_cast<double>(accessibility.sample.size())) + " samples, rays apart";
    const double time = best_of(runs, cpu_s, choose);
    figures.record(measured.name, what, time_text(time));
    figures.at_most(measured.name, what + " / reading by OpenMesh", time / reading_s, 8);
    const std::vector<Vec3> dense = dense_directions();
    const auto with_dense = [&] {
        return choose_directions(judged, {axes[2], std::nullopt}, possible, dense, options).chosen.size();
    };
    figures.record(measured.name, "the same with rays along 2,000 dense directions",
                   time_text(best_of(1, cpu_s, with_dense)));
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
    if (choice.wants("ball")) measure_ball(measured, figures);
}

}  // namespace

int main(int argc, char** argv) {
    return print_figures(argc, argv, usage, measure);
}
