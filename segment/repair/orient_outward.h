// Turns shells so that they bound solids: outer ones face outwards, and those inside them alternate.
//
// Only whole shells are turned; points and triangles keep their order. A shell whose orientation fits the shells around
// it stays, also a cavity. A second call changes nothing (tests/segment/repair/orient_outward_test.cpp).

#pragma once

#include <cstddef>

#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

struct Outward {
    std::size_t shells = 0;
    std::size_t cavities = 0;     // shells that face inwards in the result
    std::size_t turned = 0;       // shells that were inside out
    std::size_t overlapping = 0;  // shells inside another one that is oriented alike: not turned
    std::size_t left = 0;         // inside out with nothing around them, but they touch shells that are not: not turned
};

// Precondition: the mesh is closed. Only counts when `turn` is false.
Outward orient_outward(TriangleMesh& mesh, bool turn = true);

// The same, but shells that touch (have points with equal coordinates) are turned together or not at all, by the sum of
// their volumes: a fold that touches a solid stays as it is. Where that leaves no volume every shell is turned by
// itself. For a mesh whose faces were paired as they are (balance.h).
Outward orient_touching_outward(TriangleMesh& mesh, bool turn = true);

}  // namespace qchopper
