// Directions along which a tool may come out of a piece.
//
// Unit vectors. Normals: vertices of the subdivided octahedron, as in Luo et al., "Chopper: partitioning models into
// 3D-printable parts" (2012); dense ones: Gonzalez, "Measurement of areas on a sphere using Fibonacci and latitude-
// longitude lattices" (2010). No direction of the sphere is farther than 10 degrees from one of the former and 4 from
// one of the latter (tests/segment/access/tool_directions_test.cpp).

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/vec3.h"

namespace qchopper {

constexpr double largest_tilt_deg = 90;
constexpr double default_tilt_deg = 60;

// The 129 normals: the 258 vertices of the octahedron after three subdivisions, edge midpoints normalised at each, one
// of each two opposite ones: that whose first non-zero component is positive.
std::vector<Vec3> octahedron_normals();

// Both signs of the octahedron's normals and of three axes (unit vectors), each directly followed by its opposite. An
// axis within 1e-9 of an earlier direction is left out: 264 at most.
std::vector<Vec3> tool_directions(const std::array<Vec3, 3>& axes);

constexpr std::size_t dense_direction_count = 2'000;

// Evenly spread over the sphere. Precondition: count > 0.
std::vector<Vec3> dense_directions(std::size_t count = dense_direction_count);

// Whether a tool that tilts by at most `tilt_deg` from `up` comes out along the direction: their angle is no larger, up
// to 1e-9 of its cosine. Precondition: 0 <= tilt_deg <= largest_tilt_deg.
bool is_allowed(Vec3 direction, Vec3 up, double tilt_deg);

// The indices of the directions that are allowed, ascending.
std::vector<std::uint32_t> allowed_directions(std::span<const Vec3> directions, Vec3 up, double tilt_deg);

// The index of the direction that is `d` to 1e-9, or directions.size().
std::size_t index_of(std::span<const Vec3> directions, Vec3 d);

}  // namespace qchopper
