// Pieces drawn apart, so that the caps between them show.
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
    double gap = 0.08;           // wanted between neighbours, as a share of the diagonal of the whole
    double least_factor = 0.25;  // of the way from the common centre to the piece, that it moves further out
    double most_factor = 0.9;    // a fragment beside a cut would drive the others out of the picture
};

// One shift per piece, all of one factor: away from the common centre.
std::vector<Vec3> exploded_shifts(std::span<const Piece> pieces, const ExplodeOptions& options = {});

// What render_png takes: piece i in piece_colour(i), moved by shifts[i]. No shifts: in place.
std::vector<Coloured> coloured(std::span<const Piece> pieces, std::span<const Vec3> shifts = {});

}  // namespace qchopper
