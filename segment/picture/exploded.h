// Moves pieces apart for a picture, so that the caps between them show.
//
// Millimetres. Pieces on the two sides of a cut move apart along its normal, never together
// (tests/segment/picture/exploded_test.cpp).

#pragma once

#include <span>
#include <vector>

#include "segment/cut/piece.h"
#include "segment/picture/picture.h"

namespace qchopper {

struct ExplodeOptions {
    double gap = 0.08;         // wanted between neighbours, as a share of the diagonal of the whole
    double min_factor = 0.25;  // a piece moves outwards by its distance from the common centre times the factor
    double max_factor = 0.9;   // limits the factor where a small fragment beside a cut would ask for more
};

// One shift per piece, all by the same factor, away from the common centre. Precondition: no mesh is null.
std::vector<Vec3> exploded_shifts(std::span<const Piece> pieces, const ExplodeOptions& options = {});

// The input of render_png: piece i in piece_colour(i), moved by shifts[i], or in place if there are fewer shifts. The
// meshes stay owned by the pieces.
std::vector<ColouredMesh> coloured(std::span<const Piece> pieces, std::span<const Vec3> shifts = {});

}  // namespace qchopper
