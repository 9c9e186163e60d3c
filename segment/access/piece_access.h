// What a tilting tool reaches of one piece, from every base that can carry it, on samples of the piece itself.
//
// mm2, for a tool of radius zero. A share of 2 % needs 4,000 samples: its standard deviation is then 0.1 to 0.3 points.
// The same piece and options give the same bytes for any number of threads
// (tests/segment/access/piece_access_test.cpp).

#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "segment/access/chosen_directions.h"
#include "segment/access/sampled_piece.h"
#include "segment/cut/piece.h"

namespace qchopper {

// A way in which a piece can lie. `number` is that of the cut whose cap lies on the table; of a piece without a cap
// that can carry it, 1 to 6: the sides of its oriented box, shortest axis first, each before its opposite.
struct PieceBase {
    int number = 0;
    TiltBase base;
    double base_mm2 = 0;       // area of the cap; 0 without one
    double projected_mm2 = 0;  // of the piece, along base.up
};
// Every cap of at least min_base_share of the piece's projected area along its inward normal, in the order of the
// cuts, or else the six sides. Precondition: the mesh is closed and has triangles. O(triangles x caps).
std::vector<PieceBase> bases_of(const Piece& piece);

struct PieceAccessOptions {
    double tilt_deg = default_tilt_deg;
    DirectionOptions directions;
    std::size_t samples = 4000;
    bool takes_kept = false;  // the piece's own Piece::samples serve if they are as many
    bool asks_dense = true;   // dense directions too; the chosen ones and what they leave do not depend on them
};

// Per direction 1 if it can be held when the piece lies on a base, else 0.
using ReachableDirections =
    std::function<std::vector<std::uint8_t>(const PieceBase& base, std::span<const Vec3> directions)>;

struct BaseAccess {
    PieceBase base;
    ChosenDirections directions;
    double area_mm2 = 0;  // of the piece without this base
    double unreachable_mm2 = 0;
    // 0..1: sums that rounding makes a little larger than the area are no more than all of it.
    double share() const { return area_mm2 > 0 ? std::min(1.0, unreachable_mm2 / area_mm2) : 0; }
};

struct PieceAccess {
    std::shared_ptr<const SampledPiece> samples;
    std::vector<BaseAccess> bases;   // one per base that was given, in their order; at least one
    const BaseAccess& best() const;  // the one with the least share; the first of several
};

// Of one base, on samples that are there already.
BaseAccess base_access(const SampledPiece& samples, const PieceBase& base, const PieceAccessOptions& options,
                       const ReachableDirections& held = {});

// `held` may be empty: every direction is held. Preconditions: there is a base.
PieceAccess piece_access(const Piece& piece, std::span<const PieceBase> bases, const PieceAccessOptions& options = {},
                         const ReachableDirections& held = {});

}  // namespace qchopper
