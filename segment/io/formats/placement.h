// The affine map that places a part in the scene of a file, and the points of a part added to a scan by it.
//
// glTF and 3MF repeat parts, and parts of parts: a small file can describe more points than fit in memory, so they are
// counted before they are added (tests/segment/io/formats/read_3mf_test.cpp).

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "segment/io/formats/raw_mesh.h"
#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

// The images of the three axes and of the origin. As it begins it is the identity.
struct Placement {
    std::array<Vec3, 3> axes{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    Vec3 origin;
    Vec3 operator()(Vec3 p) const { return p.x * axes[0] + p.y * axes[1] + p.z * axes[2] + origin; }
};

// First `inner`, then `outer`.
Placement operator*(const Placement& outer, const Placement& inner);
// Whether the map reverses orientation: triangles placed by it must have two corners exchanged.
bool is_mirroring(const Placement& placement);

// Limit of the points of a scene with all repetitions, and of its triangles.
constexpr std::size_t max_placed = 50'000'000;

// Appends the mapped points and returns the index of the first. Precondition: the scan has at most max_placed points.
// Throws InputError (mesh) if it would have more than max_placed, or if a mapped coordinate is not finite; `what`
// names the part.
std::uint32_t place_points(RawMesh& scan, const std::vector<Vec3>& points, const Placement& placement,
                           const std::string& what);

}  // namespace qchopper
