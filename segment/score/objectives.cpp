// Ratios and sums over the pieces: O(pieces * bases).

#include "segment/score/objectives.h"

#include <algorithm>
#include <cassert>

namespace qchopper {

double undercut(const BaseShare& share, bool by_area) {
    const double all = by_area ? share.all_mm2 : share.all_count;
    return all > 0 ? (by_area ? share.down_mm2 : share.down_count) / all : 0;
}

double undercut(const SolidEvaluation& solid, bool by_area) {
    if (solid.bases.empty()) return 0.5;
    double least = undercut(solid.bases.front(), by_area);
    for (const BaseShare& base : solid.bases) least = std::min(least, undercut(base, by_area));
    return least;
}

PieceShare share(const SolidEvaluation& solid, const Objectives& objectives) {
    return {solid.faces, undercut(solid, objectives.undercut_by_area), 0};
}

std::optional<Terms> terms(const CutEvaluation& evaluation, std::span<const PieceShare> others,
                           const Objectives& objectives) {
    std::vector<PieceShare> pieces;
    for (const SolidEvaluation& solid : evaluation.solids) {
        if (solid.volume_mm3 >= objectives.fragment_volume_mm3) pieces.push_back(share(solid, objectives));
    }
    const std::size_t made = pieces.size();
    if (made < 2 || evaluation.cap_area_mm2 <= 0) return std::nullopt;
    // Before those made, so that sums are taken in the order of the segmentation.
    if (objectives.scope == TermScope::whole) pieces.insert(pieces.begin(), others.begin(), others.end());
    std::size_t most = pieces.front().faces;
    std::size_t fewest = most;
    double undercut_sum = 0;
    for (const PieceShare& piece : pieces) {
        most = std::max(most, piece.faces);
        fewest = std::min(fewest, piece.faces);
        undercut_sum += piece.undercut;
    }
    Terms result;
    assert(fewest <= most);
    const double ratio = static_cast<double>(most) / static_cast<double>(fewest);
    result.face_ratio = std::max(ratio - objectives.face_ratio_threshold, 0.0);
    result.fragility = evaluation.fragility;
    result.piece_count = static_cast<double>(made) - 2;
    result.undercut = undercut_sum / static_cast<double>(pieces.size());
    if (evaluation.reach) {
        double unreachable = evaluation.reach->unreachable_mm2;
        for (const PieceShare& other : others) unreachable += other.unreachable_mm2;
        result.unreachable = unreachable / evaluation.reach->scan_area_mm2;
    }
    const Weights& w = objectives.weights;
    result.total = w.face_ratio * result.face_ratio + w.fragility * result.fragility +
                   w.piece_count * result.piece_count + w.undercut * result.undercut +
                   w.unreachable * result.unreachable;
    return result;
}

}  // namespace qchopper
