// Normals are always evaluated whole, so that their values have the same bits in whatever order they are asked for.

#include "segment/search/late_rank.h"

#include <algorithm>
#include <cassert>
#include <limits>
#include <tuple>

#include "base/parallel.h"
#include "base/timings.h"
#include "segment/cut/cut_piece.h"
#include "segment/mesh/measure.h"
#include "segment/score/sweep.h"

namespace qchopper {
namespace {

constexpr std::size_t normals_at_once = 4;  // fixed, so that what is evaluated does not depend on the threads
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
        double most = limit();
        for (std::vector<std::size_t> open = can_win(most); !open.empty(); open = can_win(most)) {
            open.resize(std::min(open.size(), normals_at_once));
            parallel_for(0, open.size(), [&](std::size_t i) { advance(open[i]); });
            most = limit();
            context_.progress("planes evaluated", done(), late_.planes.candidates.size());
        }
        PieceEvaluations known;
        for (std::size_t g = 0; g < groups_.size(); ++g) {
            if (!is_whole(g)) continue;
            for (std::size_t i = groups_[g].first; i < groups_[g].last; ++i) {
                known.candidates.push_back(late_.planes.candidates[i]);
                known.evaluations.push_back(late_.planes.evaluations[i]);
            }
        }
        std::vector<Ranked> ranked = rank(known, others_, objectives_, scan_);
        std::erase_if(ranked, [&](const Ranked& r) {
            return r.terms.total > most + tie || (most < infinite && is_forbidden(r.terms, objectives_));
        });
        return ranked;
    }

 private:
    struct Group {  // candidates of one normal
        std::size_t first;
        std::size_t last;
    };

    void find_groups() {
        const std::vector<Candidate>& all = late_.planes.candidates;
        for (std::size_t i = 0; i < all.size(); ++i) {
            const bool continues = i > 0 && all[i].plane.normal == all[i - 1].plane.normal &&
                                   all[i].plane.offset > all[i - 1].plane.offset;
            if (!continues) groups_.push_back({i, i});
            groups_.back().last = i + 1;
        }
    }

    std::vector<double> offsets_of(const Group& group) const {
        std::vector<double> offsets;
        for (std::size_t i = group.first; i < group.last; ++i)
            offsets.push_back(late_.planes.candidates[i].plane.offset);
        return offsets;
    }

    const PreparedPiece& prepared() {
        if (!prepared_) prepared_ = prepare(piece_, objectives_, &axes_);
        return *prepared_;
    }

    void sweep_all() {
        if (late_.of_normal.size() == groups_.size()) return;
        const PreparedPiece& piece = prepared();
        parallel_for(0, groups_.size(), [&](std::size_t g) {
            context_.check_cancelled();
            const Group& group = groups_[g];
            auto swept = sweep_solids(piece, late_.planes.candidates[group.first].plane.normal, offsets_of(group));
            std::move(swept.begin(), swept.end(),
                      late_.planes.evaluations.begin() + static_cast<std::ptrdiff_t>(group.first));
        });
        late_.of_normal.assign(groups_.size(), LateStage::fast);
    }

    bool is_whole(std::size_t g) const { return late_.of_normal[g] == LateStage::whole; }

    // Fragility first: it takes a tenth of the time of the others and tells more planes apart.
    void advance(std::size_t g) {
        context_.check_cancelled();
        const Group& group = groups_[g];
        const Vec3 normal = late_.planes.candidates[group.first].plane.normal;
        const auto of_group = std::span(late_.planes.evaluations).subspan(group.first, group.last - group.first);
        LateStage& stage = late_.of_normal[g];
        if (stage == LateStage::fast) {
            add_fragility(*prepared_, normal, offsets_of(group), objectives_, of_group);
            stage = LateStage::fragility;
        } else {
            add_late_terms(*prepared_, normal, offsets_of(group), objectives_, of_group);
            stage = LateStage::whole;
        }
    }

    // The total of the last of the best planes that are known; infinite if there are too few.
    double limit() const {
        std::vector<double> totals;
        for (std::size_t g = 0; g < groups_.size(); ++g) {
            if (!is_whole(g)) continue;
            for (std::size_t i = groups_[g].first; i < groups_[g].last; ++i) {
                const std::optional<Terms> t = terms_of(i);
                if (t && !is_forbidden(*t, objectives_)) totals.push_back(t->total);
            }
        }
        if (totals.size() < best_) return infinite;
        const auto last = totals.begin() + static_cast<std::ptrdiff_t>(best_) - 1;
        std::nth_element(totals.begin(), last, totals.end());
        return *last;
    }

    // The normals that are not known and may hold one of the best planes, the least bound first.
    std::vector<std::size_t> can_win(double most) {
        std::vector<std::pair<double, std::size_t>> open;
        for (std::size_t g = 0; g < groups_.size(); ++g) {
            if (is_whole(g)) continue;
            double least = infinite;
            for (std::size_t i = groups_[g].first; i < groups_[g].last; ++i) {
                if (const std::optional<Terms> t = terms_of(i)) least = std::min(least, t->total);
            }
            if (least < infinite && least <= most + tie) open.emplace_back(least, g);
        }
        std::sort(open.begin(), open.end());
        std::vector<std::size_t> groups;
        groups.reserve(open.size());
        for (const auto& [least, g] : open) groups.push_back(g);
        if (!groups.empty()) prepared();
        return groups;
    }

    std::optional<Terms> terms_of(std::size_t i) const {
        if (!late_.planes.evaluations[i]) return std::nullopt;
        return terms(*late_.planes.evaluations[i], others_, objectives_, scan_);
    }

    std::size_t done() const {
        std::size_t planes = 0;
        for (std::size_t g = 0; g < groups_.size(); ++g) {
            if (is_whole(g)) planes += groups_[g].last - groups_[g].first;
        }
        return planes;
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
    const std::size_t count = std::min(ranked.size(), most_own_boxes);
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
