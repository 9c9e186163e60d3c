// Holds a segmentation: the cuts made so far, in order, and the pieces that they leave.
//
// mm. Cuts and pieces form a binary space partition (Nicholson 2016, section 3): every cut divides one piece into two
// or more. Pieces, fragments and discarded pieces together have the volume of the scan
// (tests/segment/search/search_test.cpp).

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "segment/cut/piece.h"
#include "segment/objectives/objectives.h"
#include "segment/search/candidates/candidates.h"

namespace qchopper {

// A candidate that was ranked for a cut, with its terms.
struct Ranked {
    Plane plane;
    double wanted_offset = 0;
    int normal_index = 0;  // as in Candidate
    int offset_index = 0;
    Terms terms;
    double seam_mm = 0;                 // CutEvaluation::seam_mm, which later cuts need
    std::uint32_t coarse_sections = 0;  // as in CutEvaluation
    bool operator==(const Ranked&) const = default;
};

// The method that proposed a plane, which is a given one or was moved from one; empty: none.
std::string proposer_of(const Ranked& plane, const CandidateOptions& candidates);

// One decision. The plane is applied exactly as recorded, never nudged again.
struct Cut {
    std::int32_t number = 0;  // 1, 2, ...
    std::string piece;        // name of the piece that it divides
    Ranked chosen;
    std::vector<Ranked> runners_up;   // the next best, best first
    std::size_t candidates = 0;       // how many planes were ranked
    std::vector<std::string> pieces;  // names of those that it made
    std::size_t fragments = 0;        // how many it made
    bool operator==(const Cut&) const = default;
};

// A solid too small to be a piece.
struct Fragment {
    std::int32_t cut = 0;  // number of the cut that made it; 0: it was in the scan
    double volume_mm3 = 0;
    Vec3 centre;  // of its box
    std::shared_ptr<const TriangleMesh> mesh;
};

// A piece that the operator decided not to mill.
struct Discarded {
    std::size_t after = 0;  // number of cuts that were made before
    Piece piece;
};

// What the objectives of Chopper need of the uncut scan: measure_scan().
struct UncutScan {
    double diagonal_mm = 0;            // of the oriented box of all solids that are no fragments
    std::vector<Vec3> solid_sizes_mm;  // of the oriented box of each
};

// What the operator must know of a segmentation, as one sentence.
struct SegmentationWarning {
    std::int32_t cut = 0;  // number of the cut that it is of; 0: of none
    std::string text;
    bool operator==(const SegmentationWarning&) const = default;
};

struct Segmentation {
    std::vector<Cut> cuts;
    std::vector<Piece> pieces;  // the leaves, in the order of their names
    std::vector<Fragment> fragments;
    std::vector<Discarded> discarded;           // in the order of the decisions
    std::size_t names_given = 0;                // the next piece is piece_name(names_given), piece_names.h
    std::vector<SegmentationWarning> warnings;  // in the order in which they arose
    UncutScan scan;                             // empty: not measured, because no objective needs it
};

// The sentences of the warnings from the one with index `from` on.
std::vector<std::string> texts(const std::vector<SegmentationWarning>& warnings, std::size_t from = 0);

// The number of the cut that made a piece; 0: it was in the scan.
std::int32_t made_by(const Piece& piece);

// The uncut scan as a segmentation: every solid is a piece, or a fragment if it is smaller than fragment_volume_mm3.
// Precondition: a closed mesh. Points and triangles of the pieces are in memory order (order.h).
Segmentation uncut(const TriangleMesh& scan, double fragment_volume_mm3);

// Precondition: no cut was made yet. O(points).
UncutScan measure_scan(const Segmentation& uncut);

// Cuts the piece cut.piece along cut.chosen.plane and adds the cut, with the pieces and fragments that it makes filled
// in. If the piece has samples, those that it makes have them too. Returns false, and changes nothing, if there is no
// such piece or the plane misses it. Throws InputError if the piece is open.
bool apply(Segmentation& segmentation, Cut cut, double fragment_volume_mm3);

// Moves a piece to `discarded`, with a warning that states its volume. Returns false, and changes nothing, if there is
// no such piece or it is the only one.
bool discard(Segmentation& segmentation, const std::string& piece);

}  // namespace qchopper
