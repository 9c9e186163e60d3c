// One sweep over the samples per normal, in parallel; then, a few normals at a time so that all cores are busy, sweeps
// over the mesh of the planes that can still win: first their solids, then, of those that still can, the fragility. Of
// 10,560 planes some ten to a few hundred are evaluated. Sweeping costs O(samples * directions) per normal, evaluating
// O(triangles) per plane.

#include "segment/search/access_rank.h"

#include <algorithm>
#include <cassert>
#include <set>
#include <utility>

#include "base/parallel.h"
#include "base/timings.h"
#include "segment/access/access_sweep.h"
#include "segment/access/dense_access.h"
#include "segment/access/piece_access.h"
#include "segment/cut/nudge.h"
#include "segment/objectives/sweep/prepared.h"
#include "segment/search/best_first.h"
#include "segment/search/candidates/cap_frame.h"
#include "segment/search/candidates/size_candidates.h"
#include "segment/search/further_candidates.h"
#include "segment/search/refined_plane.h"

namespace qchopper {
namespace {

constexpr std::size_t normals_at_once = 4;
constexpr std::size_t first_offsets = 8;
constexpr std::size_t axes_of_box = 3;

// The planes of one normal before any is evaluated.
PlanesOfNormal unevaluated(Vec3 normal, std::size_t number, const std::vector<double>& offsets) {
    PlanesOfNormal planes;
    for (const double offset : offsets) {
        const Candidate candidate{{normal, offset}, offset, static_cast<int>(number), static_cast<int>(planes.size())};
        planes.push_back({.candidate = candidate});
    }
    return planes;
}

// The axes of the box, the octahedron's, and those that follow from the caps, each once.
std::vector<Vec3> normals_of(const Piece& piece, const OrientedBox& box, const CandidateOptions& options) {
    std::vector<Vec3> normals = candidate_normals(box, options.normals.value_or(CandidateNormals::sphere));
    if (!options.along_caps) return normals;
    const std::vector<Vec3> caps = cap_normals(piece);
    for (std::size_t n = axes_of_box; n < normals.size(); ++n) normals[n] = snapped(normals[n], caps);
    for (const Vec3& normal : normals_along_caps(piece)) {
        const auto is_same = [&](Vec3 n) { return norm(cross(n, normal)) <= same_direction_rad; };
        if (std::none_of(normals.begin(), normals.end(), is_same)) normals.push_back(normal);
    }
    return normals;
}

AccessEvaluations swept(const Piece& piece, const OrientedBox& box, const SearchSettings& settings,
                        const Context& context) {
    AccessEvaluations result;
    const CandidateOptions& options = settings.candidates;
    result.normals = normals_of(piece, box, options);
    result.planes.resize(result.normals.size());
    result.unreachable_mm2.resize(result.normals.size());
    const AccessSweep sweep(piece, settings.objectives.tilt_deg);
    const std::vector<NoCutTriangle> no_cut = no_cut_triangles(*piece.mesh, options.no_cut);
    parallel_for(0, result.normals.size(), [&](std::size_t n) {
        context.check_cancelled();
        const std::vector<double> offsets = candidate_offsets(extent(*piece.mesh, result.normals[n]), options);
        result.planes[n] = unevaluated(result.normals[n], n, offsets);
        const std::vector<Extent> forbidden = forbidden_heights(no_cut, result.normals[n]);
        for (const PlaneAccess& plane : sweep.sweep(result.normals[n], offsets)) {
            const double offset = offsets[result.unreachable_mm2[n].size()];
            result.unreachable_mm2[n].push_back(is_forbidden(forbidden, offset) ? never : plane.unreachable_mm2());
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
          cutting_box_(box_for_cuts(piece_, cache.box(piece_), settings.candidates)),
          is_of_cut_(settings.objectives.scope == TermScope::cut && settings.objectives.weights.undercut == 0 &&
                     (settings.objectives.weights.utilization == 0 ||
                      settings.objectives.utilization_scope == TermScope::cut)) {
        if (access_.normals.empty()) {
            const StageTimer stage(context, "reach swept");
            access_ = swept(piece_, cutting_box_, settings, context);
        }
        best = std::max(settings.beam, best);
        auto for_size = candidates_for_size(cutting_box_, settings.candidates, too_large_for);
        if (access_.objectives != settings.objectives || access_.best != best || access_.for_size != for_size) {
            for (PlanesOfNormal& planes : access_.planes) {
                for (EvaluatedPlane& plane : planes) plane = {.candidate = plane.candidate};
            }
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
        const PreparedPiece& prepared = prepared_piece();
        const std::vector<int> whole(normals.begin(), normals.end());
        parallel_for(0, whole.size(), [&](std::size_t i) {
            PlanesOfNormal& planes = access_.planes[static_cast<std::size_t>(whole[i])];
            std::vector<EvaluatedPlane*> all;
            for (EvaluatedPlane& plane : planes) all.push_back(&plane);
            evaluate_solids(prepared, all);
            evaluate_whole(prepared, all);
        });
        return with_refined(ranking());
    }

    std::vector<Ranked> run() {
        evaluate_further();
        for (int cuts = 0;; ++cuts) {
            evaluate_best();
            std::vector<Ranked> ranked = ranking();
            if (ranked.empty() && std::exchange(is_restricted_, false)) {
                evaluate_best();  // no candidate parts the piece: another plane may
                ranked = ranking();
            }
            const auto in_doubt = first_in_doubt(ranked);
            if (!in_doubt || cuts == max_real_cuts) return with_refined(std::move(ranked));
            cut_really(*in_doubt);
        }
    }

 private:
    // Of a piece that is not cut for size a plane is a candidate if it opens nearly as much as the best one, or nothing
    // is to be gained and it lies along an axis of the box.
    void find_candidates(double unreachable_mm2) {
        double least = never;
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
    bool is_further_candidate(const EvaluatedPlane& plane) const {
        if (!is_restricted_) return true;
        if (!access_.for_size.empty()) return false;
        return is_along_box_only_ || plane.evaluation->access->unreachable_mm2 <= max_unreachable_mm2_;
    }

    EvaluatedPlane* further_plane(const Plane& plane) {
        const auto at = std::find_if(access_.further.begin(), access_.further.end(),
                                     [&](const EvaluatedPlane& p) { return p.candidate.plane == plane; });
        return at == access_.further.end() ? nullptr : &*at;
    }

    EvaluatedPlane& plane_of(const Ranked& ranked) {
        if (ranked.normal_index < 0) return *further_plane(ranked.plane);
        return access_
            .planes[static_cast<std::size_t>(ranked.normal_index)][static_cast<std::size_t>(ranked.offset_index)];
    }

    // With all terms; the evaluation is nothing if the plane misses.
    EvaluatedPlane evaluated_alone(const Candidate& candidate) {
        EvaluatedPlane plane{.candidate = candidate};
        EvaluatedPlane* const alone = &plane;
        evaluate({&alone, 1}, TermStage::solids, prepared_piece(), settings_.objectives);
        if (plane.evaluation) {
            evaluate({&alone, 1}, TermStage::whole, prepared_piece(), settings_.objectives);
            plane.evaluation->access = cut_access(piece_, candidate.plane, settings_.objectives.tilt_deg);
        }
        plane.stage = TermStage::whole;
        return plane;
    }

    void evaluate_further() {
        if (further_.empty()) return;
        const StageTimer stage(context_, "planes evaluated");
        for (const Candidate& candidate : further_) {
            context_.check_cancelled();
            if (further_plane(candidate.plane) != nullptr) continue;
            access_.further.push_back(evaluated_alone(candidate));
            EvaluatedPlane& plane = access_.further.back();
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
        const EvaluatedPlane& plane = access_.planes[normal][offset];
        if (plane.stage == TermStage::none) {
            if (!is_candidate(normal, offset)) return never;
            const double others = is_of_cut_ ? 0 : others_unreachable_mm2_;
            return settings_.objectives.weights.unreachable * (access_.unreachable_mm2[normal][offset] + others) /
                   scan_area_mm2(piece_);
        }
        if (!plane.evaluation) return never;
        const Objectives& objectives = settings_.objectives;
        const std::optional<Terms> t = terms(*plane.evaluation, counted_others(), objectives, counted_scan());
        if (!t || (plane.stage == TermStage::whole && is_forbidden(*t, objectives))) return never;
        return t->total;
    }

    void evaluate_best() {
        const StageTimer stage(context_, "planes evaluated");
        BestFirst search{access_.planes, access_.best, normals_at_once};
        search.bound = [&](std::size_t n, std::size_t k) { return bound(n, k); };
        search.evaluate = [&](std::span<const std::size_t> normals, const Bounds& bounds, double most) {
            const PreparedPiece& prepared = prepared_piece();
            parallel_for(0, normals.size(), [&](std::size_t i) {
                const std::size_t n = normals[i];
                std::vector<EvaluatedPlane*> planes = wanted(n, bounds[n], most);
                evaluate_solids(prepared, planes);
                std::erase_if(planes, [&](const EvaluatedPlane* plane) {
                    const auto k = static_cast<std::size_t>(plane->candidate.offset_index);
                    return is_of_cut_ && bound(n, k) > most + tie;
                });
                evaluate_whole(prepared, planes);
            });
            context_.progress("planes evaluated", count_evaluated(access_.planes, TermStage::solids), 0);
        };
        evaluate_what_can_win(search);
    }

    // Planes of a normal that can win, or so long as nothing is known some that cost least; all candidates where
    // normals are evaluated whole.
    std::vector<EvaluatedPlane*> wanted(std::size_t normal, std::span<const double> bounds, double most) {
        PlanesOfNormal& planes = access_.planes[normal];
        std::vector<std::size_t> offsets;
        for (std::size_t k = 0; k < planes.size(); ++k) {
            const bool is_open = planes[k].stage == TermStage::none || planes[k].evaluation.has_value();
            if (!is_open || planes[k].stage == TermStage::whole || !is_candidate(normal, k)) continue;
            if (!is_of_cut_ || bounds[k] <= most + tie) offsets.push_back(k);
        }
        if (is_of_cut_ && most == never) keep_least(offsets, first_offsets, access_.unreachable_mm2[normal]);
        std::vector<EvaluatedPlane*> chosen;
        chosen.reserve(offsets.size());
        for (const std::size_t k : offsets) chosen.push_back(&planes[k]);
        return chosen;
    }

    // Of planes of one normal, some of which have their solids.
    void evaluate_solids(const PreparedPiece& prepared, std::vector<EvaluatedPlane*> planes) const {
        context_.check_cancelled();
        std::erase_if(planes, [](const EvaluatedPlane* plane) { return plane->stage != TermStage::none; });
        if (planes.empty()) return;
        const Vec3 normal = planes.front()->candidate.plane.normal;
        std::vector<double> offsets;
        offsets.reserve(planes.size());
        for (const EvaluatedPlane* plane : planes) offsets.push_back(plane->candidate.wanted_offset);
        const std::vector<std::optional<Nudged>> nudged = nudge(piece_, normal, offsets);
        const std::vector<Extent> forbidden = forbidden_heights(no_cut_, normal);
        std::vector<EvaluatedPlane*> met;
        for (std::size_t i = 0; i < planes.size(); ++i) {
            if (nudged[i] && !is_forbidden(forbidden, nudged[i]->offset)) {
                planes[i]->candidate.plane.offset = nudged[i]->offset;
                met.push_back(planes[i]);
            } else {
                planes[i]->stage = TermStage::solids;
            }
        }
        evaluate(met, TermStage::solids, prepared, settings_.objectives);
        for (EvaluatedPlane* plane : met) {
            if (!plane->evaluation) continue;
            const auto n = static_cast<std::size_t>(plane->candidate.normal_index);
            const auto k = static_cast<std::size_t>(plane->candidate.offset_index);
            plane->evaluation->access = CutAccess{access_.unreachable_mm2[n][k], scan_area_mm2(piece_)};
        }
    }

    // Of planes of one normal that have their solids.
    void evaluate_whole(const PreparedPiece& prepared, std::vector<EvaluatedPlane*> planes) const {
        context_.check_cancelled();
        std::erase_if(
            planes, [](const EvaluatedPlane* plane) { return !plane->evaluation || plane->stage == TermStage::whole; });
        evaluate(planes, TermStage::whole, prepared, settings_.objectives);
    }

    const PreparedPiece& prepared_piece() {
        if (!prepared_) prepared_ = prepare(piece_, settings_.objectives, &box_axes_);
        return *prepared_;
    }

    // Adds the best plane, moved and turned a little, where its total puts it. Not where its sides are several solids,
    // because only cutting judges those, nor where the piece is cut for size.
    std::vector<Ranked> with_refined(std::vector<Ranked> ranked) {
        if (ranked.empty()) return ranked;
        const EvaluatedPlane& best = plane_of(ranked.front());
        const bool may_refine = best.evaluation->solids.size() == 2 && access_.for_size.empty();
        if (access_.refined_from != best.candidate.plane) {
            access_.refined_from = best.candidate.plane;
            access_.refined.reset();
            if (may_refine) refine(best);
        }
        if (!access_.refined) return ranked;
        add(ranked, *access_.refined);
        sort_ranking(ranked, settings_.objectives);
        return ranked;
    }

    void refine(const EvaluatedPlane& best) {
        const double area = scan_area_mm2(piece_);
        if (best.evaluation->access->unreachable_mm2 < min_gain_of_scan * area) return;
        const StageTimer stage(context_, "planes refined");
        DenseAccess access(piece_, settings_.objectives.tilt_deg);
        const double step = offset_step(extent(*piece_.mesh, best.candidate.plane.normal), settings_.candidates) / 2;
        const auto is_allowed = [&](const Plane& plane) {
            return !is_forbidden(forbidden_heights(no_cut_, plane.normal), plane.offset);
        };
        const std::vector<Vec3> caps = settings_.candidates.along_caps ? cap_normals(piece_) : std::vector<Vec3>();
        const bool may_turn = caps.empty() || !is_along(best.candidate.plane.normal, caps);
        const RefinedPlane found =
            refined_plane(access, piece_, best.candidate.plane, step, context_, is_allowed, may_turn);
        if (found.plane == best.candidate.plane) return;
        const std::optional<Nudged> nudged = nudge(piece_, found.plane.normal, {&found.plane.offset, 1}).front();
        if (!nudged || !is_allowed({found.plane.normal, nudged->offset})) return;
        const bool was_given = best.candidate.normal_index == given_index;
        EvaluatedPlane refined = evaluated_alone({{found.plane.normal, nudged->offset},
                                                  found.plane.offset,
                                                  was_given ? refined_given_index : refined_index,
                                                  was_given ? best.candidate.offset_index : refined_index});
        if (!refined.evaluation || refined.evaluation->solids.size() != 2) return;
        access_.refined = std::move(refined);
    }

    void add(std::vector<Ranked>& ranked, const EvaluatedPlane& plane) const {
        const auto one = rank(plane.candidate, plane.evaluation, others_, settings_.objectives, scan_);
        if (one) ranked.push_back(*one);
    }

    std::vector<Ranked> ranking() {
        std::vector<Ranked> ranked = rank(access_.planes, others_, settings_.objectives, scan_);
        for (const Candidate& candidate : further_) {
            const EvaluatedPlane& plane = *further_plane(candidate.plane);
            if (plane.evaluation && is_further_candidate(plane)) add(ranked, plane);
        }
        if (!further_.empty()) sort_ranking(ranked, settings_.objectives);
        return ranked;
    }

    // Of the planes that are taken, and those that setups may choose before them (app/engine/review_cuts.h), the first
    // whose sides are several solids and that was not cut yet.
    EvaluatedPlane* first_in_doubt(const std::vector<Ranked>& ranked) {
        for (std::size_t i = 0; i < std::min(std::max(settings_.beam, min_best_planes), ranked.size()); ++i) {
            EvaluatedPlane& plane = plane_of(ranked[i]);
            if (!plane.is_really_cut && plane.evaluation->solids.size() > 2) return &plane;
        }
        return nullptr;
    }

    void cut_really(EvaluatedPlane& plane) {
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
    OrientedBox cutting_box_;
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
