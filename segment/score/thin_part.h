// One face, or its part on one side of a plane, as the fragility of a cut sees it. Shared by the plain sum
// (fragility.h) and the sweep, so that both see the same bits.

#pragma once

#include <array>

#include "segment/cut/piece.h"

namespace qchopper {

constexpr double nearly_parallel = 0.9;  // of n_T . n_P

// A convex polygon of three or four corners; none if the face has nothing on that side.
struct Part {
    std::array<Vec3, 4> corner;
    int corners = 0;
    void add(Vec3 p) { corner[static_cast<std::size_t>(corners++)] = p; }
};
Part part_of(const TriangleMesh& mesh, std::size_t triangle, const Plane& plane, bool above);

struct Centroid {
    Vec3 at;
    double area = 0;
};
Centroid centroid(const Part& part);

}  // namespace qchopper
