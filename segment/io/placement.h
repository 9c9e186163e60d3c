// Where a file puts a part of its scene: an affine map, and parts added to a scan through it.
//
// glTF and 3MF draw the same part many times over, and parts of parts: a small file may ask for more than any machine
// holds, so what is placed is counted before it is made (tests/segment/io/read_3mf_test.cpp).

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "segment/io/raw_mesh.h"
#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

// Where the three axes and the origin come to lie.
struct Placement {
    std::array<Vec3, 3> axes{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    Vec3 origin;
    Vec3 operator()(Vec3 p) const { return p.x * axes[0] + p.y * axes[1] + p.z * axes[2] + origin; }
};

// First `inner`, then `outer`.
Placement operator*(const Placement& outer, const Placement& inner);
// Turns left into right: faces placed by it have to be turned, too.
bool is_mirroring(const Placement& placement);

// Of points, and of triangles.
constexpr std::size_t most_placed = 50'000'000;

// Adds the points at their place and returns the number of the first. Throws InputError (mesh) for more than
// most_placed in all, and where the place of one is no finite number; `what` names the part.
std::uint32_t place_points(RawMesh& scan, const std::vector<Vec3>& points, const Placement& placement,
                           const std::string& what);

}  // namespace qchopper
