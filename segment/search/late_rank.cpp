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
#include <limits>
#include <tuple>

#include "base/parallel.h"
#include "base/timings.h"
#include "segment/cut/cut_piece.h"
#include "segment/mesh/measure.h"
#include "segment/objectives/sweep/sweep.h"

namespace qchopper {
namespace {

constexpr std::size_t normals_at_once = 8;  // fixed, so that what is evaluated does not depend on the threads
constexpr double infinite = std::numeric_limits<double>::infinity();

class LateRanking {
 public:
    LateRanking(const Segmentation& segmentation, std::size_t piece, const SearchSettings& settings,
                EvaluationCache& cache, const Context& context, std::size_t best)
        : piece_(segmentation.pieces[piece]),
          objectives_(settings.objectives),
          context_(context),
          late_(cache.late(piece_)),
          axes_(cache.box(piece_).axis),
          others_(shares_of_others(segmentation, piece, objectives_, cache)),
          scan_(scan_share(segmentation, piece, objectives_, cache)),
          best_(best) {
        if (late_.planes.candidates.empty()) {
            late_.planes.candidates = cache.candidates(piece_);
            late_.planes.evaluations.resize(late_.planes.candidates.size());
        }
        find_groups();
    }

    std::vector<Ranked> run() {
        const StageTimer stage(context_, "planes evaluated");
        sweep_all();
        parallel_for(0, groups_.size(), [&](std::size_t g) { update(groups_[g]); });
        double most = limit();
        for (std::vector<std::size_t> open = can_win(most); !open.empty(); open = can_win(most)) {
            open.resize(std::min(open.size(), normals_at_once));
            prepared();
            parallel_for(0, open.size(), [&](std::size_t i) { advance(groups_[open[i]], most); });
            most = limit();
            const auto done = std::count(late_.stage.begin(), late_.stage.end(), LateStage::whole);
            context_.progress("planes evaluated", static_cast<std::size_t>(done), late_.stage.size());
        }
        PieceEvaluations known;
        for (std::size_t i = 0; i < known_.size(); ++i) {
            if (late_.stage[i] != LateStage::whole || known_[i].total > most + tie) continue;
            known.candidates.push_back(late_.planes.candidates[i]);
            known.evaluations.push_back(late_.planes.evaluations[i]);
        }
        std::vector<Ranked> ranked = rank(known, others_, objectives_, scan_);
        if (most < infinite) std::erase_if(ranked, [&](const Ranked& r) { return is_forbidden(r.terms, objectives_); });
        return ranked;
    }

 private:
    struct Group {  // candidates of one normal
        std::size_t first;
        std::size_t last;
    };
    struct Known {  // of a candidate: its total as far as it is evaluated
        double total = infinite;
        bool is_out = false;
    };

    void find_groups() {
        const std::vector<Candidate>& all = late_.planes.candidates;
        for (std::size_t i = 0; i < all.size(); ++i) {
            const bool continues = i > 0 && all[i].plane.normal == all[i - 1].plane.normal &&
                                   all[i].plane.offset > all[i - 1].plane.offset;
            if (!continues) groups_.push_back({i, i});
            groups_.back().last = i + 1;
        }
        known_.resize(all.size());
    }

    const PreparedPiece& prepared() {
        if (!prepared_) prepared_ = prepare(piece_, objectives_, &axes_);
        return *prepared_;
    }

    void sweep_all() {
        if (late_.stage.size() == late_.planes.candidates.size()) return;
        const PreparedPiece& piece = prepared();
        parallel_for(0, groups_.size(), [&](std::size_t g) {
            context_.check_cancelled();
            const Group& group = groups_[g];
            std::vector<double> offsets;
            for (std::size_t i = group.first; i < group.last; ++i)
                offsets.push_back(late_.planes.candidates[i].plane.offset);
            auto swept = sweep_solids(piece, late_.planes.candidates[group.first].plane.normal, offsets);
            std::move(swept.begin(), swept.end(),
                      late_.planes.evaluations.begin() + static_cast<std::ptrdiff_t>(group.first));
        });
        late_.stage.assign(late_.planes.candidates.size(), LateStage::fast);
    }

