// Keeps what is computed for pieces, each once per piece: the box, the evaluation of the piece itself, the evaluations
// of all its candidates.
//
// The key is the mesh of a piece, so all BSPs of a beam share the entries. Evaluations hold for all weights and
// thresholds: a change of those ranks again and evaluates nothing (tests/segment/search/evaluation_cache_test.cpp). All
// functions are called from one thread.

#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "base/context.h"
#include "segment/mesh/oriented_box.h"
#include "segment/objectives/objectives.h"
#include "segment/search/candidates/evaluated_plane.h"
#include "segment/search/segmentation.h"

namespace qchopper {

// The evaluations from which a piece is ranked.
struct PieceEvaluations {
    std::vector<Candidate> candidates;
    std::vector<std::optional<CutEvaluation>> evaluations;  // one per candidate; nothing: the plane misses
};

// What is known of the planes of a piece that are ranked by reach (access_rank.h). Areas in mm2, of both sides.
struct AccessEvaluations {
    std::vector<Vec3> normals;                         // none: not swept yet
    std::vector<std::vector<double>> unreachable_mm2;  // per normal and offset
    std::vector<PlanesOfNormal> planes;                // the same; not nudged so long as nothing is evaluated
    std::vector<EvaluatedPlane> further;               // planes along none of the normals
    std::optional<Plane> refined_from;                 // the best plane, if it was refined
    std::optional<EvaluatedPlane> refined;             // the best plane moved and turned; nothing: it leaves no less
    Objectives objectives;                             // with these, and for so many best planes
    std::size_t best = 0;
    std::set<std::pair<std::size_t, std::size_t>> for_size;  // the candidates of a piece that is too large
};

// Orders planes that are equal bit for bit.
struct PlaneOrder {
    bool operator()(const Plane& a, const Plane& b) const {
        return std::tie(a.normal.x, a.normal.y, a.normal.z, a.offset) <
               std::tie(b.normal.x, b.normal.y, b.normal.z, b.offset);
    }
};
// Per plane what its cut would make, as far as the oriented boxes of the parts count; nothing: it misses.
using OwnBoxes = std::map<Plane, std::optional<CutEvaluation>, PlaneOrder>;

// Where evaluations are kept beyond the end of the program (app/store/caches/evaluation_store.h). Both functions may be
// empty; they are called from one thread.
struct EvaluationStore {
    std::function<std::optional<PieceEvaluations>(const Piece&)> find;  // nothing: not stored
    std::function<void(const Piece&, const PieceEvaluations&)> keep;
};

class EvaluationCache {
 public:
    EvaluationCache(const Objectives& objectives, const CandidateOptions& options, EvaluationStore store = {});

    // References stay valid until keep_only() removes the piece.
    const OrientedBox& box(const Piece& piece);
    const SolidEvaluation& solid_evaluation(const Piece& piece);  // of the piece as it is: measure() in evaluate.h

    // Of area_on_best_base (segment/access/piece_access.h); 0 of a piece without samples.
    double unreachable_mm2(const Piece& piece, double tilt_deg);
    // Of a piece that has samples; access_rank.h fills it.
    AccessEvaluations& access(const Piece& piece) { return entry(piece).access; }
    // late_rank.h fills them: the candidates, evaluated only as far as needed. Empty: not swept yet.
    std::vector<PlanesOfNormal>& late(const Piece& piece) { return entry(piece).late; }
    OwnBoxes& own_boxes(const Piece& piece) { return entry(piece).own_boxes; }
    // The planes that are proposed for a piece.
    std::vector<Candidate> candidates(const Piece& piece);

    // Evaluates all of the pieces that are neither evaluated nor stored, together, so that all cores are busy.
    // Afterwards evaluations() may be called for each; it must not be called before. Throws Cancelled, and then keeps
    // no new evaluation.
    void evaluate(std::span<const Piece* const> pieces, const Context& context);
    const PieceEvaluations& evaluations(const Piece& piece) const;
    bool is_evaluated(const Piece& piece) const;

    // Evaluations of further planes, which are kept like the others: one per plane, nothing where it misses.
    // Preconditions as in evaluate_all (evaluate.h).
    std::vector<std::optional<CutEvaluation>> further_evaluations(const Piece& piece, std::span<const Candidate> planes,
                                                                  const Context& context);

    // Evaluates one plane that is no candidate, such as one given by the operator. Not kept. Preconditions as in
    // evaluate_all (evaluate.h).
    std::optional<CutEvaluation> evaluation_of(const Piece& piece, const Candidate& plane, const Context& context);

    // How many pieces were evaluated and how many boxes computed by this cache.
    std::size_t evaluated_count() const { return evaluated_count_; }
    std::size_t box_count() const { return box_count_; }

    // Removes every piece that is in none of the segmentations.
    void keep_only(std::span<const Segmentation* const> segmentations);

 private:
    struct Entry {
        std::shared_ptr<const TriangleMesh> mesh;  // held so that its address, the key, is not used again
        std::optional<OrientedBox> box;
        std::optional<SolidEvaluation> solid;
        std::shared_ptr<const PieceEvaluations> evaluations;
        PieceEvaluations further;
        std::optional<double> unreachable_mm2;
        AccessEvaluations access;
        std::vector<PlanesOfNormal> late;
        OwnBoxes own_boxes;
    };

    Entry& entry(const Piece& piece);
    bool is_known(const Piece& piece, Entry& entry);

    Objectives objectives_;
    CandidateOptions options_;
    EvaluationStore store_;
    std::map<const TriangleMesh*, Entry> entries_;
    std::size_t evaluated_count_ = 0;
    std::size_t box_count_ = 0;
};

}  // namespace qchopper
