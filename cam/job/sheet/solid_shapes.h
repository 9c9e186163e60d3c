// Meshes of simple solids, for the pictures of a job.
//
// mm; triangles face outwards. Round solids are prisms of many sides, whose corners lie on the true surface
// (tests/cam/job/sheet/envelope_picture_test.cpp).

#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "cam/cell/shape_distance.h"
#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

// The 12 edges of a box, each as a box of no width, and a bar along one of them, which it surrounds by half a width.
std::array<Box, 12> edges_of(const Box& box);
void add_bar(TriangleMesh& mesh, const Box& edge, double half_width);
TriangleMesh box_mesh(const PlacedBox& box);
TriangleMesh ball_mesh(Vec3 middle, double radius);
TriangleMesh capsule_mesh(const Capsule& capsule);
TriangleMesh cylinder_mesh(const Cylinder& cylinder);

// Distance along the axis and radius there.
using Profile = std::vector<std::pair<double, double>>;

// The profile turned about an axis through `origin`; it begins and ends with radius 0, and the axis is a unit vector.
TriangleMesh turned_profile(Vec3 origin, Vec3 axis, const Profile& profile, std::uint32_t sides = 16);

}  // namespace qchopper
