// An indexed triangle mesh: points, and triangles as indices of points.
//
// Coordinates are doubles in millimetres. A triangle lists its corners counter-clockwise seen from outside. A mesh is
// *closed* when every half-edge has exactly one opposite (edges.h, tests/segment/mesh/connectivity/edges_test.cpp). All
// functions here but is_consistent are O(1).

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

// The value of cap_of for a triangle that is of no cap.
constexpr std::int32_t no_cap = -1;

struct TriangleMesh {
    std::vector<Vec3> points;
    std::vector<Triangle> triangles;
    std::vector<std::int32_t> cap_of;  // one per triangle: number of the cut whose cap it is of, or no_cap; or empty
    // One per triangle: 1 for surface that may stay as it is, so that it counts neither as surface to be reached nor as
    // out of reach; or empty: there is none.
    std::vector<std::uint8_t> ignored = {};
    bool operator==(const TriangleMesh&) const = default;
};

// Whether every corner is the index of a point, and cap_of and ignored are empty or have one entry per triangle. Holds
// for every mesh; meant for asserts. O(triangles).
inline bool is_consistent(const TriangleMesh& mesh) {
    const auto has_points = [&](const Triangle& t) { return std::max({t[0], t[1], t[2]}) < mesh.points.size(); };
    return (mesh.cap_of.empty() || mesh.cap_of.size() == mesh.triangles.size()) &&
           (mesh.ignored.empty() || mesh.ignored.size() == mesh.triangles.size()) &&
           std::all_of(mesh.triangles.begin(), mesh.triangles.end(), has_points);
}

// The points of the corners, in the order of the triangle.
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

// The number of the cut whose cap the triangle is of, or no_cap.
inline std::int32_t cap_of(const TriangleMesh& mesh, std::size_t triangle) {
    assert(mesh.cap_of.empty() || triangle < mesh.cap_of.size());
    return mesh.cap_of.empty() ? no_cap : mesh.cap_of[triangle];
}

// Whether the triangle is surface that may stay as it is.
inline bool is_ignored(const TriangleMesh& mesh, std::size_t triangle) {
    assert(mesh.ignored.empty() || triangle < mesh.ignored.size());
    return !mesh.ignored.empty() && mesh.ignored[triangle] != 0;
}

}  // namespace qchopper
