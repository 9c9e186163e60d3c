// A piece with samples of its surface and the directions along which they are open.
//
// mm. The pieces of an uncut scan share one set of samples and rays, which every cut updates (accessibility.h); a piece
// can also have samples of its own. Both state the same of a piece, each with the error of its number of samples
// (tests/segment/access/sampled_piece_test.cpp).

#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "segment/access/unreachable.h"

namespace qchopper {

struct SampledPiece {
    std::shared_ptr<const SampledScan> scan;  // not null
    PieceAccessibility accessibility;
    std::vector<OwnedCap> caps;
    JudgedPiece judged() const { return {*scan, accessibility, caps}; }
};

// With samples and rays of its own, its caps and what is ignored left out.
SampledPiece sampled_alone(const Piece& piece, std::vector<Vec3> directions, std::size_t samples);

// Where the distances of an uncut scan are kept beyond the end of the program. Both functions may be empty.
struct DistanceStore {
    // Nothing: not kept. What it returns belongs to the scan: the same solids, samples and directions.
    std::function<std::optional<std::vector<PieceAccessibility>>(const SampledScan&)> find;
    std::function<void(const SampledScan&, const std::vector<PieceAccessibility>&)> keep;
};

// Gives all pieces of an uncut scan samples, `count` in all, with the 264 directions of the octahedron and the axes of
// the box around all of them. Surface that is ignored carries none; if all is, no piece gets samples. Precondition: the
// pieces have no half-spaces. O(triangles) for the trees and count x 264 rays, unless the store has them.
void sample_uncut(std::span<Piece> uncut, const DistanceStore& store = {}, std::size_t count = default_surface_samples);

// Gives the pieces that a cut made of `parted` its samples; nothing if it has none. O(samples x directions + triangles
// of the uncut solid).
void sample_parts(const Piece& parted, CutPieces& made);

// The area of the uncut scan, all its pieces together. Precondition: the piece has samples.
double scan_area_mm2(const Piece& piece);

}  // namespace qchopper
