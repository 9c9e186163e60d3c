// One sweep over the samples per normal, in parallel; then, a few normals at a time so that all cores are busy, sweeps
// over the mesh of the planes that can still win: first their solids, then, of those that still can, the fragility. Of
// 10,560 planes some ten to a few hundred are evaluated.

#include "segment/search/access_rank.h"

#include <algorithm>
#include <cassert>
#include <limits>
#include <set>
#include <utility>

#include "base/parallel.h"
#include "base/timings.h"
#include "segment/access/cut_access.h"
#include "segment/access/dense_access.h"
#include "segment/cut/nudge.h"
#include "segment/objectives/sweep/sweep.h"
#include "segment/search/further_candidates.h"
#include "segment/search/refined_plane.h"
#include "segment/search/size_candidates.h"

namespace qchopper {
namespace {

constexpr std::size_t normals_at_once = 4;  // fixed, so that what is evaluated does not depend on the threads
constexpr std::size_t first_offsets = 8;
constexpr std::size_t axes_of_box = 3;
constexpr double infinite = std::numeric_limits<double>::infinity();

AccessEvaluations swept(const Piece& piece, const OrientedBox& box, const SearchSettings& settings,
                        const Context& context) {
    AccessEvaluations result;
    const CandidateOptions& options = settings.candidates;
    result.normals = candidate_normals(box, options.normals.value_or(CandidateNormals::sphere));
    result.offsets.resize(result.normals.size());
    result.unreachable_mm2.resize(result.normals.size());
    const SampledPiece& samples = *piece.samples;
    const JudgedPiece judged = samples.judged();
    const AccessSweep sweep(piece, judged, cap_bases(piece), settings.objectives.tilt_deg);
    const std::vector<NoCutTriangle> no_cut = no_cut_triangles(*piece.mesh, options.no_cut);
    parallel_for(0, result.normals.size(), [&](std::size_t n) {
        context.check_cancelled();
        result.offsets[n] = candidate_offsets(extent(*piece.mesh, result.normals[n]), options);
        for (const PlaneAccess& plane : sweep.sweep(result.normals[n], result.offsets[n])) {
            result.unreachable_mm2[n].push_back(unreachable_mm2(plane));
        }
        const std::vector<Extent> forbidden = forbidden_heights(no_cut, result.normals[n]);
        for (std::size_t k = 0; k < result.offsets[n].size(); ++k) {
            if (is_forbidden(forbidden, result.offsets[n][k])) result.unreachable_mm2[n][k] = infinite;
        }
    });
    return result;
}

// The ranking of one piece while it grows. A plane costs at least its reach; once its solids are known, at least all
// but its fragility. What a plane costs is the same whatever the other pieces are where the terms are those of the cut:
// then only planes that can win are evaluated, and which these are depends on the piece and the settings alone, so that
// an interrupted search gives the same bits. Otherwise normals are evaluated whole.
class AccessRanking {
 public:
    AccessRanking(const Segmentation& segmentation, std::size_t piece, const SearchSettings& settings,
                  EvaluationCache& cache, const Context& context, std::size_t best, const BlocksNeeded& too_large_for)
        : piece_(segmentation.pieces[piece]),
          settings_(settings),
          context_(context),
          access_(cache.access(piece_)),
          is_of_cut_(settings.objectives.scope == TermScope::cut && settings.objectives.weights.undercut == 0 &&
                     (settings.objectives.weights.utilization == 0 ||
                      settings.objectives.utilization_scope == TermScope::cut)) {
        if (access_.normals.empty()) {
            const StageTimer stage(context, "reach swept");
            access_ = swept(piece_, cache.box(piece_), settings, context);
        }
        best = std::max(settings.beam, best);
        auto for_size = candidates_for_size(cache.box(piece_), settings.candidates, too_large_for);
        if (access_.objectives != settings.objectives || access_.best != best || access_.for_size != for_size) {
            access_.evaluated.clear();
            access_.further.clear();
            access_.refined_from.reset();
            access_.refined.reset();
        }
        access_.objectives = settings.objectives;
        access_.best = best;
        access_.for_size = std::move(for_size);
        no_cut_ = no_cut_triangles(*piece_.mesh, settings.candidates.no_cut);
        further_ = further_candidates(segmentation, piece, settings.candidates);
        others_ = shares_of_others(segmentation, piece, settings.objectives, cache);
        scan_ = scan_share(segmentation, piece, settings.objectives, cache);
        box_axes_ = cache.box(piece_).axis;
        for (const PieceShare& other : others_) others_unreachable_mm2_ += other.unreachable_mm2;
        find_candidates(cache.unreachable_mm2(piece_, settings.objectives.tilt_deg));
    }

