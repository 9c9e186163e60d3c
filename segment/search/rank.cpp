// O(c log c) for c candidates that have terms; O(c^2) to drop near duplicates and neighbours.

#include "segment/search/rank.h"

#include <algorithm>
#include <cassert>
#include <cstdlib>
#include <utility>

#include "segment/cut/nudge.h"
#include "segment/mesh/measure.h"

namespace qchopper {
namespace {

// Best first. Totals within a tie of the best of a group form the group, which is sorted by the candidates' indices.
void sort_best_first(std::vector<Ranked>& ranked) {
    const auto by_order = [](const Ranked& a, const Ranked& b) {
        return std::pair(a.normal_index, a.offset_index) < std::pair(b.normal_index, b.offset_index);
    };
    std::stable_sort(ranked.begin(), ranked.end(),
                     [](const Ranked& a, const Ranked& b) { return a.terms.total < b.terms.total; });
    for (auto group = ranked.begin(); group != ranked.end();) {
        auto end = group;
        while (end != ranked.end() && end->terms.total <= group->terms.total + tie) ++end;
        std::sort(group, end, by_order);
        group = end;
    }
}

}  // namespace

std::vector<PieceShare> shares_of_others(const Segmentation& segmentation, std::size_t piece,
                                         const Objectives& objectives, EvaluationCache& cache) {
    assert(piece < segmentation.pieces.size());
    std::vector<PieceShare> shares;
    for (std::size_t p = 0; p < segmentation.pieces.size(); ++p) {
        if (p == piece) continue;
        const Piece& other = segmentation.pieces[p];
        shares.push_back(share(cache.solid_evaluation(other), objectives));
        if (objectives.weights.unreachable > 0) {
            shares.back().unreachable_mm2 = cache.unreachable_mm2(other, objectives.tilt_deg);
        }
        if (objectives.needs_sizes()) shares.back().boxes = print_boxes(cache.box(other).size(), objectives);
    }
    return shares;
}

ScanShare scan_share(const Segmentation& segmentation, std::size_t piece, const Objectives& objectives,
                     EvaluationCache& cache) {
    ScanShare share;
    const UncutScan& scan = segmentation.scan;
    share.diagonal_mm = scan.diagonal_mm;
    if (objectives.needs_sizes()) {
        share.boxes = 0;
        for (const Vec3& size : scan.solid_sizes_mm) share.boxes += print_boxes(size, objectives);
        assert(share.boxes > 0);
    }
    if (!objectives.needs_seam()) return share;
    assert(scan.diagonal_mm > 0);
    for (const Cut& cut : segmentation.cuts) share.seam_mm += cut.chosen.seam_mm;
    for (std::size_t p = 0; p < segmentation.pieces.size() && objectives.print_volume; ++p) {
        const Piece& other = segmentation.pieces[p];
        const std::int32_t maker = made_by(other);
        if (p == piece || maker == 0) continue;
        const double further = print_boxes(cache.box(other).size(), objectives) - 1;
        share.seam_mm += further * segmentation.cuts[static_cast<std::size_t>(maker) - 1].chosen.seam_mm;
    }
    return share;
}

std::optional<Ranked> rank(const Candidate& candidate, const std::optional<CutEvaluation>& evaluation,
                           std::span<const PieceShare> others, const Objectives& objectives, const ScanShare& scan) {
    const std::optional<Terms> t = evaluation ? terms(*evaluation, others, objectives, scan) : std::nullopt;
    if (!t) return std::nullopt;
    return Ranked{candidate.plane,     candidate.wanted_offset,    candidate.normal_index, candidate.offset_index, *t,
                  evaluation->seam_mm, evaluation->coarse_sections};
}

std::vector<Ranked> rank(const PieceEvaluations& evaluations, std::span<const PieceShare> others,
                         const Objectives& objectives, const ScanShare& scan) {
    assert(evaluations.candidates.size() == evaluations.evaluations.size());
    std::vector<Ranked> ranked;
    for (std::size_t i = 0; i < evaluations.candidates.size(); ++i) {
        const auto one = rank(evaluations.candidates[i], evaluations.evaluations[i], others, objectives, scan);
        if (one) ranked.push_back(*one);
    }
    sort_ranking(ranked, objectives);
    return ranked;
}

std::vector<Ranked> rank(std::span<const PlanesOfNormal> planes, std::span<const PieceShare> others,
                         const Objectives& objectives, const ScanShare& scan) {
    std::vector<Ranked> ranked;
    for (const PlanesOfNormal& of_normal : planes) {
        for (const EvaluatedPlane& plane : of_normal) {
            if (plane.stage != TermStage::whole) continue;
            const auto one = rank(plane.candidate, plane.evaluation, others, objectives, scan);
            if (one) ranked.push_back(*one);
        }
    }
    sort_ranking(ranked, objectives);
    return ranked;
}

void sort_ranking(std::vector<Ranked>& ranked, const Objectives& objectives) {
    sort_best_first(ranked);
    if (objectives.forbidden.empty()) return;
    std::stable_partition(ranked.begin(), ranked.end(),
                          [&](const Ranked& r) { return !is_forbidden(r.terms, objectives); });
}

std::vector<std::size_t> without_near_duplicates(const std::vector<Ranked>& ranked, int offsets_per_normal,
                                                 double near) {
    // Offsets are evenly spaced: (count + 1) steps are the piece's extent.
    const double near_steps = near * (offsets_per_normal + 1);
    std::vector<std::size_t> kept;
    for (std::size_t i = 0; i < ranked.size(); ++i) {
        const bool is_near = std::any_of(kept.begin(), kept.end(), [&](std::size_t k) {
            return ranked[k].normal_index == ranked[i].normal_index &&
                   std::abs(ranked[k].offset_index - ranked[i].offset_index) < near_steps;
        });
        if (!is_near) kept.push_back(i);
    }
    return kept;
}

std::vector<std::size_t> without_neighbours(const std::vector<Ranked>& ranked, const Piece& piece,
                                            const CandidateOptions& options, std::size_t most) {
    constexpr double slack = 1.001;  // planes are nudged by less
    const Box box = bounds(*piece.mesh);
    const Vec3 centre = box.centre();
    const double radius = norm(box.size()) / 2;
    const double longest_step = offset_step({0, 2 * radius}, options);
    std::vector<std::size_t> kept;
    std::vector<std::optional<double>> step;  // per plane that is kept, once it is needed
    const auto is_neighbour = [&](const Plane& plane, std::size_t k) {
        const Plane& better = ranked[kept[k]].plane;
        const double sign = dot(plane.normal, better.normal) < 0 ? -1 : 1;
        const double turned = norm(plane.normal - sign * better.normal) * radius;
        const double moved = std::abs(plane.offset - height(plane.normal, centre) -
                                      sign * (better.offset - height(better.normal, centre)));
        if (moved + turned > slack * longest_step) return false;
        if (!step[k]) step[k] = offset_step(extent(*piece.mesh, better.normal), options);
        return moved + turned <= slack * *step[k];
    };
    for (std::size_t i = 0; i < ranked.size() && kept.size() < most; ++i) {
        bool is_near = false;
        for (std::size_t k = 0; k < kept.size() && !is_near; ++k) is_near = is_neighbour(ranked[i].plane, k);
        if (is_near) continue;
        kept.push_back(i);
        step.emplace_back();
    }
    return kept;
}

Cut cut_by(const Segmentation& segmentation, std::size_t piece, const std::vector<Ranked>& ranked, std::size_t k,
           const SearchSettings& settings) {
    assert(piece < segmentation.pieces.size() && k < ranked.size());
    Cut cut;
    cut.number = static_cast<std::int32_t>(segmentation.cuts.size()) + 1;
    cut.piece = segmentation.pieces[piece].name;
    cut.candidates = ranked.size();
    cut.chosen = ranked[k];
    const std::size_t most = settings.runners_up;
    for (const std::size_t i :
         without_neighbours(ranked, segmentation.pieces[piece], settings.candidates, most > 0 ? most + 1 : 0)) {
        if (i != k && cut.runners_up.size() < most) cut.runners_up.push_back(ranked[i]);
    }
    return cut;
}

}  // namespace qchopper
