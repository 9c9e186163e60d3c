// Judges a really cut piece: what of its surface no tilting tool reaches. Beside the objective `unreachable`, which
// knows it without cutting, and independent of it: other samples, other directions, rays on the piece's own mesh.
//
// mm2. As docs say what counts (docs/user/setup.md), for a tool of radius zero. Of the search it uses the data types
// only.

#pragma once

#include <cstddef>

#include "segment/cut/piece.h"

namespace qchopper::bench {

struct JudgeOptions {
    double tilt_deg = 60;           // largest tilt of the tool, 0..90
    std::size_t samples = 4'000;    // of the piece's surface, its caps left out
    std::size_t directions = 1000;  // within the tilt of a base's up, the up among them
};

struct PieceVerdict {
    double unreachable_mm2 = 0;  // on the best base
    double area_mm2 = 0;         // of all surface but that base
    double share() const { return area_mm2 > 0 ? unreachable_mm2 / area_mm2 : 0; }
};

// The base is the best of the piece's caps that have at least a tenth of its projected area; without one, the best of
// the six sides of its box. O(samples x directions) rays for each base at worst, in parallel. Precondition: the piece
// is closed.
PieceVerdict judge(const Piece& piece, const JudgeOptions& options);

// Of the triangles that are of no cap.
double uncut_area_mm2(const TriangleMesh& mesh);

}  // namespace qchopper::bench
