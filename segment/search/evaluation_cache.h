// What was found out about pieces, each thing once per piece: its box, its share, the evaluations of all its
// candidates.
//
// A piece is known by its mesh, so all BSPs of a beam share what is known of it. Evaluations hold for every weight and
// threshold: a change of those ranks anew and evaluates nothing (tests/segment/search/evaluation_cache_test.cpp).

#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "base/context.h"
#include "segment/mesh/oriented_box.h"
#include "segment/score/candidates.h"
#include "segment/score/objectives.h"
#include "segment/search/segmentation.h"

namespace qchopper {

// The ingredients of every ranking of one piece.
struct PieceEvaluations {
    std::vector<Candidate> candidates;
    std::vector<std::optional<CutEvaluation>> evaluations;  // one per candidate; nothing: the plane misses
};

// Where evaluations outlive the program (evaluation_store.h). Both may be empty; called from one thread.
struct EvaluationStore {
    std::function<std::optional<PieceEvaluations>(const Piece&)> find;
    std::function<void(const Piece&, const PieceEvaluations&)> keep;
};

class EvaluationCache {
 public:
    EvaluationCache(const Objectives& objectives, const CandidateOptions& options, EvaluationStore store = {});

    const OrientedBox& box(const Piece& piece);
    const SolidEvaluation& own(const Piece& piece);

    // All that were not evaluated yet, at once, so that all cores are busy. Afterwards evaluations() answers for each.
    void evaluate(std::span<const Piece* const> pieces, const Context& context);
    const PieceEvaluations& evaluations(const Piece& piece) const;
    bool is_evaluated(const Piece& piece) const;

    // One plane that is no candidate, such as the operator's own. Not kept.
    std::optional<CutEvaluation> evaluation_of(const Piece& piece, const Candidate& plane, const Context& context);

    // How many pieces were evaluated and how many boxes were searched since the book was opened.
    std::size_t evaluated_count() const { return evaluated_count_; }
    std::size_t box_count() const { return box_count_; }

    // Forgets every piece that none of the segmentations holds.
    void keep_only(std::span<const Segmentation* const> segmentations);

 private:
    struct Entry {
        std::shared_ptr<const TriangleMesh> mesh;  // keeps the key from being used again
        std::optional<OrientedBox> box;
        std::optional<SolidEvaluation> own;
        std::shared_ptr<const PieceEvaluations> evaluations;
    };

    Entry& entry(const Piece& piece);
    bool is_known(const Piece& piece, Entry& entry);
    std::vector<Candidate> candidates_of(const Piece& piece, const OrientedBox& box) const;

    Objectives objectives_;
    CandidateOptions options_;
    EvaluationStore store_;
    std::map<const TriangleMesh*, Entry> entries_;
    std::size_t evaluated_count_ = 0;
    std::size_t box_count_ = 0;
};

}  // namespace qchopper
