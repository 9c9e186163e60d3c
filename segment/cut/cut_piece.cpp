// Cut, then the solids of both halves as meshes of their own.

#include "segment/cut/cut_piece.h"

#include <cassert>

#include "segment/cut/cut.h"
#include "segment/cut/half_solids.h"
#include "segment/mesh/edges.h"

namespace qchopper {
namespace {

void add_solids(CutPieces& result, const Piece& parent, const TriangleMesh& half, const HalfSolids& solids,
                const HalfSpace& half_space) {
    for (TriangleMesh& solid : split_solids(half, solids.shells, solids.solids)) {
        assert(edges(solid).faults.is_closed());
        Piece piece;
        piece.mesh = std::make_shared<const TriangleMesh>(std::move(solid));
        piece.half_spaces = parent.half_spaces;
        piece.half_spaces.push_back(half_space);
        result.pieces.push_back(std::move(piece));
    }
}

}  // namespace

std::optional<CutPieces> cut_piece(const Piece& piece, const Plane& plane, std::int32_t cut_number) {
    assert(piece.mesh);
    const std::optional<CutHalves> halves = cut(*piece.mesh, plane, cut_number);
    if (!halves) return std::nullopt;
    CutPieces result;
    result.cap_area_mm2 = halves->cap_area_mm2;
    if (halves->forced_regions > 0) {
        result.warnings.push_back("piece " + piece.name + " intersects itself in " +
                                  std::to_string(halves->forced_regions) +
                                  " place(s) of this cut: the pieces are closed, but their caps overlap there");
    }
    const SolidsOfHalves solids = solids_of_halves(*piece.mesh, plane, *halves);
    add_solids(result, piece, halves->above.mesh, solids.above, {cut_number, plane, true});
    add_solids(result, piece, halves->below.mesh, solids.below, {cut_number, plane, false});
    assert(result.pieces.size() >= 2);  // at least one on either side
    return result;
}

}  // namespace qchopper
