// Turns shells so that they bound solids: the outer ones face outwards, and what lies in them alternates.
//
// Only whole shells are turned; points and triangles keep their order. A shell that agrees with its surroundings stays
// as it is, also a cavity. Doing it twice is doing it once (tests/segment/repair/orient_outward_test.cpp).

#pragma once

#include <cstddef>

#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

struct Outward {
    std::size_t shells = 0;
    std::size_t cavities = 0;     // that face inwards, after
    std::size_t turned = 0;       // shells that were inside out
    std::size_t overlapping = 0;  // shells inside another one that faces the same way: left so
    std::size_t left = 0;         // inside out with nothing around, but held by shells that they touch
};

// For a closed mesh; only counts when `turn` is false.
Outward orient_outward(TriangleMesh& mesh, bool turn = true);

// The same for a mesh whose faces were taken as they are: shells that share a place (points with the same coordinates)
// turn together or not at all, by their volume in sum, so a fold that hangs on a solid stays as it is. Where nothing
// would be left of the volume every shell turns by itself.
Outward orient_touching_outward(TriangleMesh& mesh, bool turn = true);

}  // namespace qchopper
