// The values of a plane are the same bits whatever other planes of its normal are evaluated with it (sweep.h), so that
// they do not depend on what was asked before. Each visit of a normal costs a pass over the piece, so that all of its
// planes that may be among the best are evaluated at once.
//
// Seam, fragility, connector and symmetry take as long as everything else for 132 normals, so they wait for the bound
// of late_rank.h: of 26,268 planes of a head of 371,000 faces 686 were evaluated in full, 2.9 s in place of 8.0 s. At
// least 16 best are sought, because so many are ranked again with boxes of their own. Values that are forbidden
// (Objectives::forbidden) are known only with the slow terms: while fewer than the best are free of them, all planes
// are evaluated. Cost: a ranking lists no more planes than were asked for.

#include "segment/search/late_rank.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "base/parallel.h"
#include "base/timings.h"
#include "segment/cut/cut_piece.h"
#include "segment/mesh/measure.h"
#include "segment/objectives/sweep/prepared.h"
#include "segment/search/best_first.h"
#include "segment/search/candidates/evaluate.h"

namespace qchopper {
namespace {

constexpr std::size_t normals_at_once = 8;

std::vector<PlanesOfNormal> by_normal(std::span<const Candidate> candidates) {
    std::vector<PlanesOfNormal> planes;
    for (const auto& [first, last] : groups_of(candidates)) {
        PlanesOfNormal& of_normal = planes.emplace_back();
        for (std::size_t i = first; i < last; ++i) of_normal.push_back({.candidate = candidates[i]});
    }
    return planes;
}

class LateRanking {
 public:
    LateRanking(const Segmentation& segmentation, std::size_t piece, const SearchSettings& settings,
                EvaluationCache& cache, const Context& context, std::size_t best)
        : piece_(segmentation.pieces[piece]),
          objectives_(settings.objectives),
          context_(context),
          planes_(cache.late(piece_)),
          axes_(cache.box(piece_).axis),
          others_(shares_of_others(segmentation, piece, objectives_, cache)),
          scan_(scan_share(segmentation, piece, objectives_, cache)),
          best_(best) {
        if (planes_.empty()) planes_ = by_normal(cache.candidates(piece_));
        for (const PlanesOfNormal& of_normal : planes_) count_ += of_normal.size();
    }

    std::vector<Ranked> run() {
        const StageTimer stage(context_, "planes evaluated");
        if (count_evaluated(planes_, TermStage::solids) < count_) evaluate_solids();
        BestFirst search{planes_, best_, normals_at_once};
        search.bound = [&](std::size_t n, std::size_t k) { return bound(planes_[n][k]); };
        search.evaluate = [&](std::span<const std::size_t> normals, const Bounds& bounds, double most) {
            const PreparedPiece& piece = prepared();
            parallel_for(0, normals.size(),
                         [&](std::size_t i) { advance(piece, normals[i], bounds[normals[i]], most); });
            context_.progress("planes evaluated", count_evaluated(planes_, TermStage::whole), count_);
        };
        const double most = evaluate_what_can_win(search);
        std::vector<Ranked> ranked = rank(planes_, others_, objectives_, scan_);
        std::erase_if(ranked, [&](const Ranked& r) {
            return r.terms.total > most + tie || (most < never && is_forbidden(r.terms, objectives_));
        });
        return ranked;
    }

 private:
    const PreparedPiece& prepared() {
        if (!prepared_) prepared_ = prepare(piece_, objectives_, &axes_);
        return *prepared_;
    }

    void evaluate_solids() {
        const PreparedPiece& piece = prepared();
        parallel_for(0, planes_.size(), [&](std::size_t n) {
            context_.check_cancelled();
            std::vector<EvaluatedPlane*> planes;
            for (EvaluatedPlane& plane : planes_[n]) planes.push_back(&plane);
            evaluate(planes, TermStage::solids, piece, objectives_);
        });
    }

    double bound(const EvaluatedPlane& plane) const {
        const std::optional<Terms> t =
            plane.evaluation ? terms(*plane.evaluation, others_, objectives_, scan_) : std::nullopt;
        if (!t || (plane.stage == TermStage::whole && is_forbidden(*t, objectives_))) return never;
        return t->total;
    }

