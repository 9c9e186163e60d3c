// Cut, then the solids of both halves as meshes of their own.

#include "segment/cut/cut_piece.h"

#include <cassert>

#include "segment/cut/half_solids.h"
#include "segment/mesh/connectivity/edges.h"

namespace qchopper {
namespace {

void add_solids(CutPieces& result, const Piece& parent, const Half& half, const HalfSolids& solids,
                const HalfSpace& half_space) {
    const std::size_t first = result.pieces.size();
    for (TriangleMesh& solid : split_solids(half.mesh, solids.shells, solids.solids)) {
        assert(edges(solid).faults.is_closed());
        Piece piece;
        piece.mesh = std::make_shared<const TriangleMesh>(std::move(solid));
        piece.half_spaces = parent.half_spaces;
        piece.half_spaces.push_back(half_space);
        result.pieces.push_back(std::move(piece));
    }
    if (solids.solids.count == 1) {
        result.parent.push_back(half.parent);
        return;
    }
    result.parent.resize(result.pieces.size());
    for (std::size_t t = 0; t < half.parent.size(); ++t) {
        const std::uint32_t solid = solids.solids.solid_of_shell[solids.shells.shell_of[t]];
        result.parent[first + solid].push_back(half.parent[t]);
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
    add_solids(result, piece, halves->above, solids.above, {cut_number, plane, true});
    add_solids(result, piece, halves->below, solids.below, {cut_number, plane, false});
    assert(result.pieces.size() >= 2);  // at least one on either side
    return result;
}

}  // namespace qchopper
