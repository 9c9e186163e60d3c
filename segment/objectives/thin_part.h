// Clips one face at a plane: the part of it from which fragility is measured.
//
// mm. Shared by the sweep (fragility_sweep.h) and the plain sum in tests/reference, so that both get the same bits. The
// point of a crossed edge is computed here from the corner that comes first in the face; edge_crossing
// (plane_section.h) starts at the upper end and gives the same bits only where that is the first corner. Sharing it
// would change the last bits of thinness, and with them recorded terms and ties; nothing needs it, because parts are
// measured one by one and never joined at an edge.

#pragma once

#include <array>

#include "segment/cut/piece.h"

namespace qchopper {

constexpr double nearly_parallel = 0.9;  // least |n_T . n_P| of a face that counts

// A convex polygon of three or four corners; of none if the face has nothing on that side.
struct ThinPart {
    std::array<Vec3, 4> corner;
    int corners = 0;
    void add(Vec3 p) { corner[static_cast<std::size_t>(corners++)] = p; }
};

// The part above the plane, or below it. A corner at the plane's height counts as above.
ThinPart thin_part(const TriangleMesh& mesh, std::size_t triangle, const Plane& plane, bool above);

// Zero area and the origin for a part without corners.
struct Centroid {
    Vec3 at;
    double area = 0;  // mm2
};
Centroid centroid(const ThinPart& part);

}  // namespace qchopper
