// The mesh that everybody shares: points and triangles that name them.
//
// Coordinates are doubles in millimetres. A triangle lists its corners counter-clockwise seen from outside.
// A mesh is *closed* when every directed edge has exactly one opposite (tests/segment/mesh/edges_test.cpp).

#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/vec3.h"

namespace qchopper {

using Triangle = std::array<std::uint32_t, 3>;

// What cap_of says of a triangle that no cut has made.
constexpr std::int32_t no_cap = -1;

struct TriangleMesh {
    std::vector<Vec3> points;
    std::vector<Triangle> triangles;
    std::vector<std::int32_t> cap_of;  // per triangle: number of the cut whose cap it belongs to; empty: no caps at all
    bool operator==(const TriangleMesh&) const = default;
};

// Does every corner name a point, and every triangle have its cap if there are caps? Always so; for asserts.
inline bool is_consistent(const TriangleMesh& mesh) {
    const auto names_points = [&](const Triangle& t) { return std::max({t[0], t[1], t[2]}) < mesh.points.size(); };
    return (mesh.cap_of.empty() || mesh.cap_of.size() == mesh.triangles.size()) &&
           std::all_of(mesh.triangles.begin(), mesh.triangles.end(), names_points);
}

inline std::array<Vec3, 3> corners_of(const TriangleMesh& mesh, std::size_t triangle) {
    assert(triangle < mesh.triangles.size());
    const Triangle& t = mesh.triangles[triangle];
    return {mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]};
}

// Half the cross product of two edges: the direction is the outward normal, the length the area in mm2.
inline Vec3 area_vector(const TriangleMesh& mesh, std::size_t triangle) {
    assert(triangle < mesh.triangles.size());
    const Triangle& t = mesh.triangles[triangle];
    const Vec3 a = mesh.points[t[0]];
    return 0.5 * cross(mesh.points[t[1]] - a, mesh.points[t[2]] - a);
}

inline std::int32_t cap_of(const TriangleMesh& mesh, std::size_t triangle) {
    assert(mesh.cap_of.empty() || triangle < mesh.cap_of.size());
    return mesh.cap_of.empty() ? no_cap : mesh.cap_of[triangle];
}

}  // namespace qchopper
