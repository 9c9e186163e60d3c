// One finite element: a cube with 8 nodes and incompatible modes, which bends without being too stiff.
//
// For a cube of side 1 and a modulus of 1; nodes are numbered x + 2 y + 4 z, degrees of freedom 3 * node + axis. With a
// side h and a modulus E the stiffness is E h times this, the strain 1/h times. The nine incompatible modes are
// condensed (E. Wilson, R. Taylor, W. Doherty, J. Ghaboussi, "Incompatible displacement models", 1973; that they pass
// the patch test for cubes, and with a correction for other shapes: R. Taylor, P. Beresford, E. Wilson, "A
// non-conforming element for stress analysis", 1976). Rigid motions have no energy, and uniform strain is exact
// (tests/segment/structure/brick_test.cpp).

#pragma once

#include <array>

namespace qchopper {

struct Brick {
    std::array<std::array<double, 24>, 24> stiffness{};  // symmetric
    // Rows xx, yy, zz, xy, yz, zx: the stress at the centre, by the displacements times E/h. The incompatible modes
    // have no strain there, and the linear part of the stress has its mean there.
    std::array<std::array<double, 24>, 6> stress{};
};

// Precondition: Poisson's ratio is at least 0 and below 0.5.
Brick brick(double poisson_ratio);

}  // namespace qchopper