    // Evaluates the next terms of the planes of a normal that may be among the best: fragility first, because it takes
    // a tenth of the time of the others and tells more planes apart.
    void advance(const PreparedPiece& piece, std::size_t normal, std::span<const double> bounds, double most) {
        context_.check_cancelled();
        PlanesOfNormal& planes = planes_[normal];
        std::vector<std::size_t> open;
        TermStage from = TermStage::whole;
        for (std::size_t k = 0; k < planes.size(); ++k) {
            if (!can_win(planes[k], bounds[k], most)) continue;
            open.push_back(k);
            from = std::min(from, planes[k].stage);
        }
        std::erase_if(open, [&](std::size_t k) { return planes[k].stage != from; });
        const bool is_last = from == TermStage::fragility;
        if (is_last && most == never && objectives_.forbidden.empty()) keep_least(open, best_, bounds);
        std::vector<EvaluatedPlane*> chosen;
        chosen.reserve(open.size());
        for (const std::size_t k : open) chosen.push_back(&planes[k]);
        evaluate(chosen, is_last ? TermStage::whole : TermStage::fragility, piece, objectives_);
    }

    const Piece& piece_;
    const Objectives& objectives_;
    const Context& context_;
    std::vector<PlanesOfNormal>& planes_;
    std::array<Vec3, 3> axes_;
    std::vector<PieceShare> others_;
    ScanShare scan_;
    std::size_t best_;
    std::size_t count_ = 0;  // of the planes
    std::optional<PreparedPiece> prepared_;
};

// The evaluation of one plane from the pieces that it really makes, as far as own boxes change it.
std::optional<CutEvaluation> cut_really(const Piece& piece, const Plane& plane) {
    const std::optional<CutPieces> made = cut_piece(piece, plane, new_cut);
    if (!made) return std::nullopt;
    CutEvaluation evaluation;
    for (const Piece& part : made->pieces) {
        SolidEvaluation solid;
        solid.faces = part.mesh->triangles.size();
        solid.volume_mm3 = volume_mm3(*part.mesh);
        solid.size = oriented_box(part.mesh->points).size();
        evaluation.solids.push_back(solid);
    }
    evaluation.cap_area_mm2 = made->cap_area_mm2;
    return evaluation;
}

}  // namespace

bool is_ranked_late(const SearchSettings& settings) {
    return settings.objectives.needs_connector() || settings.objectives.needs_symmetry();
}

std::vector<Ranked> rank_late(const Segmentation& segmentation, std::size_t piece, const SearchSettings& settings,
                              EvaluationCache& cache, const Context& context, std::size_t best) {
    return LateRanking(segmentation, piece, settings, cache, context, best).run();
}

std::vector<Ranked> with_own_boxes(std::vector<Ranked> ranked, const Segmentation& segmentation, std::size_t piece,
                                   const Objectives& objectives, EvaluationCache& cache, const Context& context) {
    if (!objectives.needs_sizes()) return ranked;
    const Piece& target = segmentation.pieces[piece];
    const std::size_t count = std::min(ranked.size(), max_own_boxes);
    auto& known = cache.own_boxes(target);
    std::vector<const Ranked*> fresh;
    for (std::size_t i = 0; i < count; ++i) {
        if (!known.contains(ranked[i].plane)) fresh.push_back(&ranked[i]);
    }
    std::vector<std::optional<CutEvaluation>> made(fresh.size());
    parallel_for(0, fresh.size(), [&](std::size_t i) {
        context.check_cancelled();
        made[i] = cut_really(target, fresh[i]->plane);
    });
    for (std::size_t i = 0; i < fresh.size(); ++i) known.emplace(fresh[i]->plane, std::move(made[i]));
    const std::vector<PieceShare> others = shares_of_others(segmentation, piece, objectives, cache);
    const ScanShare scan = scan_share(segmentation, piece, objectives, cache);
    for (std::size_t i = 0; i < count; ++i) {
        const auto& evaluation = known.at(ranked[i].plane);
        if (!evaluation) continue;
        CutEvaluation with_seam = *evaluation;
        with_seam.seam_mm = ranked[i].seam_mm;
        const std::optional<Terms> own = terms(with_seam, others, objectives, scan);
        if (!own) continue;
        Terms& t = ranked[i].terms;
        t.parts = own->parts;
        t.utilization = own->utilization;
        t.seam = own->seam;
        t.total = weighted_sum(t, objectives.weights);
    }
    std::stable_sort(ranked.begin(), ranked.begin() + static_cast<std::ptrdiff_t>(count),
                     [&](const Ranked& a, const Ranked& b) {
                         return std::pair(is_forbidden(a.terms, objectives), a.terms.total) <
                                std::pair(is_forbidden(b.terms, objectives), b.terms.total);
                     });
    return ranked;
}

}  // namespace qchopper