    void update(const Group& group) {
        for (std::size_t i = group.first; i < group.last; ++i) {
            const std::optional<CutEvaluation>& evaluation = late_.planes.evaluations[i];
            const std::optional<Terms> t = evaluation ? terms(*evaluation, others_, objectives_, scan_) : std::nullopt;
            known_[i] = t ? Known{t->total, is_forbidden(*t, objectives_)} : Known{};
        }
    }

    bool is_open(std::size_t i, double most) const {
        return late_.stage[i] != LateStage::whole && known_[i].total < infinite && known_[i].total <= most + tie;
    }

    // Evaluates the next terms of the planes of a normal that may be among the best: fragility first, because it takes
    // a tenth of the time of the others and tells more planes apart.
    void advance(const Group& group, double most) {
        context_.check_cancelled();
        std::vector<std::size_t> chosen;
        LateStage stage = LateStage::fragility;
        for (std::size_t i = group.first; i < group.last; ++i) {
            if (!is_open(i, most)) continue;
            if (late_.stage[i] == LateStage::fast && stage == LateStage::fragility) {
                stage = LateStage::fast;
                chosen.clear();
            }
            if (late_.stage[i] == stage) chosen.push_back(i);
        }
        if (stage == LateStage::fragility && most == infinite && objectives_.forbidden.empty()) keep_least(chosen);
        evaluate(chosen, stage);
        update(group);
    }

    // While no limit is known: as many planes as are asked for, the least totals.
    void keep_least(std::vector<std::size_t>& chosen) const {
        if (chosen.size() <= best_) return;
        std::stable_sort(chosen.begin(), chosen.end(),
                         [&](std::size_t a, std::size_t b) { return known_[a].total < known_[b].total; });
        chosen.resize(best_);
        std::sort(chosen.begin(), chosen.end());
    }

    // The terms that follow `stage`, of planes of one normal.
    void evaluate(const std::vector<std::size_t>& chosen, LateStage stage) {
        std::vector<double> offsets;
        std::vector<std::optional<CutEvaluation>> evaluations;
        for (const std::size_t i : chosen) {
            offsets.push_back(late_.planes.candidates[i].plane.offset);
            evaluations.push_back(std::move(late_.planes.evaluations[i]));
        }
        const Vec3 normal = late_.planes.candidates[chosen.front()].plane.normal;
        const auto add = stage == LateStage::fast ? add_fragility : add_section_terms;
        add(*prepared_, normal, offsets, objectives_, evaluations);
        for (std::size_t k = 0; k < chosen.size(); ++k) {
            late_.planes.evaluations[chosen[k]] = std::move(evaluations[k]);
            late_.stage[chosen[k]] = stage == LateStage::fast ? LateStage::fragility : LateStage::whole;
        }
    }

    // The total of the last of the best planes that are known; infinite if there are too few.
    double limit() const {
        std::vector<double> totals;
        for (std::size_t i = 0; i < known_.size(); ++i) {
            if (late_.stage[i] == LateStage::whole && known_[i].total < infinite && !known_[i].is_out)
                totals.push_back(known_[i].total);
        }
        if (totals.size() < best_) return infinite;
        const auto last = totals.begin() + static_cast<std::ptrdiff_t>(best_) - 1;
        std::nth_element(totals.begin(), last, totals.end());
        return *last;
    }

    // The normals with planes that are not known and may be among the best, the least total first.
    std::vector<std::size_t> can_win(double most) const {
        std::vector<std::pair<double, std::size_t>> open;
        for (std::size_t g = 0; g < groups_.size(); ++g) {
            double least = infinite;
            for (std::size_t i = groups_[g].first; i < groups_[g].last; ++i) {
                if (is_open(i, most)) least = std::min(least, known_[i].total);
            }
            if (least < infinite) open.emplace_back(least, g);
        }
        std::sort(open.begin(), open.end());
        std::vector<std::size_t> groups;
        groups.reserve(open.size());
        for (const auto& [least, g] : open) groups.push_back(g);
        return groups;
    }

    const Piece& piece_;
    const Objectives& objectives_;
    const Context& context_;
    LateEvaluations& late_;
    std::array<Vec3, 3> axes_;
    std::vector<PieceShare> others_;
    ScanShare scan_;
    std::size_t best_;
    std::vector<Group> groups_;
    std::vector<Known> known_;  // per candidate
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
