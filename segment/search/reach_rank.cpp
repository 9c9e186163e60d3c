// One sweep over the samples per normal, in parallel; then the sweeps over the mesh of the normals that can still win,
// a few at a time, so that all cores are busy.

#include "segment/search/reach_rank.h"

#include <algorithm>
#include <cassert>
#include <numeric>

#include "base/parallel.h"
#include "base/timings.h"
#include "segment/cut/cut_piece.h"
#include "segment/cut/nudge.h"
#include "segment/mesh/measure.h"
#include "segment/score/cut_reach.h"
#include "segment/score/evaluate.h"
#include "segment/score/tool_directions.h"

namespace qchopper {
namespace {

constexpr std::size_t normals_at_once = 4;

ReachEvaluations swept(const Piece& piece, const OrientedBox& box, const SearchSettings& settings,
                       const Context& context) {
    ReachEvaluations result;
    result.normals = reach_normals(box);
    result.offsets.resize(result.normals.size());
    result.unreachable_mm2.resize(result.normals.size());
    const SampledPiece& samples = *piece.samples;
    const JudgedPiece judged = samples.judged();
    const ReachSweep sweep(piece, judged, cap_bases(piece), settings.objectives.tilt_deg);
    const int count = settings.candidates.offsets_per_normal;
    parallel_for(0, result.normals.size(), [&](std::size_t n) {
        context.check_cancelled();
        const Extent range = extent(*piece.mesh, result.normals[n]);
        for (int k = 1; k <= count; ++k) {
            result.offsets[n].push_back(range.low + range.size() * k / (count + 1));
        }
        for (const PlaneReach& plane : sweep.sweep(result.normals[n], result.offsets[n])) {
            result.unreachable_mm2[n].push_back(unreachable_mm2(plane));
        }
    });
    return result;
}

double least_of(const std::vector<double>& values) {
    return values.empty() ? 0 : *std::min_element(values.begin(), values.end());
}

// The ranking of one piece while it grows.
class ReachRanking {
 public:
    ReachRanking(const Segmentation& segmentation, std::size_t piece, const SearchSettings& settings,
                 EvaluationCache& cache, const Context& context)
        : piece_(segmentation.pieces[piece]), settings_(settings), context_(context), reach_(cache.reach(piece_)) {
        if (reach_.normals.empty()) {
            const StageTimer stage(context, "reach swept");
            reach_ = swept(piece_, cache.box(piece_), settings, context);
        }
        others_ = shares_of_others(segmentation, piece, settings.objectives, cache);
        order_.resize(reach_.normals.size());
        std::iota(order_.begin(), order_.end(), std::size_t{0});
        std::stable_sort(order_.begin(), order_.end(), [&](std::size_t a, std::size_t b) {
            return least_of(reach_.unreachable_mm2[a]) < least_of(reach_.unreachable_mm2[b]);
        });
    }

    std::vector<Ranked> run() {
        for (int cuts = 0;; ++cuts) {
            evaluate_what_can_win();
            const auto in_doubt = first_in_doubt();
            if (!in_doubt || cuts == most_real_cuts) return ranked_;
            cut_really(*in_doubt);
        }
    }

 private:
    // What a plane of this normal costs at least.
    double bound(std::size_t normal) const {
        double unreachable = least_of(reach_.unreachable_mm2[normal]);
        for (const PieceShare& other : others_) unreachable += other.unreachable_mm2;
        return settings_.objectives.weights.unreachable * unreachable / scan_area_mm2(piece_);
    }

    void evaluate_what_can_win() {
        rank_again();
        while (taken_ < order_.size()) {
            const bool is_enough = ranked_.size() >= settings_.beam;
            if (is_enough && bound(order_[taken_]) > ranked_[settings_.beam - 1].terms.total + tie) return;
            const std::size_t end = std::min(order_.size(), taken_ + normals_at_once);
            evaluate(std::span(order_).subspan(taken_, end - taken_));
            taken_ = end;
            rank_again();
        }
    }