    // All planes of the normals of the best planes, so many normals and another one, beside those that can win.
    std::vector<Ranked> run_with_whole_normals(std::size_t count, int other) {
        std::set<int> normals;
        for (const Ranked& r : run()) {
            if (r.normal_index >= 0 && normals.size() < count) normals.insert(r.normal_index);
        }
        if (other >= 0 && static_cast<std::size_t>(other) < access_.normals.size()) normals.insert(other);
        std::vector<Group> groups;
        groups.reserve(normals.size());
        for (const int n : normals) groups.push_back({static_cast<std::size_t>(n), {}});
        takes_whole_normals_ = true;
        evaluate_solids(groups, infinite);
        evaluate_fragility(groups, infinite);
        return with_refined(ranking(others_));
    }

    std::vector<Ranked> run() {
        evaluate_further();
        for (int cuts = 0;; ++cuts) {
            evaluate_what_can_win();
            std::vector<Ranked> ranked = ranking(others_);
            if (ranked.empty() && std::exchange(is_restricted_, false)) {
                evaluate_what_can_win();  // no candidate parts the piece: another plane may
                ranked = ranking(others_);
            }
            const auto in_doubt = first_in_doubt(ranked);
            if (!in_doubt || cuts == max_real_cuts) return with_refined(std::move(ranked));
            cut_really(*in_doubt);
        }
    }

 private:
    // Planes of one normal that are evaluated together.
    struct Group {
        std::size_t normal = 0;
        std::vector<AccessPlane*> planes;
    };

    // Of a piece that is not cut for size a plane is a candidate if it opens nearly as much as the best one, or nothing
    // is to be gained and it lies along an axis of the box.
    void find_candidates(double unreachable_mm2) {
        double least = infinite;
        for (const std::vector<double>& planes : access_.unreachable_mm2) {
            for (const double unreachable : planes) least = std::min(least, unreachable);
        }
        const double gain = unreachable_mm2 - least;
        is_along_box_only_ = gain < min_gain_of_scan * scan_area_mm2(piece_);
        max_unreachable_mm2_ = unreachable_mm2 - min_share_of_gain * gain;
    }

    bool is_candidate(std::size_t normal, std::size_t offset) const {
        if (!is_restricted_) return true;
        if (!access_.for_size.empty()) return access_.for_size.contains({normal, offset});
        return is_along_box_only_ ? normal < axes_of_box
                                  : access_.unreachable_mm2[normal][offset] <= max_unreachable_mm2_;
    }

    // Of planes along none of the normals. Beside planes by which the piece is cut for size there is no room for them.
    bool is_further_candidate(const AccessPlane& plane) const {
        if (!is_restricted_) return true;
        if (!access_.for_size.empty()) return false;
        return is_along_box_only_ || plane.evaluation->access->unreachable_mm2 <= max_unreachable_mm2_;
    }

    AccessPlane* further_plane(const Plane& plane) {
        const auto at = std::find_if(access_.further.begin(), access_.further.end(),
                                     [&](const AccessPlane& p) { return p.candidate.plane == plane; });
        return at == access_.further.end() ? nullptr : &*at;
    }

    AccessPlane& plane_of(const Ranked& ranked) {
        if (ranked.normal_index < 0) return *further_plane(ranked.plane);
        return access_.evaluated.at(
            {static_cast<std::size_t>(ranked.normal_index), static_cast<std::size_t>(ranked.offset_index)});
    }

    // With all terms; the evaluation is nothing if the plane misses.
    AccessPlane evaluated_alone(const Candidate& candidate) {
        const Plane& plane = candidate.plane;
        std::vector<std::optional<CutEvaluation>> evaluation =
            sweep_solids(prepared_piece(), plane.normal, {&plane.offset, 1});
        if (evaluation.front()) {
            add_late_terms(prepared_piece(), plane.normal, {&plane.offset, 1}, settings_.objectives, evaluation);
            evaluation.front()->access = cut_access(piece_, plane, settings_.objectives.tilt_deg);
        }
        return {candidate, true, std::move(evaluation.front()), true, false};
    }

    void evaluate_further() {
        if (further_.empty()) return;
        const StageTimer stage(context_, "planes evaluated");
        for (const Candidate& candidate : further_) {
            context_.check_cancelled();
            if (further_plane(candidate.plane) != nullptr) continue;
            access_.further.push_back(evaluated_alone(candidate));
            AccessPlane& plane = access_.further.back();
            if (plane.evaluation && plane.evaluation->solids.size() > 2) cut_really(plane);
        }
    }

