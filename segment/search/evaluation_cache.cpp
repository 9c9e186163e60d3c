// A map from the address of a mesh to its entry. Boxes and candidates of several pieces are computed in parallel, then
// their sweeps. O(log pieces) for what is there already.

#include "segment/search/evaluation_cache.h"

#include <algorithm>
#include <cassert>
#include <iterator>
#include <set>

#include "base/parallel.h"
#include "base/shared_progress.h"
#include "base/timings.h"
#include "segment/access/piece_access.h"
#include "segment/search/candidates/evaluate.h"

namespace qchopper {

EvaluationCache::EvaluationCache(const Objectives& objectives, const CandidateOptions& options, EvaluationStore store)
    : objectives_(objectives), options_(options), store_(std::move(store)) {}

EvaluationCache::Entry& EvaluationCache::entry(const Piece& piece) {
    Entry& e = entries_[piece.mesh.get()];
    e.mesh = piece.mesh;
    return e;
}

const OrientedBox& EvaluationCache::box(const Piece& piece) {
    Entry& e = entry(piece);
    if (!e.box) {
        e.box = oriented_box(piece.mesh->points);
        ++box_count_;
    }
    return *e.box;
}

std::vector<Candidate> EvaluationCache::candidates(const Piece& piece) {
    return candidate_planes(piece, box(piece), options_);
}

const SolidEvaluation& EvaluationCache::solid_evaluation(const Piece& piece) {
    Entry& e = entry(piece);
    if (!e.solid) e.solid = measure(piece);
    return *e.solid;
}

double EvaluationCache::unreachable_mm2(const Piece& piece, double tilt_deg) {
    if (!piece.samples) return 0;
    Entry& e = entry(piece);
    if (!e.unreachable_mm2) e.unreachable_mm2 = area_on_best_base(piece, tilt_deg).unreachable_mm2;
    return *e.unreachable_mm2;
}

bool EvaluationCache::is_known(const Piece& piece, Entry& e) {
    if (e.evaluations) return true;
    if (!store_.find) return false;
    if (std::optional<PieceEvaluations> found = store_.find(piece)) {
        e.evaluations = std::make_shared<const PieceEvaluations>(std::move(*found));
    }
    return e.evaluations != nullptr;
}

void EvaluationCache::evaluate(std::span<const Piece* const> pieces, const Context& context) {
    const StageTimer stage(context, "planes evaluated");
    struct Task {
        const Piece* piece;
        Entry* entry;
        PieceEvaluations evaluations;
    };
    std::vector<Task> tasks;
    for (const Piece* piece : pieces) {
        Entry& e = entry(*piece);
        if (is_known(*piece, e)) continue;
        if (!e.box) ++box_count_;
        tasks.push_back({piece, &e, {}});
    }
    if (tasks.empty()) return;
    context.progress("pieces evaluated", 0, tasks.size());
    parallel_for(0, tasks.size(), [&](std::size_t i) {
        context.check_cancelled();
        Task& task = tasks[i];
        if (!task.entry->box) task.entry->box = oriented_box(task.piece->mesh->points);
        task.evaluations.candidates = candidate_planes(*task.piece, *task.entry->box, options_);
    });
    std::size_t planes = 0;
    for (const Task& task : tasks) planes += task.evaluations.candidates.size();
    SharedProgress progress(context, "planes evaluated", planes);
    parallel_for(0, tasks.size(), [&](std::size_t i) {
        Task& task = tasks[i];
        task.evaluations.evaluations = evaluate_all(*task.piece, task.evaluations.candidates, objectives_,
                                                    progress.of_part(), &task.entry->box->axis);
    });
    for (Task& task : tasks) {
        if (store_.keep) store_.keep(*task.piece, task.evaluations);
        task.entry->evaluations = std::make_shared<const PieceEvaluations>(std::move(task.evaluations));
        ++evaluated_count_;
    }
}

bool EvaluationCache::is_evaluated(const Piece& piece) const {
    const auto found = entries_.find(piece.mesh.get());
    return found != entries_.end() && found->second.evaluations != nullptr;
}

const PieceEvaluations& EvaluationCache::evaluations(const Piece& piece) const {
    assert(is_evaluated(piece));
    return *entries_.at(piece.mesh.get()).evaluations;
}

std::vector<std::optional<CutEvaluation>> EvaluationCache::further_evaluations(const Piece& piece,
                                                                               std::span<const Candidate> planes,
                                                                               const Context& context) {
    PieceEvaluations& known = entry(piece).further;
    const auto place = [&](const Candidate& plane) {
        return std::find_if(known.candidates.begin(), known.candidates.end(),
                            [&](const Candidate& c) { return c.plane == plane.plane; }) -
               known.candidates.begin();
    };
    std::vector<Candidate> fresh;
    for (const Candidate& plane : planes) {
        if (place(plane) == std::ssize(known.candidates)) fresh.push_back(plane);
    }
    if (!fresh.empty()) {
        const StageTimer stage(context, "planes evaluated");
        std::vector<std::optional<CutEvaluation>> evaluated =
            evaluate_all(piece, fresh, objectives_, context, &box(piece).axis);
        known.candidates.insert(known.candidates.end(), fresh.begin(), fresh.end());
        known.evaluations.insert(known.evaluations.end(), evaluated.begin(), evaluated.end());
    }
    std::vector<std::optional<CutEvaluation>> result;
    for (const Candidate& plane : planes) result.push_back(known.evaluations[static_cast<std::size_t>(place(plane))]);
    return result;
}

std::optional<CutEvaluation> EvaluationCache::evaluation_of(const Piece& piece, const Candidate& plane,
                                                            const Context& context) {
    const std::array<Vec3, 3>* axes = objectives_.needs_sizes() ? &box(piece).axis : nullptr;
    return evaluate_all(piece, std::span(&plane, 1), objectives_, context, axes).front();
}

void EvaluationCache::keep_only(std::span<const Segmentation* const> segmentations) {
    std::set<const TriangleMesh*> held;
    for (const Segmentation* s : segmentations) {
        for (const Piece& piece : s->pieces) held.insert(piece.mesh.get());
    }
    std::erase_if(entries_, [&](const auto& e) { return !held.contains(e.first); });
}

}  // namespace qchopper
