// Groups the shells of the two halves of a cut to solids, for the cut and for the reference evaluation.
//
// A cavity that the plane does not cross stays in the solid that it was in before the cut, as in the sweep: so the cut
// makes the solids that the sweep evaluates, also of solids that touch
// (tests/segment/objectives/sweep/touching_test.cpp).

#pragma once

#include "segment/cut/cut.h"
#include "segment/mesh/connectivity/solids.h"

namespace qchopper {

// The highest corner of the triangle of a cavity link if `above`, else the lowest. The line of the link meets the
// triangle at one height along the normal: where it is above a plane perpendicular to that, so is the highest corner,
// and where it is below, so is the lowest.
std::uint32_t far_corner(const TriangleMesh& mesh, const CavityLink& link, Vec3 normal, bool above);

struct HalfSolids {
    Shells shells;  // of the mesh of the half
    Solids solids;
};
struct SolidsOfHalves {
    HalfSolids above;
    HalfSolids below;
};
// `halves` is the cut of the closed mesh at the plane. O(triangles), and the cavity links of the mesh (solids.h).
SolidsOfHalves solids_of_halves(const TriangleMesh& mesh, const Plane& plane, const CutHalves& halves);

}  // namespace qchopper