    std::span<const PieceShare> counted_others() const {
        return is_of_cut_ ? std::span<const PieceShare>{} : std::span<const PieceShare>(others_);
    }

    ScanShare counted_scan() const {
        ScanShare scan = scan_;
        if (is_of_cut_) scan.seam_mm = 0;
        return scan;
    }

    // What a plane costs at least, without what the other pieces cost where that is the same for all planes.
    double bound(std::size_t normal, std::size_t offset) const {
        const auto at = access_.evaluated.find({normal, offset});
        if (at == access_.evaluated.end()) {
            if (!is_candidate(normal, offset)) return infinite;
            const double others = is_of_cut_ ? 0 : others_unreachable_mm2_;
            return settings_.objectives.weights.unreachable * (access_.unreachable_mm2[normal][offset] + others) /
                   scan_area_mm2(piece_);
        }
        if (!at->second.evaluation) return at->second.is_swept ? infinite : 0;
        const std::optional<Terms> t =
            terms(*at->second.evaluation, counted_others(), settings_.objectives, counted_scan());
        return t ? t->total : infinite;
    }

    bool is_known(std::size_t normal, std::size_t offset) const {
        const auto at = access_.evaluated.find({normal, offset});
        return at != access_.evaluated.end() && at->second.is_swept &&
               (!at->second.evaluation || at->second.has_fragility);
    }

    // Evaluates until no plane that is not evaluated can be among the best.
    void evaluate_what_can_win() {
        const StageTimer stage(context_, "planes evaluated");
        while (true) {
            const double most = limit();
            std::vector<std::pair<double, std::size_t>> open;  // least bound of a normal, and the normal
            for (std::size_t n = 0; n < access_.normals.size(); ++n) {
                double least = infinite;
                for (std::size_t k = 0; k < access_.offsets[n].size(); ++k) {
                    if (!is_known(n, k)) least = std::min(least, bound(n, k));
                }
                if (least < infinite && least <= most + tie) open.emplace_back(least, n);
            }
            if (open.empty()) return;
            std::sort(open.begin(), open.end());
            open.resize(std::min(open.size(), normals_at_once));
            std::vector<Group> groups;
            groups.reserve(open.size());
            for (const auto& [least, n] : open) groups.push_back({n, {}});
            evaluate_solids(groups, most);
            evaluate_fragility(groups, limit());
            context_.progress("planes evaluated", access_.evaluated.size(), 0);
        }
    }

    // The total of the last of the best planes that are evaluated; infinite if there are too few.
    double limit() const {
        std::vector<double> totals;
        for (const auto& [key, plane] : access_.evaluated) {
            if (!plane.has_fragility) continue;
            const double total = bound(key.first, key.second);
            if (total < infinite) totals.push_back(total);
        }
        if (totals.size() < access_.best) return infinite;
        const auto last = totals.begin() + static_cast<std::ptrdiff_t>(access_.best) - 1;
        std::nth_element(totals.begin(), last, totals.end());
        return *last;
    }

    // Offsets of a normal that can win, or so long as nothing is known some that cost least; all where normals are
    // evaluated whole.
    std::vector<std::size_t> wanted(std::size_t normal, double most) const {
        std::vector<std::size_t> offsets;
        for (std::size_t k = 0; k < access_.offsets[normal].size(); ++k) {
            if (is_known(normal, k)) continue;
            const bool can_win = is_candidate(normal, k) && (!is_of_cut_ || bound(normal, k) <= most + tie);
            if (can_win || takes_whole_normals_) offsets.push_back(k);
        }
        if (is_of_cut_ && !takes_whole_normals_ && most == infinite && offsets.size() > first_offsets) {
            const std::vector<double>& access = access_.unreachable_mm2[normal];
            std::stable_sort(offsets.begin(), offsets.end(),
                             [&](std::size_t a, std::size_t b) { return access[a] < access[b]; });
            offsets.resize(first_offsets);
            std::sort(offsets.begin(), offsets.end());
        }
        return offsets;
    }

