// The cost is that of the evaluations that are not in the cache.

#include "segment/search/rank_piece.h"

#include <algorithm>
#include <cassert>

#include "segment/score/cut_reach.h"
#include "segment/search/further_candidates.h"
#include "segment/search/reach_rank.h"

namespace qchopper {
namespace {

void add(PieceEvaluations& all, const std::vector<Candidate>& candidates,
         const std::vector<std::optional<CutEvaluation>>& evaluations) {
    all.candidates.insert(all.candidates.end(), candidates.begin(), candidates.end());
    all.evaluations.insert(all.evaluations.end(), evaluations.begin(), evaluations.end());
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
    cache.evaluate(std::span(&target, 1), context);
    const std::vector<PieceShare> others = shares_of_others(segmentation, piece, settings.objectives, cache);
    const auto ranking = [&](const PieceEvaluations& planes) { return rank(planes, others, settings.objectives); };
    const std::vector<Candidate> further = further_candidates(segmentation, piece, settings.candidates);
    std::vector<Ranked> ranked;
    if (further.empty()) {
        ranked = ranking(cache.evaluations(*target));
    } else {
        PieceEvaluations all = cache.evaluations(*target);
        add(all, further, cache.further_evaluations(*target, further, context));
        ranked = ranking(all);
    }
    if (settings.candidates.normals != CandidateNormals::sphere || ranked.empty()) return ranked;
    if (ranked.front().normal_index < 0) return ranked;
    const std::vector<Candidate> around = offsets_around(*target, ranked.front(), settings.candidates);
    const std::vector<Ranked> finer = ranking({around, cache.further_evaluations(*target, around, context)});
    if (!finer.empty() && finer.front().terms.total + tie < ranked.front().terms.total) {
        ranked.insert(ranked.begin(), finer.front());
    }
    return ranked;
}

std::vector<Ranked> rank_whole_normals(const Segmentation& segmentation, std::size_t piece,
                                       const SearchSettings& settings, EvaluationCache& cache, const Context& context,
                                       int other, const BlocksNeeded& too_large_for) {
    constexpr std::size_t normals = 3;
    if (is_ranked_by_reach(segmentation.pieces[piece], settings)) {
        return rank_whole_normals_by_reach(segmentation, piece, settings, cache, context, normals, other,
                                           too_large_for);
    }
    return rank(segmentation, piece, settings, cache, context);
}

std::optional<Ranked> rank_plane(const Segmentation& segmentation, std::size_t piece, const Candidate& plane,
                                 const SearchSettings& settings, EvaluationCache& cache, const Context& context) {
    const Piece& target = segmentation.pieces[piece];
    PieceEvaluations alone{{plane}, {cache.evaluation_of(target, plane, context)}};
    if (alone.evaluations.front() && is_ranked_by_reach(target, settings)) {
        alone.evaluations.front()->reach = cut_reach(target, plane.plane, settings.objectives.tilt_deg);
    }
    const std::vector<PieceShare> others = shares_of_others(segmentation, piece, settings.objectives, cache);
    const std::vector<Ranked> ranked = rank(alone, others, settings.objectives);
    return ranked.empty() ? std::nullopt : std::optional(ranked.front());
}

}  // namespace qchopper
