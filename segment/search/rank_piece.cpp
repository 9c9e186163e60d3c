// The cost is that of the evaluations that are not in the cache.

#include "segment/search/rank_piece.h"

#include <algorithm>
#include <cassert>
#include <limits>

#include "segment/score/cut_reach.h"
#include "segment/search/further_candidates.h"
#include "segment/search/late_rank.h"
#include "segment/search/reach_rank.h"

namespace qchopper {
namespace {

// So many of the best planes per place in the beam, because near duplicates among them are culled.
constexpr std::size_t children_per_place = 8;

void add(PieceEvaluations& all, const PieceEvaluations& more) {
    all.candidates.insert(all.candidates.end(), more.candidates.begin(), more.candidates.end());
    all.evaluations.insert(all.evaluations.end(), more.evaluations.begin(), more.evaluations.end());
}

}  // namespace

std::vector<Ranked> rank(const Segmentation& segmentation, std::size_t piece, const SearchSettings& settings,
                         EvaluationCache& cache, const Context& context, std::size_t best,
                         const BlocksNeeded& too_large_for) {
    assert(piece < segmentation.pieces.size());
    if (is_ranked_by_reach(segmentation.pieces[piece], settings)) {
        return rank_by_reach(segmentation, piece, settings, cache, context, std::max(best, least_best_planes),
                             too_large_for);
    }
    const Piece* target = &segmentation.pieces[piece];
    const Objectives& objectives = settings.objectives;
    const std::vector<PieceShare> others = shares_of_others(segmentation, piece, objectives, cache);
    const ScanShare scan = scan_share(segmentation, piece, objectives, cache);
    const auto ranking = [&](const PieceEvaluations& planes) { return rank(planes, others, objectives, scan); };
    PieceEvaluations further{further_candidates(segmentation, piece, settings.candidates), {}};
    if (!further.candidates.empty())
        further.evaluations = cache.further_evaluations(*target, further.candidates, context);
    std::vector<Ranked> ranked;
    if (is_ranked_late(settings)) {
        const std::size_t wanted =
            std::max({best, settings.runners_up + 1, most_own_boxes, children_per_place * settings.beam});
        ranked = rank_late(segmentation, piece, settings, cache, context, wanted, further);
    } else {
        cache.evaluate(std::span(&target, 1), context);
        if (further.candidates.empty()) {
            ranked = ranking(cache.evaluations(*target));
        } else {
            PieceEvaluations all = cache.evaluations(*target);
            add(all, further);
            ranked = ranking(all);
        }
    }
    const auto finish = [&] {
        return with_own_boxes(std::move(ranked), segmentation, piece, objectives, cache, context);
    };
    if (settings.candidates.normals != CandidateNormals::sphere || ranked.empty()) return finish();
    if (ranked.front().normal_index < 0) return finish();
    const std::vector<Candidate> around = offsets_around(*target, ranked.front(), settings.candidates);
    const std::vector<Ranked> finer = ranking({around, cache.further_evaluations(*target, around, context)});
    const auto key = [&](const Ranked& r) { return std::pair(is_forbidden(r.terms, objectives), r.terms.total + tie); };
    if (!finer.empty() &&
        key(finer.front()) < std::pair(is_forbidden(ranked.front().terms, objectives), ranked.front().terms.total)) {
        ranked.insert(ranked.begin(), finer.front());
    }
    return finish();
}

std::vector<Ranked> rank_whole_normals(const Segmentation& segmentation, std::size_t piece,
                                       const SearchSettings& settings, EvaluationCache& cache, const Context& context,
                                       int other, const BlocksNeeded& too_large_for) {
    constexpr std::size_t normals = 3;
    if (is_ranked_by_reach(segmentation.pieces[piece], settings)) {
        return rank_whole_normals_by_reach(segmentation, piece, settings, cache, context, normals, other,
                                           too_large_for);
    }
    return rank(segmentation, piece, settings, cache, context, std::numeric_limits<std::size_t>::max());
}

std::optional<Ranked> rank_plane(const Segmentation& segmentation, std::size_t piece, const Candidate& plane,
                                 const SearchSettings& settings, EvaluationCache& cache, const Context& context) {
    const Piece& target = segmentation.pieces[piece];
    PieceEvaluations alone{{plane}, {cache.evaluation_of(target, plane, context)}};
    if (alone.evaluations.front() && is_ranked_by_reach(target, settings)) {
        alone.evaluations.front()->reach = cut_reach(target, plane.plane, settings.objectives.tilt_deg);
    }
    const std::vector<PieceShare> others = shares_of_others(segmentation, piece, settings.objectives, cache);
    const std::vector<Ranked> ranked =
        rank(alone, others, settings.objectives, scan_share(segmentation, piece, settings.objectives, cache));
    return ranked.empty() ? std::nullopt : std::optional(ranked.front());
}

}  // namespace qchopper