    // Adds the planes that are wanted to the groups, with their solids.
    void evaluate_solids(std::vector<Group>& groups, double most) {
        std::vector<std::vector<std::size_t>> offsets;
        for (Group& group : groups) {
            offsets.push_back(wanted(group.normal, most));
            for (const std::size_t k : offsets.back()) group.planes.push_back(&access_.evaluated[{group.normal, k}]);
        }
        const PreparedPiece& prepared = prepared_piece();
        parallel_for(0, groups.size(), [&](std::size_t g) {
            context_.check_cancelled();
            const std::size_t n = groups[g].normal;
            std::vector<double> wanted_offsets;
            std::vector<AccessPlane*> fresh;
            for (std::size_t i = 0; i < offsets[g].size(); ++i) {
                if (groups[g].planes[i]->is_swept) continue;
                wanted_offsets.push_back(access_.offsets[n][offsets[g][i]]);
                fresh.push_back(groups[g].planes[i]);
                fresh.back()->candidate = {{access_.normals[n], 0},
                                           wanted_offsets.back(),
                                           static_cast<int>(n),
                                           static_cast<int>(offsets[g][i])};
            }
            const std::vector<std::optional<Nudged>> nudged = nudge(piece_, access_.normals[n], wanted_offsets);
            const std::vector<Extent> forbidden = forbidden_heights(no_cut_, access_.normals[n]);
            std::vector<double> nudged_offsets;
            std::vector<AccessPlane*> met;
            for (std::size_t i = 0; i < fresh.size(); ++i) {
                if (!nudged[i] || is_forbidden(forbidden, nudged[i]->offset)) continue;
                fresh[i]->candidate.plane.offset = nudged[i]->offset;
                nudged_offsets.push_back(nudged[i]->offset);
                met.push_back(fresh[i]);
            }
            std::vector<std::optional<CutEvaluation>> evaluations =
                sweep_solids(prepared, access_.normals[n], nudged_offsets);
            for (std::size_t i = 0; i < met.size(); ++i) {
                if (!evaluations[i]) continue;
                const auto k = static_cast<std::size_t>(met[i]->candidate.offset_index);
                evaluations[i]->access = CutAccess{access_.unreachable_mm2[n][k], scan_area_mm2(piece_)};
                met[i]->evaluation = std::move(evaluations[i]);
            }
            for (AccessPlane* plane : fresh) plane->is_swept = true;
        });
    }

    void evaluate_fragility(const std::vector<Group>& groups, double most) {
        const PreparedPiece& prepared = prepared_piece();
        parallel_for(0, groups.size(), [&](std::size_t g) {
            context_.check_cancelled();
            std::vector<double> offsets;
            std::vector<AccessPlane*> planes;
            std::vector<std::optional<CutEvaluation>> evaluations;
            for (AccessPlane* plane : groups[g].planes) {
                if (!plane->evaluation || plane->has_fragility) continue;
                const double least = bound(groups[g].normal, static_cast<std::size_t>(plane->candidate.offset_index));
                if (is_of_cut_ && !takes_whole_normals_ && least > most + tie) continue;
                offsets.push_back(plane->candidate.plane.offset);
                planes.push_back(plane);
                evaluations.push_back(std::move(plane->evaluation));
            }
            if (planes.empty()) return;
            add_late_terms(prepared, access_.normals[groups[g].normal], offsets, settings_.objectives, evaluations);
            for (std::size_t i = 0; i < planes.size(); ++i) {
                planes[i]->evaluation = std::move(evaluations[i]);
                planes[i]->has_fragility = true;
            }
        });
    }

    const PreparedPiece& prepared_piece() {
        if (!prepared_) prepared_ = prepare(piece_, settings_.objectives, &box_axes_);
        return *prepared_;
    }

    // Adds the best plane, moved and turned a little, where its total puts it. Not where its sides are several solids,
    // because only cutting judges those, nor where the piece is cut for size.
    std::vector<Ranked> with_refined(std::vector<Ranked> ranked) {
        if (ranked.empty()) return ranked;
        const AccessPlane& best = plane_of(ranked.front());
        const bool may_refine = best.evaluation->solids.size() == 2 && access_.for_size.empty();
        if (access_.refined_from != best.candidate.plane) {
            access_.refined_from = best.candidate.plane;
            access_.refined.reset();
            if (may_refine) refine(best);
        }
        if (!access_.refined) return ranked;
        const std::vector<Ranked> refined =
            rank({{access_.refined->candidate}, {access_.refined->evaluation}}, others_, settings_.objectives, scan_);
        ranked.insert(ranked.end(), refined.begin(), refined.end());
        sort_ranking(ranked, settings_.objectives);
        return ranked;
    }

