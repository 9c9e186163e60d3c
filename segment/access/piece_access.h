// The inaccessible area of one piece: on its best base along all directions, as the search counts it, and from every
// base along the few that are chosen, as setups are judged.
//
// mm2, on samples, for a tool of radius zero. A share of 2 % needs 4,000 samples: its standard deviation is then 0.1 to
// 0.3 points. The same piece and options give the same bytes for any number of threads
// (tests/segment/access/piece_access_test.cpp). Which caps count as surface: counts_as_surface (unreachable.h). The
// same of both sides of a plane, without cutting: access_sweep.h.

#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
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
// Every cap that carries the piece by its projected area along the cap's inward normal, in the order of the cuts, or
// else the six sides. Precondition: the mesh is closed and has triangles. O(triangles x caps).
std::vector<PieceBase> bases_of(const Piece& piece);

struct AreaOnBase {
    PieceBase base;
    double area_mm2 = 0;         // of the surface that counts on this base
    double unreachable_mm2 = 0;  // of it; with or without steep surface, as the tilt wants
    // 0..1: sums that rounding makes a little larger than the area are no more than all of it.
    double share() const { return area_mm2 > 0 ? std::min(1.0, unreachable_mm2 / area_mm2) : 0; }
};

// On the piece's own Piece::samples, along all directions of the scan within the tilt: the base with the least
// unreachable area, the first of several. Bases as bases_of, with the projected area on the samples too, so that it
// costs no more than the table has. Precondition: the piece has samples. O(samples x directions x caps).
AreaOnBase area_on_best_base(const Piece& piece, double tilt_deg);

// The sum of these over the pieces that the plane really makes, those below fragment_volume_mm3 left out; nothing: it
// does not part the piece. What a side of several solids leaves out of reach is found no other way. O(triangles +
// samples x directions).
std::optional<double> unreachable_when_cut_mm2(const Piece& piece, const Plane& plane, double fragment_volume_mm3,
                                               double tilt_deg);

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

// Along the chosen directions.
struct BaseAccess : AreaOnBase {
    ChosenDirections directions;
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
