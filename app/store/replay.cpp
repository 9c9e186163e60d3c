// Planes are exact and applied as they stand, never nudged, which gives the same bits. O(cuts x triangles of the pieces
// that they cut).

#include "app/store/replay.h"

#include <algorithm>
#include <cassert>
#include <span>

#include "app/store/caches/distance_store.h"
#include "app/store/caches/seam_cost_store.h"
#include "base/error.h"
#include "base/timings.h"
#include "segment/access/sampled_piece.h"
#include "segment/mesh/measure.h"

namespace qchopper {
namespace {

SolidRecord record_of(const Piece& piece) {
    return {piece.name, made_by(piece), piece.mesh->triangles.size(), volume_mm3(*piece.mesh),
            bounds(*piece.mesh).centre()};
}

// Takes out what was discarded after so many cuts as the segmentation has.
void discard_now(Segmentation& segmentation, const std::vector<Discard>& discards) {
    for (const Discard& d : discards) {
        if (d.after != segmentation.cuts.size() || discard(segmentation, d.piece)) continue;
        throw InputError(InputFault::config,
                         "piece " + d.piece + " of the project cannot be discarded: it is not there",
                         "prepare the scan again");
    }
}

// `before` is called with the segmentation before each cut.
Segmentation replay_cuts(const Project& project, const TriangleMesh& scan, std::size_t cuts, const Context& context,
                         const std::filesystem::path& cache,
                         const std::function<void(const Segmentation&, const Cut&)>& before) {
    context.progress("cuts made on the scan", 0, cuts);
    const double fragment_volume = project.settings.objectives.fragment_volume_mm3;
    Segmentation segmentation = uncut(scan, fragment_volume);
    if (project.settings.takes_samples()) {
        const StageTimer stage(context, "rays cast");
        context.progress("samples asked", 0, default_surface_samples);
        sample_uncut(segmentation.pieces, cache.empty() ? DistanceStore{} : distance_store(cache));
    }
    if (project.settings.measures_scan()) segmentation.scan = measure_scan(segmentation);
    if (project.settings.objectives.needs_seam()) {
        const StageTimer stage(context, "rays cast");
        find_kept_seam_costs(cache, segmentation.pieces, context);
    }
    discard_now(segmentation, project.discards);
    for (const Cut& cut : std::span(project.cuts).first(cuts)) {
        if (before) before(segmentation, cut);
        if (!apply(segmentation, cut, fragment_volume)) {
            throw InputError(InputFault::config,
                             "cut " + std::to_string(cut.number) + " of the project does not part piece " + cut.piece,
                             "prepare the scan again");
        }
        discard_now(segmentation, project.discards);
        context.check_cancelled();
        context.progress("cuts made on the scan", segmentation.cuts.size(), cuts);
    }
    return segmentation;
}

}  // namespace

void record(Project& project, const Segmentation& segmentation) {
    follow(project.history, segmentation.cuts);
    Discards newly;
    for (std::size_t i = committed_discards(project.history).size(); i < segmentation.discarded.size(); ++i) {
        assert(segmentation.discarded[i].after == segmentation.cuts.size());
        newly.push_back({segmentation.discarded[i].piece.name, segmentation.cuts.size()});
    }
    if (!newly.empty()) decide(project.history, std::move(newly));
    project.cuts = segmentation.cuts;
    project.discards = committed_discards(project.history);
    project.pieces.clear();
    for (const Piece& piece : segmentation.pieces) project.pieces.push_back(record_of(piece));
    project.discarded.clear();
    for (const Discarded& discarded : segmentation.discarded) project.discarded.push_back(record_of(discarded.piece));
    project.fragment_list.clear();
    for (const Fragment& fragment : segmentation.fragments) {
        project.fragment_list.push_back(
            {"", fragment.cut, fragment.mesh->triangles.size(), fragment.volume_mm3, fragment.centre});
    }
    project.warnings = project.scan.warnings;
    for (std::string& text : texts(segmentation.warnings)) project.warnings.push_back(std::move(text));
}

Segmentation replay(const Project& project, const TriangleMesh& scan, const Context& context,
                    const std::filesystem::path& cache) {
    return replay(project, scan, project.cuts.size(), context, cache);
}

Segmentation replay(const Project& project, const TriangleMesh& scan, std::size_t cuts, const Context& context,
                    const std::filesystem::path& cache) {
    return replay_cuts(project, scan, cuts, context, cache, {});
}

std::map<std::int32_t, Piece> divided_pieces(const Project& project, const TriangleMesh& scan,
                                             const std::vector<std::int32_t>& numbers, const Context& context,
                                             const std::filesystem::path& cache) {
    std::map<std::int32_t, Piece> divided;
    if (numbers.empty()) return divided;
    const auto last = static_cast<std::size_t>(*std::max_element(numbers.begin(), numbers.end()));
    replay_cuts(project, scan, last, context, cache, [&](const Segmentation& before, const Cut& cut) {
        if (std::find(numbers.begin(), numbers.end(), cut.number) == numbers.end()) return;
        if (const auto piece = piece_named(before, cut.piece)) divided[cut.number] = before.pieces[*piece];
    });
    return divided;
}

std::optional<std::size_t> piece_named(const Segmentation& segmentation, const std::string& name) {
    for (std::size_t p = 0; p < segmentation.pieces.size(); ++p) {
        if (segmentation.pieces[p].name == name) return p;
    }
    return std::nullopt;
}

std::size_t index_of_piece(const Segmentation& segmentation, const std::string& name) {
    if (const auto named = piece_named(segmentation, name)) return *named;
    std::string names;
    for (const Piece& p : segmentation.pieces) names += (names.empty() ? "" : ", ") + p.name;
    throw InputError(InputFault::use, "there is no piece " + name + " now", "the pieces are " + names);
}

void set_stress(std::span<Piece> pieces, const std::shared_ptr<const StressedModel>& stress) {
    for (Piece& piece : pieces) piece.stress = stress;
}

void check_load(const std::optional<StructureOptions>& load, const Weights& weights) {
    if (weights.structure <= 0 || load) return;
    throw InputError(
        InputFault::use, "the objective structure needs to know how the scan stands and is loaded",
        Sentence::with_key("new_with_structure", {}, "leave its weight out, or make a new project with a load"));
}

void check_symmetry(const std::optional<SymmetryPlane>& plane, const Weights& weights) {
    if (weights.symmetry <= 0 || plane) return;
    throw InputError(InputFault::use, "the objective symmetry needs the symmetry plane of the scan",
                     Sentence::with_key("new_with_symmetry", {},
                                        "leave its weight out, or make a new project with a symmetry plane"));
}

BeamProgress beam_progress(const Project& project, const Segmentation& committed,
                           const std::function<const TriangleMesh&()>& scan, const std::filesystem::path& cache) {
    BeamProgress progress;
    if (!project.beam || !project.settings.has_state()) return progress;
    progress.state = *project.beam;
    const bool has_root = progress.state.from == committed.cuts.size();
    progress.root = has_root ? committed : replay(project, scan(), progress.state.from, {}, cache);
    return progress;
}

}  // namespace qchopper
