// Ratios and sums over the pieces: O(pieces * bases).

#include "segment/objectives/objectives.h"

#include <algorithm>
#include <cassert>

#include "segment/mesh/boxes_needed.h"

namespace qchopper {
namespace {

constexpr double tolerated_share_of_box = 1e-4;

double wasted(const PieceShare& piece, Vec3 box) {
    return piece.boxes > 0 ? std::max(0.0, 1 - piece.volume_mm3 / (piece.boxes * box.x * box.y * box.z)) : 0;
}

// Parts, utilization, connector, seam and symmetry, as far as they are evaluated.
void add_terms_of_chopper(Terms& result, const CutEvaluation& evaluation, std::span<const PieceShare> made,
                          std::span<const PieceShare> others, const Objectives& objectives, const ScanShare& scan) {
    double boxes = 0;
    double further_boxes = 0;  // of the parts that are made, beyond one of each
    if (objectives.needs_sizes()) {
        for (const PieceShare& piece : made) {
            boxes += piece.boxes;
            further_boxes += piece.boxes - 1;
            result.utilization = std::max(result.utilization, wasted(piece, *objectives.print_volume));
        }
        for (const PieceShare& piece : others) {
            boxes += piece.boxes;
            if (objectives.utilization_scope == TermScope::whole)
                result.utilization = std::max(result.utilization, wasted(piece, *objectives.print_volume));
        }
        result.parts = boxes / scan.boxes;
    }
    result.connector = evaluation.connector;
    if (scan.diagonal_mm > 0) result.symmetry = evaluation.symmetry_mm / scan.diagonal_mm;
    if (objectives.needs_seam() && scan.diagonal_mm > 0) {
        result.seam = (scan.seam_mm + evaluation.seam_mm * (1 + further_boxes)) / (scan.diagonal_mm * scan.boxes);
    }
}

}  // namespace

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
    return {solid.faces, undercut(solid, objectives.undercut_by_area), 0, print_boxes(solid.size, objectives),
            solid.volume_mm3};
}

double print_boxes(Vec3 size, const Objectives& objectives) {
    return objectives.print_volume ? boxes_needed(size, *objectives.print_volume, tolerated_share_of_box) : 0;
}

bool is_forbidden(const Terms& terms, const Objectives& objectives) {
    return std::any_of(objectives.forbidden.begin(), objectives.forbidden.end(), [&](const std::string& key) {
        return std::any_of(all_objectives.begin(), all_objectives.end(), [&](const ObjectiveField& field) {
            return key == field.key && terms.*field.value >= 1 - 1e-12;
        });
    });
}

std::optional<Terms> terms(const CutEvaluation& evaluation, std::span<const PieceShare> others,
                           const Objectives& objectives, const ScanShare& scan) {
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
    if (evaluation.access) {
        double unreachable = evaluation.access->unreachable_mm2;
        for (const PieceShare& other : others) unreachable += other.unreachable_mm2;
        result.unreachable = unreachable / evaluation.access->scan_area_mm2;
    }
    result.structure = evaluation.structure;
    add_terms_of_chopper(result, evaluation, std::span(pieces).last(made), others, objectives, scan);
    result.total = weighted_sum(result, objectives.weights);
    return result;
}

}  // namespace qchopper
