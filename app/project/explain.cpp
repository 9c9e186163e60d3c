#include "app/project/explain.h"

#include <algorithm>

#include "app/project/replay.h"
#include "base/error.h"
#include "segment/score/evaluate.h"

namespace qchopper {
namespace {

// The settings as they stood when a cut that stands was decided: weights may have changed since.
SearchSettings settings_at(const Project& project, const Cut& cut) {
    SearchSettings settings = project.settings;
    Weights weights = project.history.weights_at_start;
    for (std::size_t i = 0; i < project.history.standing; ++i) {
        const Decision& decision = project.history.decisions[i];
        if (const auto* change = std::get_if<WeightsChange>(&decision)) weights = change->weights;
        // A cut before a reset may be the same; the last one is meant.
        if (const auto* made = std::get_if<Cut>(&decision); made != nullptr && *made == cut) {
            settings.objectives.weights = weights;
        }
    }
    return settings;
}

// The piece as it was before the cut, among the others.
struct Before {
    Segmentation segmentation;
    std::size_t piece = 0;
};

Before before(const Project& project, const Cut& cut, const TriangleMesh& scan) {
    const auto at = std::find(project.cuts.begin(), project.cuts.end(), cut);
    Before b{replay(project, scan, static_cast<std::size_t>(at - project.cuts.begin())), 0};
    const std::vector<Piece>& pieces = b.segmentation.pieces;
    while (b.piece < pieces.size() && pieces[b.piece].name != cut.piece) ++b.piece;
    if (b.piece == pieces.size()) {
        throw InputError(InputFault::config,
                         "before cut " + std::to_string(cut.number) + " there is no piece " + cut.piece,
                         "restore project.json, or prepare the scan again");
    }
    return b;
}

// The candidates along a normal of the operator's own.
std::vector<Ranked> beside(const Before& b, const Plane& own, const SearchSettings& settings, EvaluationCache& book,
                           const Context& context) {
    const Piece& piece = b.segmentation.pieces[b.piece];
    PieceEvaluations along{candidates_along(piece, own.normal, -1, settings.candidates.offsets_per_normal), {}};
    along.evaluations = evaluate_all(piece, along.candidates, settings.objectives, context);
    const auto others = shares_of_others(b.segmentation, b.piece, settings.objectives, book);
    std::vector<Ranked> planes = rank(along, others, settings.objectives);
    std::sort(planes.begin(), planes.end(), [](const Ranked& x, const Ranked& y) { return x.offset < y.offset; });
    return planes;
}

}  // namespace

const Cut& cut_to_explain(const Project& project, std::optional<int> number) {
    if (project.cuts.empty()) {
        throw InputError(InputFault::use, "the project has no cuts yet", "make one, then ask again");
    }
    if (!number) return project.cuts.back();
    for (const Cut& cut : project.cuts) {
        if (cut.number == *number) return cut;
    }
    throw InputError(InputFault::use, "the project has no cut " + std::to_string(*number),
                     "its cuts are 1 to " + std::to_string(project.cuts.size()));
}

Explanation explain(OpenProject& project, const Cut& cut, const Context& context) {
    const SearchSettings settings = settings_at(project.project(), cut);
    const Before b = before(project.project(), cut, project.scan());
    EvaluationCache& book = project.book();
    Explanation e;
    e.cut = cut;
    e.objectives = settings.objectives;
    e.chosen = cut.chosen;
    e.ranked = rank(b.segmentation, b.piece, settings, book, context);
    for (std::size_t i = 0; i < e.ranked.size() && !e.place; ++i) {
        if (e.ranked[i].plane == cut.chosen.plane) e.place = i;
    }
    if (e.place) {
        e.chosen = e.ranked[*e.place];
        return e;
    }
    const Candidate own{cut.chosen.plane, cut.chosen.wanted_offset, cut.chosen.normal, cut.chosen.offset};
    const std::optional<Ranked> evaluated = rank_plane(b.segmentation, b.piece, own, settings, book, context);
    if (evaluated) e.chosen = *evaluated;
    e.beside = beside(b, own.plane, settings, book, context);
    return e;
}

}  // namespace qchopper
