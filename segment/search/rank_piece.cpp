// The cost is that of the evaluations that are not in the cache.

#include "segment/search/rank_piece.h"

#include <algorithm>
#include <cassert>
#include <limits>

#include "segment/access/access_sweep.h"
#include "segment/access/piece_access.h"
#include "segment/search/access_rank.h"
#include "segment/search/further_candidates.h"
#include "segment/search/late_rank.h"

namespace qchopper {
namespace {

// So many of the best planes per place in the beam, because near duplicates among them are culled.
constexpr std::size_t children_per_place = 8;

}  // namespace

std::vector<Ranked> rank(const Segmentation& segmentation, std::size_t piece, const SearchSettings& settings,
                         EvaluationCache& cache, const Context& context, std::size_t best,
                         const BlocksNeeded& too_large_for) {
    assert(piece < segmentation.pieces.size());
    if (is_ranked_by_access(segmentation.pieces[piece], settings)) {
        return rank_by_access(segmentation, piece, settings, cache, context, std::max(best, min_best_planes),
                              too_large_for);
    }
    const Objectives& objectives = settings.objectives;
    const CandidateOptions& options = settings.candidates;
    const Piece& target = segmentation.pieces[piece];
    const std::vector<PieceShare> others = shares_of_others(segmentation, piece, objectives, cache);
    const ScanShare scan = scan_share(segmentation, piece, objectives, cache);
    const auto ranked_further = [&](std::vector<Candidate> planes) {
        auto evaluations = cache.further_evaluations(target, planes, context);
        return rank({std::move(planes), std::move(evaluations)}, others, objectives, scan);
    };
    const auto with_boxes = [&](std::vector<Ranked> ranked) {
        return with_own_boxes(std::move(ranked), segmentation, piece, objectives, cache, context);
    };
    std::vector<Ranked> ranked;
    if (is_ranked_late(settings)) {
        const std::size_t wanted =
            std::max({best, settings.runners_up + 1, max_own_boxes, children_per_place * settings.beam});
        ranked = rank_late(segmentation, piece, settings, cache, context, wanted);
    } else {
        const Piece* one = &target;
        cache.evaluate(std::span(&one, 1), context);
        ranked = rank(cache.evaluations(target), others, objectives, scan);
    }
    const std::vector<Ranked> further = ranked_further(further_candidates(segmentation, piece, options));
    ranked.insert(ranked.end(), further.begin(), further.end());
    if (!further.empty()) sort_ranking(ranked, objectives);
    ranked = with_boxes(std::move(ranked));
    if (options.normals != CandidateNormals::sphere || ranked.empty() || ranked.front().normal_index < 0) return ranked;
    const std::vector<Ranked> finer = with_boxes(ranked_further(offsets_around(target, ranked.front(), options)));
    const auto is_out = [&](const Ranked& r) { return is_forbidden(r.terms, objectives); };
    if (!finer.empty() && is_out(finer.front()) <= is_out(ranked.front()) &&
        finer.front().terms.total + tie < ranked.front().terms.total) {
        ranked.insert(ranked.begin(), finer.front());
    }
    return ranked;
}

std::vector<Ranked> rank_whole_normals(const Segmentation& segmentation, std::size_t piece,
                                       const SearchSettings& settings, EvaluationCache& cache, const Context& context,
                                       int other, const BlocksNeeded& too_large_for) {
    constexpr std::size_t normals = 3;
    if (is_ranked_by_access(segmentation.pieces[piece], settings)) {
        return rank_whole_normals_by_access(segmentation, piece, settings, cache, context, normals, other,
                                            too_large_for);
    }
    return rank(segmentation, piece, settings, cache, context, std::numeric_limits<std::size_t>::max());
}

std::optional<Ranked> rank_plane(const Segmentation& segmentation, std::size_t piece, const Candidate& plane,
                                 const SearchSettings& settings, EvaluationCache& cache, const Context& context) {
    const Piece& target = segmentation.pieces[piece];
    const Objectives& objectives = settings.objectives;
    std::optional<CutEvaluation> evaluation = cache.evaluation_of(target, plane, context);
    if (evaluation && is_ranked_by_access(target, settings)) {
        evaluation->access = cut_access(target, plane.plane, objectives.tilt_deg);
        if (evaluation->solids.size() > 2) {
            evaluation->access->unreachable_mm2 =
                unreachable_when_cut_mm2(target, plane.plane, objectives.fragment_volume_mm3, objectives.tilt_deg)
                    .value_or(evaluation->access->unreachable_mm2);
        }
    }
    return rank(plane, evaluation, shares_of_others(segmentation, piece, objectives, cache), objectives,
                scan_share(segmentation, piece, objectives, cache));
}

}  // namespace qchopper
