// Glue between pieces and accessibility.h; the cost is that of the rays.

#include "segment/access/sampled_piece.h"

#include <cassert>
#include <utility>

#include "segment/mesh/oriented_box.h"

namespace qchopper {
namespace {

std::vector<Vec3> points_of(std::span<const Piece> pieces) {
    std::vector<Vec3> points;
    for (const Piece& piece : pieces) {
        points.insert(points.end(), piece.mesh->points.begin(), piece.mesh->points.end());
    }
    return points;
}

}  // namespace

SampledPiece sampled_alone(const Piece& piece, std::vector<Vec3> directions, std::size_t samples) {
    const Piece alone{piece.name, piece.mesh, {}};
    SampledScanOptions options;
    options.samples = samples;
    options.is_left_out.emplace_back(piece.mesh->triangles.size());
    for (std::size_t t = 0; t < piece.mesh->triangles.size(); ++t) {
        options.is_left_out.front()[t] = cap_of(*piece.mesh, t) != no_cap || is_ignored(*piece.mesh, t);
    }
    const auto scan = std::make_shared<SampledScan>(sampled_scan({&alone, 1}, std::move(directions), options));
    return {scan, std::move(uncut_accessibility(*scan).front()), owned_caps(piece)};
}

void sample_uncut(std::span<Piece> uncut, const DistanceStore& store, std::size_t count) {
    if (uncut.empty()) return;
    SampledScanOptions options;
    options.samples = count;
    for (const Piece& piece : uncut) {
        options.is_left_out.emplace_back(piece.mesh->ignored.begin(), piece.mesh->ignored.end());
    }
    const auto axes = oriented_box(points_of(uncut)).axis;
    const auto scan = std::make_shared<const SampledScan>(sampled_scan(uncut, tool_directions(axes), options));
    if (scan->samples.sample.empty()) return;  // all surface is ignored but that of fragments
    std::optional<std::vector<PieceAccessibility>> pieces;
    if (store.find) pieces = store.find(*scan);
    if (!pieces) {
        pieces = uncut_accessibility(*scan);
        if (store.keep) store.keep(*scan, *pieces);
    }
    assert(pieces->size() == uncut.size());
    for (std::size_t i = 0; i < uncut.size(); ++i) {
        uncut[i].samples = std::make_shared<const SampledPiece>(SampledPiece{scan, std::move((*pieces)[i]), {}});
    }
}

void sample_parts(const Piece& parted, CutPieces& made) {
    if (!parted.samples) return;
    const std::shared_ptr<const SampledScan>& scan = parted.samples->scan;
    std::vector<PieceAccessibility> parts = cut_accessibility(*scan, parted.samples->accessibility, made);
    for (std::size_t i = 0; i < made.pieces.size(); ++i) {
        Piece& part = made.pieces[i];
        part.samples = std::make_shared<const SampledPiece>(SampledPiece{scan, std::move(parts[i]), owned_caps(part)});
    }
}

double scan_area_mm2(const Piece& piece) {
    assert(piece.samples);
    const SurfaceSamples& samples = piece.samples->scan->samples;
    return samples.area_each_mm2 * static_cast<double>(samples.sample.size());
}

}  // namespace qchopper
