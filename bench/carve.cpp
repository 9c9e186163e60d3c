// Measures the rays of a scan beside Embree's own, and the sweep of what is out of reach beside the thesis' first
// decision: CPU time, one thread.

#include <malloc.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "app/engine/presets.h"
#include "base/parallel.h"
#include "bench/choice.h"
#include "bench/clock.h"
#include "bench/embree_rays.h"
#include "bench/figures.h"
#include "bench/measures.h"
#include "segment/access/access_sweep.h"
#include "segment/access/sampled_piece.h"
#include "segment/cut/cut_piece.h"
#include "segment/cut/nudge.h"
#include "segment/mesh/oriented_box.h"
#include "segment/search/candidates/candidates.h"
#include "segment/search/rank_piece.h"

namespace {

using namespace qchopper;
using namespace qchopper::bench;

constexpr const char* usage = R"(bench_carve [--small] [--data FOLDER] [--only GROUP]...
  --small  the sample skull with 20,000 faces instead, to check that it runs; the targets do not apply
  --data   where ct_head_1912k.ply lies; without it the sample skull with 1.9 million faces is taken
  --only   rays, sweep, areas, decision or run; all if none is named
)";

constexpr int runs = 3;
constexpr int offsets_per_normal = 80;

double heap_bytes() {
    const struct mallinfo2 info = mallinfo2();
    return static_cast<double>(info.uordblks + info.hblkhd);
}

std::vector<FreeRay> rays_of(const SampledScan& scan) {
    std::vector<FreeRay> rays;
    for (const SurfaceSample& sample : scan.samples.sample) {
        const Vec3 origin = sample.point + (1e-6 * scan.diagonal_mm) * sample.normal;
        for (const Vec3& d : scan.directions) {
            if (dot(sample.normal, d) >= min_facing) rays.push_back({origin, d});
        }
    }
    return rays;
}

void measure_rays(const Measured& measured, const std::vector<Vec3>& directions, Figures& figures) {
    const std::array<Piece, 1> pieces{measured.piece};
    const TriangleMesh& mesh = *measured.piece.mesh;
    const double tree = best_of(runs, process_cpu_s, [&] { return PreciseRays(std::array{&mesh}); });
    const SampledScan scan = sampled_scan(pieces, directions);
    const double rays = best_of(runs, process_cpu_s, [&] { return uncut_accessibility(scan); });
    const std::vector<FreeRay> same = rays_of(scan);
    const double own_tree = best_of(runs, process_cpu_s, [&] { return std::make_unique<const EmbreeRays>(mesh); });
    const EmbreeRays embree(mesh);
    const double own_rays = best_of(runs, process_cpu_s, [&] { return embree.first_hits(same); });
    figures.record(measured.name, "rays", number_text(static_cast<double>(same.size())));
    figures.record(measured.name, "tree; rays", time_text(tree) + "; " + time_text(rays));
    figures.record(measured.name, "Embree's own tree; rays", time_text(own_tree) + "; " + time_text(own_rays));
    figures.record(measured.name, "rays alone / Embree's own rays alone", number_text(rays / own_rays));
    figures.record(measured.name, "tree and rays / Embree's own tree and rays",
                   number_text((tree + rays) / (own_tree + own_rays)));
    figures.at_most(measured.name, "rays / Embree's own tree and rays", rays / (own_tree + own_rays), 1.3);

    const double before = heap_bytes();
    const std::vector<PieceAccessibility> all = uncut_accessibility(scan);
    const double bytes = heap_bytes() - before - 4.0 * static_cast<double>(mesh.triangles.size());
    const auto distances = static_cast<double>(scan.samples.sample.size() * directions.size());
    figures.at_most(measured.name, "memory of the distances, bytes per sample and direction", bytes / distances, 4.4);
}

struct Candidates {
    Vec3 normal;
    std::vector<double> offsets;
};

// The normals among the directions, one of each two signs.
std::vector<Candidates> candidates_of(const Piece& piece, const std::vector<Vec3>& directions) {
    std::vector<Candidates> all;
    for (std::size_t k = 0; k < directions.size(); k += 2) {
        Candidates& c = all.emplace_back();
        c.normal = canonical({directions[k], 0}).normal;
        const Extent range = extent(*piece.mesh, c.normal);
        for (int j = 1; j <= offsets_per_normal; ++j) {
            c.offsets.push_back(range.low + range.size() * j / (offsets_per_normal + 1));
        }
    }
    return all;
}