    void evaluate(std::span<const std::size_t> normals) {
        const StageTimer stage(context_, "planes evaluated");
        std::vector<Candidate> candidates;
        for (const std::size_t n : normals) {
            if (reach_.evaluated.contains(n)) continue;
            reach_.evaluated[n];
            for (const Candidate& c : candidates_along(piece_, reach_.normals[n], static_cast<int>(n),
                                                       settings_.candidates.offsets_per_normal)) {
                candidates.push_back(c);
            }
        }
        if (candidates.empty()) return;
        std::vector<std::optional<CutEvaluation>> evaluations =
            evaluate_all(piece_, candidates, settings_.objectives, context_);
        for (std::size_t i = 0; i < candidates.size(); ++i) {
            const auto n = static_cast<std::size_t>(candidates[i].normal_index);
            if (evaluations[i]) {
                const auto k = static_cast<std::size_t>(candidates[i].offset_index);
                evaluations[i]->reach = CutReach{reach_.unreachable_mm2[n][k], scan_area_mm2(piece_)};
            }
            reach_.evaluated[n].candidates.push_back(candidates[i]);
            reach_.evaluated[n].evaluations.push_back(std::move(evaluations[i]));
        }
    }

    void rank_again() {
        PieceEvaluations all;
        for (std::size_t i = 0; i < taken_; ++i) {
            const PieceEvaluations& some = reach_.evaluated[order_[i]];
            all.candidates.insert(all.candidates.end(), some.candidates.begin(), some.candidates.end());
            all.evaluations.insert(all.evaluations.end(), some.evaluations.begin(), some.evaluations.end());
        }
        ranked_ = rank(all, others_, settings_.objectives);
    }

    // Of the planes that are taken as the best, the first whose sides are several solids and that was not cut yet.
    std::optional<Ranked> first_in_doubt() {
        for (std::size_t i = 0; i < std::min(settings_.beam, ranked_.size()); ++i) {
            const auto n = static_cast<std::size_t>(ranked_[i].normal_index);
            if (reach_.really_cut.contains({ranked_[i].normal_index, ranked_[i].offset_index})) continue;
            if (evaluation_of(n, ranked_[i].offset_index).solids.size() > 2) return ranked_[i];
        }
        return std::nullopt;
    }

    CutEvaluation& evaluation_of(std::size_t normal, int offset_index) {
        PieceEvaluations& some = reach_.evaluated[normal];
        const auto at = std::find_if(some.candidates.begin(), some.candidates.end(),
                                     [&](const Candidate& c) { return c.offset_index == offset_index; });
        return *some.evaluations[static_cast<std::size_t>(at - some.candidates.begin())];
    }

    void cut_really(const Ranked& plane) {
        const StageTimer stage(context_, "cuts made");
        context_.check_cancelled();
        reach_.really_cut.insert({plane.normal_index, plane.offset_index});
        std::optional<CutPieces> made = cut_piece(piece_, plane.plane, new_cut);
        if (!made) return;
        sample_parts(piece_, *made);
        double unreachable = 0;
        for (const Piece& part : made->pieces) {
            if (volume_mm3(*part.mesh) < settings_.objectives.fragment_volume_mm3) continue;
            unreachable += unreachable_mm2(part, settings_.objectives.tilt_deg);
        }
        evaluation_of(static_cast<std::size_t>(plane.normal_index), plane.offset_index).reach->unreachable_mm2 =
            unreachable;
    }

    const Piece& piece_;
    const SearchSettings& settings_;
    const Context& context_;
    ReachEvaluations& reach_;
    std::vector<PieceShare> others_;
    std::vector<std::size_t> order_;  // of the normals, by their least unreachable area
    std::size_t taken_ = 0;           // so many of them are evaluated
    std::vector<Ranked> ranked_;
};

}  // namespace

bool is_ranked_by_reach(const Piece& piece, const SearchSettings& settings) {
    return settings.objectives.weights.unreachable > 0 && piece.samples;
}

std::vector<Vec3> reach_normals(const OrientedBox& box) {
    std::vector<Vec3> normals;
    for (const Vec3& axis : box.axis) normals.push_back(canonical({axis, 0}).normal);
    for (const Vec3& normal : octahedron_normals()) {
        const Vec3 n = canonical({normal, 0}).normal;
        const auto is_there = [&](Vec3 other) { return norm(cross(n, other)) < 1e-9; };
        if (std::none_of(normals.begin(), normals.begin() + 3, is_there)) normals.push_back(n);
    }
    return normals;
}

std::vector<Ranked> rank_by_reach(const Segmentation& segmentation, std::size_t piece, const SearchSettings& settings,
                                  EvaluationCache& cache, const Context& context) {
    assert(is_ranked_by_reach(segmentation.pieces[piece], settings));
    return ReachRanking(segmentation, piece, settings, cache, context).run();
}

}  // namespace qchopper
