// Adds to the sweep what only some objectives need: the boxes of the parts, and the lengths of the outlines.
//
// mm. Both are linear in clusters, points of clusters that reach over several slabs, and crossings. Equal to measuring
// the halves of a cut to 1e-9 (tests/segment/objectives/sweep/chopper_test.cpp).

#pragma once

#include <optional>
#include <span>
#include <vector>

#include "segment/cut/cut_evaluation.h"
#include "segment/objectives/sweep/section.h"

namespace qchopper {

// Gives the components of the slabs and the loops of the section their boxes along prepared.sizes.axis. A loop's box,
// of its crossings, is the same above and below. Preconditions: `slabs` and `section` of these offsets.
void add_boxes(const PreparedPiece& prepared, Vec3 normal, std::span<const double> offsets, Slabs& slabs,
               Section& section);

// What a mm of seam costs at a point of the piece's mesh.
inline double seam_cost(const Piece& piece, std::uint32_t point) {
    return piece.seam_cost ? static_cast<double>((*piece.seam_cost)[point]) : 1;
}

// The length of one part of an outline: of a crossed triangle, from one edge to another. Along caps it is 0, because
// the seam is inside the specimen there. `a` and `b`: what a mm costs at its ends.
inline double seam_part(const Piece& piece, std::uint32_t triangle, double length, double a, double b) {
    return cap_of(*piece.mesh, triangle) == no_cap ? length * (a + b) / 2 : 0;
}

// Fills in seam_mm of the evaluations, one per offset.
void add_seams(const Piece& piece, const Slabs& slabs, const Section& section, std::span<const double> offsets,
               std::span<std::optional<CutEvaluation>> evaluations);

}  // namespace qchopper