struct Swept {
    Piece piece;
    PieceAccessibility accessibility;
};

// What is left when each of the first `sides` sides of the box has lost a tenth.
Swept shaved(const Measured& measured, const SampledScan& scan, int sides) {
    const std::array<Vec3, 3> axes = oriented_box(measured.piece.mesh->points).axis;
    Swept left{measured.piece, std::move(uncut_accessibility(scan)[0])};
    for (std::int32_t side = 0; side < sides; ++side) {
        const Vec3 normal = canonical({axes[static_cast<std::size_t>(side % 3)], 0}).normal;
        const bool keeps_above = side < 3;
        const Extent range = extent(*measured.piece.mesh, normal);
        const double share = keeps_above ? 0.1 : 0.9;
        const auto nudged = nudge(left.piece, normal, std::array{range.low + share * range.size()});
        const auto made = nudged[0] ? cut_piece(left.piece, {normal, nudged[0]->offset}, side + 1) : std::nullopt;
        if (!made) continue;
        std::vector<PieceAccessibility> after = cut_accessibility(scan, left.accessibility, *made);
        std::size_t most = 0;
        for (std::size_t k = 1; k < after.size(); ++k) {
            if (after[k].sample.size() > after[most].sample.size()) most = k;
        }
        left = {made->pieces[most], std::move(after[most])};
    }
    return left;
}

void measure_sweep(const Measured& measured, const SampledScan& scan, Figures& figures) {
    const double decision = first_decision_s(measured, runs);
    figures.record(measured.name, "the thesis' first decision, 3 x 40", time_text(decision));
    for (const auto& [sides, most] : {std::pair{0, 0.2}, {1, 0.0}, {3, 0.0}, {6, 0.5}}) {
        const Swept swept = shaved(measured, scan, sides);
        const std::vector<OwnedCap> caps = owned_caps(swept.piece);
        const JudgedPiece judged{scan, swept.accessibility, caps};
        const double before = heap_bytes();
        const AccessSweep sweep(swept.piece, judged, default_tilt_deg);
        const double bytes = heap_bytes() - before;
        const double preparation =
            best_of(runs, cpu_s, [&] { return std::make_unique<AccessSweep>(swept.piece, judged, 60); });
        const std::vector<Candidates> all = candidates_of(swept.piece, scan.directions);
        const double time = best_of(runs, cpu_s, [&] {
            double sum = 0;
            for (const Candidates& c : all) {
                for (const PlaneAccess& plane : sweep.sweep(c.normal, c.offsets)) {
                    sum += plane.unreachable_mm2();
                }
            }
            return sum;
        });
        const std::string what = "sweep of " + std::to_string(all.size()) + " normals, " + std::to_string(caps.size()) +
                                 " old bases, " + number_text(static_cast<double>(swept.accessibility.sample.size())) +
                                 " samples";
        figures.record(
            measured.name, what,
            time_text(time) + ", preparation " + time_text(preparation) + ", " + number_text(bytes / 1e6) + " MB");
        if (most > 0) figures.at_most(measured.name, what + " / first decision", time / decision, most);
        if (most > 0) {
            figures.record(measured.name, what + " with its preparation / first decision",
                           number_text((time + preparation) / decision));
        }
    }
}

