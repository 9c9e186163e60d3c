// The solids that the two halves of a cut fall into: one answer for the cut and for the evaluation by cutting.
//
// A cavity that the plane does not touch belongs to the solid that it belonged to before the cut, as in the sweep: so
// what the sweep predicts is what the cut makes, also of solids that touch (tests/segment/score/touching_test.cpp).

#pragma once

#include "segment/cut/cut.h"
#include "segment/mesh/solids.h"

namespace qchopper {

// The line of a cavity link runs at one height: of the triangle that it meets, this corner is on its side of any plane.
std::uint32_t far_corner(const TriangleMesh& mesh, const CavityLink& link, Vec3 normal, bool above);

struct HalfSolids {
    Shells shells;
    Solids solids;
};
struct SolidsOfHalves {
    HalfSolids above;
    HalfSolids below;
};
SolidsOfHalves solids_of_halves(const TriangleMesh& mesh, const Plane& plane, const CutHalves& halves);

}  // namespace qchopper
