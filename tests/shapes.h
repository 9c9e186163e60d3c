// Named awkward shapes that the tests run on. All closed, outwards, in mm, unless the name says otherwise.

#pragma once

#include <string>
#include <vector>

#include "segment/mesh/triangle_mesh.h"

namespace qchopper::shapes {

// A box whose sides are grids of n x n squares: flat regions, many vertices at one height.
TriangleMesh box(Vec3 min, Vec3 max, int n = 1);
// Latitude and longitude ball; two poles with fans of long triangles.
TriangleMesh ball(Vec3 centre, double radius, int rings = 16);
// A torus around z: one handle, sections of one ring or two discs.
TriangleMesh torus(Vec3 centre, double ring_radius, double tube_radius, int n = 24);
// A staircase of three flat steps.
TriangleMesh stairs();
// A square bar, tip at the top: sections shrink to a point.
TriangleMesh pyramid(Vec3 base_min, double side, double tall);

TriangleMesh turned_inside_out(TriangleMesh mesh);
TriangleMesh moved(TriangleMesh mesh, Vec3 by);
// Rotated by an angle about an axis through the origin.
TriangleMesh rotated(TriangleMesh mesh, Vec3 axis, double angle_rad);
TriangleMesh joined(const std::vector<TriangleMesh>& meshes);

// A box with a cubic cavity, a ball in the cavity, and a cavity in that ball: two solids of four shells.
TriangleMesh nested();
// Two linked tori and a torus shell inside one of them as a cavity.
TriangleMesh linked_tori();

struct Named {
    std::string name;
    TriangleMesh mesh;
    std::size_t solids = 1;
};
// Every closed, valid shape above, for invariants that hold for all of them.
std::vector<Named> all_closed();

}  // namespace qchopper::shapes