// The area of the new cap as the samples have it, beside that of the cut.
void measure_areas(const Measured& measured, const SampledScan& scan, Figures& figures) {
    for (const int sides : {0, 3}) {
        const Swept swept = shaved(measured, scan, sides);
        const std::vector<OwnedCap> caps = owned_caps(swept.piece);
        const JudgedPiece judged{scan, swept.accessibility, caps};
        const AccessSweep sweep(swept.piece, judged, default_tilt_deg);
        std::vector<double> errors;    // of the piece's area
        std::vector<double> relative;  // of the cap's area
        for (const Candidates& c : candidates_of(swept.piece, scan.directions)) {
            const std::size_t n = errors.size() % c.offsets.size();
            const std::vector<PlaneAccess> planes = sweep.sweep(c.normal, c.offsets);
            for (const std::size_t j : {n, (n + c.offsets.size() / 2) % c.offsets.size()}) {
                const auto halves = cut(*swept.piece.mesh, {c.normal, c.offsets[j]}, 99);
                if (!halves || halves->cap_area_mm2 <= 0) continue;
                const double error = std::abs(planes[j].below[0].base_mm2 - halves->cap_area_mm2);
                errors.push_back(error / judged.area_mm2());
                relative.push_back(error / halves->cap_area_mm2);
            }
            if (errors.size() >= 60) break;
        }
        for (std::vector<double>* all : {&errors, &relative}) {
            std::sort(all->begin(), all->end());
            const auto percent = [&](double share) {
                const auto at = static_cast<std::size_t>(share * static_cast<double>(all->size() - 1));
                return number_text(100 * (*all)[at]) + " %";
            };
            figures.record(measured.name + ", " + std::to_string(caps.size()) + " caps",
                           std::string("error of the new cap's area, of the ") +
                               (all == &errors ? "piece's area" : "cap's area") + ": median, 90 % of planes, largest",
                           percent(0.5) + ", " + percent(0.9) + ", " + percent(1));
        }
    }
}

SearchSettings carve_settings(const Measured& measured) {
    SearchSettings settings = *preset("carve");
    settings.objectives.fragment_volume_mm3 = measured.fragment_volume_mm3;
    settings.stop.max_unreachable.reset();
    return settings;
}

// Beside the thesis' first decision: with samples and rays made before, because they serve the whole segmentation.
void measure_decision(const Measured& measured, Figures& figures) {
    const double thesis = first_decision_s(measured, runs);
    const SearchSettings settings = carve_settings(measured);
    Segmentation uncut_scan = uncut(*measured.piece.mesh, measured.fragment_volume_mm3);
    sample_uncut(uncut_scan.pieces);
    std::size_t planes = 0;
    const double carve = best_of(runs, cpu_s, [&] {
        EvaluationCache cache(settings.objectives, settings.candidates);
        Segmentation s = uncut_scan;
        const std::vector<Ranked> ranked = rank(s, 0, settings, cache, Context{});
        planes = ranked.size();
        apply(s, cut_by(s, 0, ranked, 0, settings), measured.fragment_volume_mm3);
        return s;
    });
    figures.record(measured.name, "first decision of carve; the thesis'", time_text(carve) + "; " + time_text(thesis));
    figures.record(measured.name, "planes of which all terms were evaluated", std::to_string(planes));
    figures.at_most(measured.name, "first decision of carve / the thesis'", carve / thesis, 2);
}

void measure_runs(const Measured& measured, Figures& figures) {
    constexpr std::size_t pieces = 20;
    SearchSettings bunny = *preset("bunny");
    bunny.objectives.fragment_volume_mm3 = measured.fragment_volume_mm3;
    SearchSettings carve = carve_settings(measured);
    for (SearchSettings* s : {&bunny, &carve}) s->stop.min_cuts = static_cast<int>(pieces);
    const double thesis = run_s(measured, bunny, pieces);
    const double reach = run_s(measured, carve, pieces);
    figures.record(measured.name, "run to 20 pieces, carve; bunny", time_text(reach) + "; " + time_text(thesis));
    figures.at_most(measured.name, "run to 20 pieces, carve / bunny", reach / thesis, 2);
}

void measure(const Choice& choice, Figures& figures) {
    const ThreadLimit one(1);
    const auto head = choice.is_small ? nullptr : scan(choice.data / "ct_head_1912k.ply", 1);
    const Measured measured =
        head ? biggest("ct_head", *head) : one_shell("skull", Specimen::skull, choice.is_small ? 20'000 : 1'900'000);
    if (choice.wants("decision")) measure_decision(measured, figures);
    if (choice.wants("run")) measure_runs(measured, figures);
    const std::vector<Vec3> directions = tool_directions(oriented_box(measured.piece.mesh->points).axis);
    if (choice.wants("rays")) measure_rays(measured, directions, figures);
    const std::array<Piece, 1> pieces{measured.piece};
    const SampledScan sampled = sampled_scan(pieces, directions);
    if (choice.wants("sweep")) measure_sweep(measured, sampled, figures);
    if (choice.wants("areas")) measure_areas(measured, sampled, figures);
}

}  // namespace

int main(int argc, char** argv) {
    return print_figures(argc, argv, usage, measure);
}
