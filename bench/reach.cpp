// Measures the rays of a scan, and what a cut costs afterwards: CPU time of one thread. Beside it the same rays in
// single precision, one by one, without their distances' last bits being the same on every processor.

#include <cmath>
#include <string>

#include "base/parallel.h"
#include "bench/choice.h"
#include "bench/clock.h"
#include "bench/figures.h"
#include "segment/access/accessibility.h"
#include "segment/access/unreachable.h"
#include "segment/cut/nudge.h"
#include "segment/mesh/oriented_box.h"

namespace {

using namespace qchopper;
using namespace qchopper::bench;

constexpr const char* usage = R"(bench_reach [--small] [--data FOLDER] [--only MESH]...
  --small  the sample skull with 20,000 faces alone, to check that it runs
  --only   skull or ct_head; both if none is named
)";

constexpr int runs = 3;

std::size_t rays_of(const SampledScan& scan) {
    std::size_t count = 0;
    for (const SurfaceSample& sample : scan.samples.sample) {
        for (const Vec3& d : scan.directions) count += dot(sample.normal, d) >= min_facing ? 1 : 0;
    }
    return count;
}

std::size_t single_precision_hits(const SampledScan& scan, const RayTree& tree) {
    std::size_t hits = 0;
    for (const SurfaceSample& sample : scan.samples.sample) {
        const Vec3 origin = sample.point + (1e-6 * scan.diagonal_mm) * sample.normal;
        for (const Vec3& d : scan.directions) {
            if (dot(sample.normal, d) >= min_facing && tree.first_hit(origin, d)) ++hits;
        }
    }
    return hits;
}

void measure_mesh(const Measured& measured, Figures& figures) {
    const std::string name = measured.name + " " + number_text(static_cast<double>(measured.faces()));
    const std::array<Piece, 1> pieces{measured.piece};
    const TriangleMesh& mesh = *measured.piece.mesh;
    const std::vector<Vec3> directions = tool_directions(oriented_box(mesh.points).axis);
    const double all = best_of(runs, process_cpu_s, [&] { return sampled_scan(pieces, directions); });
    const SampledScan scan = sampled_scan(pieces, directions);
    const auto samples = [&] { return surface_samples(std::array{SampledSurface{&mesh, {}}}); };
    const double rays = best_of(runs, cpu_s, [&] { return uncut_accessibility(scan); });
    figures.record(name, "samples", time_text(best_of(runs, cpu_s, samples)));
    figures.record(name, "tree and samples", time_text(all));
    figures.record(name, "rays", number_text(static_cast<double>(rays_of(scan))));
    figures.record(name, "rays of the scan", time_text(rays));
    const double tree = best_of(runs, process_cpu_s, [&] { return RayTree(mesh); });
    const RayTree single(mesh);
    const double single_rays = best_of(runs, cpu_s, [&] { return single_precision_hits(scan, single); });
    figures.record(name, "tree in single precision", time_text(tree));
    figures.record(name, "rays of the scan in single precision", time_text(single_rays));
    figures.record(name, "rays / in single precision", number_text(rays / single_rays));

    const PieceAccessibility whole = uncut_accessibility(scan)[0];
    const Vec3 normal = canonical({oriented_box(mesh.points).axis[0], 0}).normal;
    const Extent range = extent(mesh, normal);
    const auto nudged = nudge(measured.piece, normal, std::array{range.low + 0.45 * range.size()});
    if (!nudged[0]) return;
    const auto made = cut_piece(measured.piece, {normal, nudged[0]->offset}, 1);
    const double update = best_of(runs, cpu_s, [&] { return cut_accessibility(scan, whole, *made); });
    figures.record(name, "update at a cut to " + std::to_string(made->pieces.size()) + " solids", time_text(update));
    const std::vector<PieceAccessibility> after = cut_accessibility(scan, whole, *made);
    const std::vector<OwnedCap> caps = owned_caps(made->pieces[0]);
    const JudgedPiece judged{scan, after[0], caps};
    const TiltBase base = lying_on(caps.front());
    const double share =
        unreachable_area(judged, base, default_tilt_deg).total_mm2(default_tilt_deg) / judged.surface_mm2(base);
    figures.record(name, "unreachable share of its first piece", number_text(100 * share) + " %");
    const auto one = [&] { return unreachable_area(judged, base, default_tilt_deg); };
    figures.record(name, "its unreachable area for one base", time_text(best_of(runs, cpu_s, one)));
    const std::vector<Vec3> dense = dense_directions();
    const auto again = [&] { return unreachable_area(judged, base, default_tilt_deg, dense); };
    figures.record(name, "the same with dense directions", time_text(best_of(runs, cpu_s, again)));
}

void measure(const Choice& choice, Figures& figures) {
    const ThreadLimit one(1);
    if (choice.wants("skull")) {
        measure_mesh(one_shell("skull", Specimen::skull, choice.is_small ? 20'000 : 1'900'000), figures);
    }
    if (choice.is_small || !choice.wants("ct_head")) return;
    const auto head = scan(choice.data / "ct_head_371k.ply", 1);
    if (head) measure_mesh(biggest("ct_head", *head), figures);
}

}  // namespace

int main(int argc, char** argv) {
    return print_figures(argc, argv, usage, measure);
}
