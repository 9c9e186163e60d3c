// Cuts the scan again up to the cut, then ranks (segment/search/rank_piece.h): O(cuts before) times the cost of a cut,
// and an evaluation of the piece if the cache has none.

#include "app/engine/explain.h"

#include <algorithm>
#include <limits>

#include "app/store/replay.h"
#include "base/error.h"
#include "base/timings.h"
#include "segment/access/access_sweep.h"
#include "segment/access/sampled_piece.h"
#include "segment/search/access_rank.h"
#include "segment/search/candidates/evaluate.h"
#include "segment/search/rank.h"

namespace qchopper {
namespace {

// The settings with the weights that were in force when the cut was decided.
SearchSettings settings_at(const Project& project, const Cut& cut) {
    History history = project.history;
    // An equal cut may have been taken back by a reset; the last one counts.
    const auto decides = [&](const Decision& decision) {
        const auto* other = std::get_if<Replacement>(&decision);
        return decision == Decision{cut} || (other != nullptr && other->cut == cut);
    };
    while (history.committed > 0 && !decides(history.decisions[history.committed - 1])) --history.committed;
    SearchSettings settings = project.settings;
    settings.objectives.weights = committed_weights(history);
    return settings;
}

// The piece as it was before the cut, among the others.
struct Before {
    Segmentation segmentation;
    std::size_t piece = 0;
};

Before before(const Project& project, const Cut& cut, const TriangleMesh& scan) {
    const auto at = std::find(project.cuts.begin(), project.cuts.end(), cut);
    Segmentation segmentation = replay(project, scan, static_cast<std::size_t>(at - project.cuts.begin()));
    const std::optional<std::size_t> piece = piece_named(segmentation, cut.piece);
    if (!piece) {
        throw InputError(InputFault::config,
                         "before cut " + std::to_string(cut.number) + " there is no piece " + cut.piece,
                         "restore project.json, or prepare the scan again");
    }
    return {std::move(segmentation), *piece};
}

// The planes along a normal that is not among the candidates'.
std::vector<Ranked> along_own_normal(const Before& b, const Plane& own, const SearchSettings& settings,
                                     EvaluationCache& cache, const Context& context) {
    const Piece& piece = b.segmentation.pieces[b.piece];
    PieceEvaluations along{candidates_along(piece, own.normal, own_index, settings.candidates), {}};
    along.evaluations = evaluate_all(piece, along.candidates, settings.objectives, context);
    if (is_ranked_by_access(piece, settings)) {
        std::vector<double> offsets;
        for (const Candidate& c : along.candidates) offsets.push_back(c.plane.offset);
        const std::vector<CutAccess> access = cut_access(piece, own.normal, offsets, settings.objectives.tilt_deg);
        for (std::size_t i = 0; i < access.size(); ++i) {
            if (along.evaluations[i]) along.evaluations[i]->access = access[i];
        }
    }
    const auto others = shares_of_others(b.segmentation, b.piece, settings.objectives, cache);
    std::vector<Ranked> planes = rank(along, others, settings.objectives);
    std::sort(planes.begin(), planes.end(),
              [](const Ranked& x, const Ranked& y) { return x.offset_index < y.offset_index; });
    return planes;
}

// Precondition: the piece is ranked with these settings, so that the cache has its sweep.
std::optional<OpenedSurface> opened_surface(const Before& b, const Ranked& chosen, const SearchSettings& settings,
                                            EvaluationCache& cache) {
    const Piece& piece = b.segmentation.pieces[b.piece];
    if (!is_ranked_by_access(piece, settings)) return std::nullopt;
    OpenedSurface opened;
    opened.piece_mm2 = piece.samples->judged().area_mm2();
    opened.scan_mm2 = scan_area_mm2(piece);
    opened.before_mm2 = cache.unreachable_mm2(piece, settings.objectives.tilt_deg);
    opened.after_mm2 = chosen.terms.unreachable * opened.scan_mm2;
    for (const PieceShare& other : shares_of_others(b.segmentation, b.piece, settings.objectives, cache)) {
        opened.after_mm2 -= other.unreachable_mm2;
    }
    opened.best_other_after_mm2 = std::numeric_limits<double>::infinity();
    const AccessEvaluations& swept = cache.access(piece);
    for (std::size_t n = 0; n < swept.normals.size(); ++n) {
        if (swept.unreachable_mm2[n].empty() || static_cast<int>(n) == chosen.normal_index) continue;
        ++opened.other_normals;
        opened.other_planes += swept.unreachable_mm2[n].size();
        const double least = *std::min_element(swept.unreachable_mm2[n].begin(), swept.unreachable_mm2[n].end());
        opened.best_other_after_mm2 = std::min(opened.best_other_after_mm2, least);
    }
    return opened;
}

}  // namespace

const Ranked* Explanation::best_other() const {
    const Ranked* best = nullptr;
    for (std::size_t i = 0; i < ranked.size(); ++i) {
        if (place != i && (best == nullptr || ranked[i].terms.total < best->terms.total)) best = &ranked[i];
    }
    return best;
}

std::size_t Explanation::cheaper() const {
    return static_cast<std::size_t>(std::count_if(
        ranked.begin(), ranked.end(), [&](const Ranked& r) { return r.terms.total + tie < chosen.terms.total; }));
}

const Cut& cut_to_explain(const Project& project, std::optional<int> number) {
    if (project.cuts.empty()) {
        throw InputError(InputFault::use, "the project has no cuts yet", "make one, then run explain again");
    }
    if (!number) return project.cuts.back();
    for (const Cut& cut : project.cuts) {
        if (cut.number == *number) return cut;
    }
    throw InputError(InputFault::use, "the project has no cut " + std::to_string(*number),
                     "its cuts are 1 to " + std::to_string(project.cuts.size()));
}

namespace {

Explanation explain_by(const Before& b, const Cut& cut, const SearchSettings& settings, EvaluationCache& cache,
                       const BlocksNeeded& too_large_for, const Context& context) {
    Explanation e;
    e.cut = cut;
    e.objectives = settings.objectives;
    e.chosen = cut.chosen;
    e.proposer = proposer_of(cut.chosen, settings.candidates);
    e.max_judged = max_judged_planes(settings);
    e.ranked =
        rank_whole_normals(b.segmentation, b.piece, settings, cache, context, cut.chosen.normal_index, too_large_for);
    e.listed = without_neighbours(e.ranked, b.segmentation.pieces[b.piece], settings.candidates, listed_planes);
    for (std::size_t i = 0; i < e.ranked.size() && !e.place; ++i) {
        if (e.ranked[i].plane == cut.chosen.plane) e.place = i;
    }
    if (e.place) e.chosen = e.ranked[*e.place];
    if (e.place && e.chosen.normal_index >= 0) return e;
    const Candidate own{cut.chosen.plane, cut.chosen.wanted_offset, cut.chosen.normal_index, cut.chosen.offset_index};
    if (!e.place) {
        const std::optional<Ranked> evaluated = rank_plane(b.segmentation, b.piece, own, settings, cache, context);
        if (evaluated) e.chosen = *evaluated;
    }
    e.along_own_normal = along_own_normal(b, own.plane, settings, cache, context);
    return e;
}

}  // namespace

Explanation explain(OpenProject& project, const Cut& cut, const Context& context) {
    const SearchSettings settings = settings_at(project.project(), cut);
    const TriangleMesh& scan = project.scan();
    StageTimer stage(context, "cuts replayed");
    Before b = before(project.project(), cut, scan);
    if (settings.objectives.needs_structure()) set_stress(b.segmentation.pieces, project.stress());
    stage.next("planes ranked");
    Explanation e = explain_by(b, cut, settings, project.cache(),
                               project.too_large_for(settings, b.segmentation.pieces[b.piece]), context);
    e.opened = opened_surface(b, e.chosen, settings, project.cache());
    return e;
}

}  // namespace qchopper
