// Turns shells so that they bound solids: the outer ones face outwards, and what lies in them alternates.
//
// Only whole shells are turned; points and triangles keep their order. A shell that agrees with its surroundings stays
// as it is, also a cavity. Doing it twice is doing it once (tests/segment/repair/outwards_test.cpp).

#pragma once

#include <cstddef>

#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

struct Outwards {
    std::size_t shells = 0;
    std::size_t cavities = 0;     // that face inwards, after
    std::size_t turned = 0;       // shells that were inside out
    std::size_t overlapping = 0;  // shells inside another one that faces the same way: left so
};

// For a closed mesh; only counts when `turn` is false.
Outwards turn_outwards(TriangleMesh& mesh, bool turn = true);

}  // namespace qchopper
