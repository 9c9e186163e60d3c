// Pieces are found by name, linearly. Cutting costs O(triangles of the piece).

#include "segment/search/segmentation.h"

#include <algorithm>
#include <cassert>
#include <cstdio>

#include "segment/access/sampled_piece.h"
#include "segment/cut/cut_piece.h"
#include "segment/mesh/connectivity/solids.h"
#include "segment/mesh/measure.h"
#include "segment/mesh/order.h"
#include "segment/mesh/oriented_box.h"
#include "segment/objectives/seam_cost.h"
#include "segment/search/piece_names.h"

namespace qchopper {
namespace {

// Adds solids to the pieces or the fragments; returns the names of the new pieces.
std::vector<std::string> add_solids(Segmentation& segmentation, std::vector<Piece> solids, std::int32_t cut_number,
                                    double fragment_volume_mm3) {
    std::vector<std::string> names;
    for (Piece& solid : solids) {
        const double volume = volume_mm3(*solid.mesh);
        if (volume < fragment_volume_mm3) {
            segmentation.fragments.push_back({cut_number, volume, bounds(*solid.mesh).centre(), solid.mesh});
        } else {
            solid.name = piece_name(segmentation.names_given++);
            assert(std::none_of(segmentation.pieces.begin(), segmentation.pieces.end(),
                                [&](const Piece& other) { return other.name == solid.name; }));
            names.push_back(solid.name);
            segmentation.pieces.push_back(std::move(solid));
        }
    }
    return names;
}

}  // namespace

std::vector<std::string> texts(const std::vector<SegmentationWarning>& warnings, std::size_t from) {
    std::vector<std::string> result;
    for (std::size_t i = from; i < warnings.size(); ++i) result.push_back(warnings[i].text);
    return result;
}

std::int32_t made_by(const Piece& piece) {
    return piece.half_spaces.empty() ? 0 : piece.half_spaces.back().cut;
}

Segmentation uncut(const TriangleMesh& scan, double fragment_volume_mm3) {
    Segmentation segmentation;
    std::vector<Piece> solids;
    for (TriangleMesh& mesh : split_solids(in_memory_order(scan), {0, 0, 1})) {
        Piece piece;
        piece.mesh = std::make_shared<const TriangleMesh>(std::move(mesh));
        solids.push_back(std::move(piece));
    }
    add_solids(segmentation, std::move(solids), 0, fragment_volume_mm3);
    return segmentation;
}

UncutScan measure_scan(const Segmentation& uncut) {
    assert(uncut.cuts.empty());
    UncutScan scan;
    std::vector<Vec3> points;
    for (const Piece& piece : uncut.pieces) {
        scan.solid_sizes_mm.push_back(oriented_box(piece.mesh->points).size());
        points.insert(points.end(), piece.mesh->points.begin(), piece.mesh->points.end());
    }
    if (!points.empty()) scan.diagonal_mm = norm(oriented_box(points).size());
    return scan;
}

std::string proposer_of(const Ranked& plane, const CandidateOptions& candidates) {
    if (plane.normal_index != given_index && plane.normal_index != refined_given_index) return {};
    const auto place = static_cast<std::size_t>(plane.offset_index);
    return plane.offset_index >= 0 && place < candidates.given.size() ? candidates.given[place].by : std::string();
}

bool apply(Segmentation& segmentation, Cut cut, double fragment_volume_mm3) {
    const auto piece = std::find_if(segmentation.pieces.begin(), segmentation.pieces.end(),
                                    [&](const Piece& p) { return p.name == cut.piece; });
    if (piece == segmentation.pieces.end()) return false;
    std::optional<CutPieces> made = cut_piece(*piece, cut.chosen.plane, cut.number);
    if (!made) return false;
    sample_parts(*piece, *made);
    pass_on_seam_costs(*piece, *made);
    for (Piece& part : made->pieces) part.stress = piece->stress;
    segmentation.pieces.erase(piece);
    const std::size_t fragments_before = segmentation.fragments.size();
    cut.pieces = add_solids(segmentation, std::move(made->pieces), cut.number, fragment_volume_mm3);
    cut.fragments = segmentation.fragments.size() - fragments_before;
    for (const std::string& warning : made->warnings) {
        segmentation.warnings.push_back({cut.number, "cut " + std::to_string(cut.number) + ": " + warning});
    }
    segmentation.cuts.push_back(std::move(cut));
    return true;
}

bool discard(Segmentation& segmentation, const std::string& name) {
    std::vector<Piece>& pieces = segmentation.pieces;
    const auto piece = std::find_if(pieces.begin(), pieces.end(), [&](const Piece& p) { return p.name == name; });
    if (piece == pieces.end() || pieces.size() == 1) return false;
    char volume[48];
    std::snprintf(volume, sizeof volume, "%.4g ml", volume_mm3(*piece->mesh) / 1000);
    segmentation.warnings.push_back({0, "piece " + name + " (" + volume + ") is discarded and will not be carved"});
    segmentation.discarded.push_back({segmentation.cuts.size(), std::move(*piece)});
    pieces.erase(piece);
    return true;
}

}  // namespace qchopper