    void refine(const AccessPlane& best) {
        const double area = scan_area_mm2(piece_);
        if (best.evaluation->access->unreachable_mm2 < min_gain_of_scan * area) return;
        const StageTimer stage(context_, "planes refined");
        DenseAccess access(piece_, settings_.objectives.tilt_deg);
        const double step = offset_step(extent(*piece_.mesh, best.candidate.plane.normal), settings_.candidates) / 2;
        const auto is_allowed = [&](const Plane& plane) {
            return !is_forbidden(forbidden_heights(no_cut_, plane.normal), plane.offset);
        };
        const RefinedPlane found = refined_plane(access, piece_, best.candidate.plane, step, context_, is_allowed);
        if (found.plane == best.candidate.plane) return;
        const std::optional<Nudged> nudged = nudge(piece_, found.plane.normal, {&found.plane.offset, 1}).front();
        if (!nudged || !is_allowed({found.plane.normal, nudged->offset})) return;
        AccessPlane refined =
            evaluated_alone({{found.plane.normal, nudged->offset}, found.plane.offset, refined_index, refined_index});
        if (!refined.evaluation || refined.evaluation->solids.size() != 2) return;
        access_.refined = std::move(refined);
    }

    std::vector<Ranked> ranking(std::span<const PieceShare> others) {
        PieceEvaluations all;
        for (const auto& [key, plane] : access_.evaluated) {
            if (!plane.has_fragility) continue;
            all.candidates.push_back(plane.candidate);
            all.evaluations.push_back(plane.evaluation);
        }
        for (const Candidate& candidate : further_) {
            const AccessPlane& plane = *further_plane(candidate.plane);
            if (!plane.evaluation || !is_further_candidate(plane)) continue;
            all.candidates.push_back(candidate);
            all.evaluations.push_back(plane.evaluation);
        }
        return rank(all, others, settings_.objectives, scan_);
    }

    // Of the planes that are taken, and those that setups may choose before them (app/engine/review_cuts.h), the first
    // whose sides are several solids and that was not cut yet.
    AccessPlane* first_in_doubt(const std::vector<Ranked>& ranked) {
        for (std::size_t i = 0; i < std::min(std::max(settings_.beam, min_best_planes), ranked.size()); ++i) {
            AccessPlane& plane = plane_of(ranked[i]);
            if (!plane.is_really_cut && plane.evaluation->solids.size() > 2) return &plane;
        }
        return nullptr;
    }

    void cut_really(AccessPlane& plane) {
        const StageTimer stage(context_, "cuts made");
        context_.check_cancelled();
        plane.is_really_cut = true;
        const Objectives& objectives = settings_.objectives;
        const std::optional<double> unreachable = unreachable_when_cut_mm2(
            piece_, plane.candidate.plane, objectives.fragment_volume_mm3, objectives.tilt_deg);
        if (unreachable) plane.evaluation->access->unreachable_mm2 = *unreachable;
    }

    const Piece& piece_;
    const SearchSettings& settings_;
    const Context& context_;
    AccessEvaluations& access_;
    bool is_of_cut_;  // the other pieces add the same to the cost of every plane
    std::vector<NoCutTriangle> no_cut_;
    std::vector<Candidate> further_;
    std::vector<PieceShare> others_;
    double others_unreachable_mm2_ = 0;
    ScanShare scan_;
    std::array<Vec3, 3> box_axes_;
    bool is_restricted_ = true;  // to the candidates
    bool is_along_box_only_ = false;
    double max_unreachable_mm2_ = 0;  // of a candidate
    bool takes_whole_normals_ = false;
    std::optional<PreparedPiece> prepared_;
};

}  // namespace

bool is_ranked_by_access(const Piece& piece, const SearchSettings& settings) {
    return settings.objectives.weights.unreachable > 0 && piece.samples;
}

std::vector<Ranked> rank_by_access(const Segmentation& segmentation, std::size_t piece, const SearchSettings& settings,
                                   EvaluationCache& cache, const Context& context, std::size_t best,
                                   const BlocksNeeded& too_large_for) {
    assert(is_ranked_by_access(segmentation.pieces[piece], settings));
    return AccessRanking(segmentation, piece, settings, cache, context, best, too_large_for).run();
}

std::vector<Ranked> rank_whole_normals_by_access(const Segmentation& segmentation, std::size_t piece,
                                                 const SearchSettings& settings, EvaluationCache& cache,
                                                 const Context& context, std::size_t normals, int other,
                                                 const BlocksNeeded& too_large_for) {
    assert(is_ranked_by_access(segmentation.pieces[piece], settings));
    return AccessRanking(segmentation, piece, settings, cache, context, min_best_planes, too_large_for)
        .run_with_whole_normals(normals, other);
}

}  // namespace qchopper
