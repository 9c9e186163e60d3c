// A segmentation: the cuts decided so far, in order, and the pieces that they leave.
//
// Cuts and pieces form a binary space partition (Nicholson 2016, section 3): every cut parts one piece into two or
// more. Nothing is lost: pieces, fragments and what was discarded together always have the volume of the scan
// (tests/segment/search/search_test.cpp).

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "segment/cut/piece.h"
#include "segment/score/candidates.h"
#include "segment/score/objectives.h"

namespace qchopper {

// A candidate that was ranked for a cut: its plane and its terms.
struct Ranked {
    Plane plane;
    double wanted_offset = 0;
    int normal = 0;
    int offset = 0;
    Terms terms;
    bool operator==(const Ranked&) const = default;
};

// One decision. The plane is exact: it is applied again as it stands, never nudged.
struct Cut {
    std::int32_t number = 0;  // 1, 2, ...
    std::string piece;        // the piece that it parts
    Ranked chosen;
    std::vector<Ranked> runners_up;   // the next best, best first
    std::size_t candidates = 0;       // how many planes were ranked
    std::vector<std::string> pieces;  // those that it made
    std::size_t fragments = 0;        // how many it made
    bool operator==(const Cut&) const = default;
};

// A solid too small to be a piece. Listed, never silently dropped.
struct Fragment {
    std::int32_t cut = 0;  // the cut that made it; 0: it was in the scan
    double volume_mm3 = 0;
    Vec3 centre;  // of its box
    std::shared_ptr<const TriangleMesh> mesh;
};

// A piece that is not to be carved, by the operator's word. Listed, never silently dropped.
struct Discarded {
    std::size_t after = 0;  // so many cuts were made before
    Piece piece;
};

struct Segmentation {
    std::vector<Cut> cuts;
    std::vector<Piece> pieces;  // the leaves, in the order of their names
    std::vector<Fragment> fragments;
    std::vector<Discarded> discarded;  // in the order of the decisions
    std::size_t names_given = 0;
    std::vector<std::string> warnings;
};

// A, B, ..., Z, AA, AB, ...: bijective base 26, from 0.
std::string piece_name(std::size_t index);

// The uncut scan as a segmentation: every solid is a piece, or a fragment if it is smaller than fragment_volume_mm3.
Segmentation uncut(const TriangleMesh& scan, double fragment_volume_mm3);

// Parts a piece along cut.chosen.plane, exactly; fills in the pieces and fragments that it makes.
// Returns false, and changes nothing, if there is no such piece or the plane misses it.
bool apply(Segmentation& segmentation, Cut cut, double fragment_volume_mm3);

// Takes a piece out, with a warning that says how much it was. Returns false, and changes nothing, if there is no such
// piece or it is the only one.
bool discard(Segmentation& segmentation, const std::string& piece);

}  // namespace qchopper
