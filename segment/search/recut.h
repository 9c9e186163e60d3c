// Makes one cut of a segmentation along another plane, as if it had been chosen at once.
//
// Possible where nothing was cut of what the cut made: the cuts after it are of other pieces then, and stay as they
// are, bit for bit. Tests: tests/segment/search/recut_test.cpp.

#pragma once

#include <optional>

#include "segment/search/segmentation.h"

namespace qchopper {

// The piece alone with one cut, whose pieces have the names that they have in the whole segmentation. `piece` is the
// piece that the cut with by.number divides in the segmentation, as it was before. Nothing: the plane misses it.
// Preconditions: is_last_of_its_pieces (cut_list.h); by.piece is the name of the piece.
std::optional<Segmentation> cut_alone(const Segmentation& segmentation, const Piece& piece, Cut by,
                                      double fragment_volume_mm3);

// The segmentation with the cut of `alone`, a result of cut_alone() with it, in place of its own: the same as to apply
// all cuts to the scan. Pieces of other cuts share their meshes with those of before. Precondition: no piece was
// discarded after this cut or a later one. O(cuts log cuts + pieces).
Segmentation recut(Segmentation segmentation, const Segmentation& alone);

}  // namespace qchopper
