// A merge of sorted lists: the children of every BSP are ordered by cost, so the cheapest of all heads is taken until
// the round is full. O(beam) per BSP taken, besides cutting it.

#include "segment/search/beam.h"

#include <algorithm>
#include <tuple>

#include "base/error.h"
#include "segment/access/sampled_piece.h"
#include "segment/search/trial.h"

namespace qchopper {
namespace {

double of_cuts(const Segmentation& segmentation, const Objectives& objectives) {
    const Weights& w = objectives.weights;
    double sum = 0;
    for (const Cut& cut : segmentation.cuts) {
        const Terms& terms = cut.chosen.terms;
        sum += w.fragility * terms.fragility + w.piece_count * terms.piece_count;
        sum += w.utilization * terms.utilization + w.connector * terms.connector + w.symmetry * terms.symmetry +
               w.structure * terms.structure;
        if (objectives.scope == TermScope::cut) sum += w.face_ratio * terms.face_ratio + w.undercut * terms.undercut;
    }
    return sum;
}

double of_reach(const Segmentation& segmentation, const Objectives& objectives, EvaluationCache& cache) {
    if (objectives.weights.unreachable == 0 || !segmentation.pieces.front().samples) return 0;
    double sum = 0;
    for (const Piece& piece : segmentation.pieces) sum += cache.unreachable_mm2(piece, objectives.tilt_deg);
    return objectives.weights.unreachable * sum / scan_area_mm2(segmentation.pieces.front());
}

// Parts and seam: what all pieces and all cuts cost together.
double of_print(const Segmentation& segmentation, const Objectives& objectives, EvaluationCache& cache) {
    if (!objectives.needs_sizes() && !objectives.needs_seam()) return 0;
    const ScanShare scan = scan_share(segmentation, segmentation.pieces.size(), objectives, cache);
    double boxes = 0;
    for (std::size_t p = 0; p < segmentation.pieces.size() && objectives.needs_sizes(); ++p) {
        boxes += print_boxes(cache.box(segmentation.pieces[p]).size(), objectives);
    }
    const Weights& w = objectives.weights;
    return w.parts * boxes / scan.boxes +
           (objectives.needs_seam() ? w.seam * scan.seam_mm / (scan.diagonal_mm * scan.boxes) : 0);
}

double of_pieces(const Segmentation& segmentation, const Objectives& objectives, EvaluationCache& cache) {
    if (segmentation.pieces.empty()) return 0;
    const double reach = of_reach(segmentation, objectives, cache) + of_print(segmentation, objectives, cache);
    if (objectives.scope == TermScope::cut) return reach;
    std::size_t most = 0;
    std::size_t fewest = segmentation.pieces.front().mesh->triangles.size();
    double undercuts = 0;
    for (const Piece& piece : segmentation.pieces) {
        const PieceShare s = share(cache.solid_evaluation(piece), objectives);
        most = std::max(most, s.faces);
        fewest = std::min(fewest, s.faces);
        undercuts += s.undercut;
    }
    const double ratio = static_cast<double>(most) / static_cast<double>(fewest);
    return objectives.weights.face_ratio * std::max(ratio - objectives.face_ratio_threshold, 0.0) +
           objectives.weights.undercut * undercuts / static_cast<double>(segmentation.pieces.size()) + reach;
}

// The head of one list of the merge: a BSP that ended, or else one child of a BSP.
struct Head {
    std::size_t bsp = 0;
    std::size_t child = 0;
    double cost = 0;
    int normal_index = -1;
    int offset_index = -1;
    bool is_forbidden = false;
};

bool is_before(const Head& a, const Head& b) {
    if (a.is_forbidden != b.is_forbidden) return b.is_forbidden;
    if (a.cost + tie < b.cost) return true;
    if (b.cost + tie < a.cost) return false;
    return std::tie(a.normal_index, a.offset_index, a.bsp) < std::tie(b.normal_index, b.offset_index, b.bsp);
}

Head head(const std::vector<Bsp>& beam, std::size_t i, std::size_t child, const Objectives& objectives) {
    if (!beam[i].is_live()) return {i, child, beam[i].cost, -1, -1, false};
    const Ranked& r = beam[i].ranked[beam[i].children[child]];
    return {
        i, child, beam[i].of_cuts + r.terms.total, r.normal_index, r.offset_index, is_forbidden(r.terms, objectives)};
}

// A cut differs from its evaluation, and may fail, only where the scan intersects itself.
std::optional<Segmentation> cut_once(const Segmentation& segmentation, const Cut& cut, double fragment_volume_mm3) {
    Segmentation child = segmentation;
    if (!apply(child, cut, fragment_volume_mm3)) return std::nullopt;
    return child;
}

// The trials of one BSP in one round.
struct Trials {
    std::size_t count = 0;
    std::optional<RevertedTrial> nearest;  // the one that left least out of reach; the first of several
};

std::optional<Segmentation> better_by_trial(const Segmentation& segmentation, const Cut& first, Trials& trials,
                                            const SearchSettings& settings, StopJudge& judge, EvaluationCache& cache,
                                            const Context& context) {
    std::optional<Trial> trial = try_cuts(segmentation, first, settings, judge, cache, context);
    if (!trial) return std::nullopt;
    ++trials.count;
    if (trial->better) return std::move(trial->better);
    if (!trials.nearest || trial->reverted.after_mm2 < trials.nearest->after_mm2) trials.nearest = trial->reverted;
    return std::nullopt;
}

}  // namespace

double cost(const Segmentation& segmentation, const Objectives& objectives, EvaluationCache& cache) {
    return of_cuts(segmentation, objectives) + of_pieces(segmentation, objectives, cache);
}

Bsp bsp(Segmentation segmentation, std::vector<std::string> passed_over, std::vector<RevertedTrial> reverted,
        const Objectives& objectives, EvaluationCache& cache) {
    Bsp b;
    b.segmentation = std::move(segmentation);
    b.passed_over = std::move(passed_over);
    b.reverted = std::move(reverted);
    b.of_cuts = of_cuts(b.segmentation, objectives);
    b.cost = b.of_cuts + of_pieces(b.segmentation, objectives, cache);
    return b;
}

std::vector<Bsp> next_round(std::vector<Bsp> beam, const SearchSettings& settings, StopJudge& judge,
                            EvaluationCache& cache, const Context& context) {
    std::vector<Head> heads;
    for (std::size_t i = 0; i < beam.size(); ++i) heads.push_back(head(beam, i, 0, settings.objectives));
    std::vector<Bsp> kept;
    std::vector<bool> has_child(beam.size(), false);
    std::vector<Trials> trials(beam.size());
    while (kept.size() < settings.beam && !heads.empty()) {
        const auto best = std::min_element(heads.begin(), heads.end(), is_before);
        const Head taken = *best;
        Bsp& parent = beam[taken.bsp];
        if (!parent.is_live()) {
            heads.erase(best);
            kept.push_back(std::move(parent));
            continue;
        }
        const Cut cut =
            cut_by(parent.segmentation, *parent.next.piece, parent.ranked, parent.children[taken.child], settings);
        std::optional<Segmentation> child =
            parent.next.is_trial
                ? better_by_trial(parent.segmentation, cut, trials[taken.bsp], settings, judge, cache, context)
                : cut_once(parent.segmentation, cut, settings.objectives.fragment_volume_mm3);
        if (child) {
            kept.push_back(bsp(std::move(*child), parent.passed_over, parent.reverted, settings.objectives, cache));
            has_child[taken.bsp] = true;
        }
        if (taken.child + 1 < parent.children.size() && trials[taken.bsp].count < settings.beam) {
            *best = head(beam, taken.bsp, taken.child + 1, settings.objectives);
            continue;
        }
        heads.erase(best);
        if (has_child[taken.bsp]) continue;
        parent.passed_over.push_back(parent.segmentation.pieces[*parent.next.piece].name);
        if (trials[taken.bsp].nearest) parent.reverted.push_back(*trials[taken.bsp].nearest);
        parent.ranked.clear();
        kept.push_back(std::move(parent));
    }
    // The cost of a trial's child is known only when its last cut is made.
    if (std::any_of(trials.begin(), trials.end(), [](const Trials& t) { return t.count > 0; })) {
        std::stable_sort(kept.begin(), kept.end(), [](const Bsp& a, const Bsp& b) { return a.cost < b.cost; });
    }
    return kept;
}

std::vector<Segmentation> grow(const BeamState& state, const Segmentation& root, double fragment_volume_mm3) {
    std::vector<Segmentation> grown;
    for (const BeamState::Node& node : state.cuts) {
        Segmentation segmentation = node.after == 0 ? root : grown[node.after - 1];
        if (!apply(segmentation, node.cut, fragment_volume_mm3)) {
            throw InputError(InputFault::config,
                             "cut " + std::to_string(node.cut.number) +
                                 " of the beam in project.json does not part piece " + node.cut.piece,
                             "restore the file, or prepare the scan again");
        }
        grown.push_back(std::move(segmentation));
    }
    return grown;
}

}  // namespace qchopper
