// Cuts a closed mesh in two along a plane and caps both halves.
//
// Lengths are millimetres. Precondition: the mesh is closed (edges.h), and no vertex lies numerically on the plane:
// nudge() finds such an offset (nudge.h). Postcondition: both halves are closed and their volumes add up to that of the
// input to 1e-9 relative (tests/segment/cut/cut_test.cpp). A vertex at the height of the plane counts as above.

#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "segment/mesh/plane.h"
#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

constexpr std::uint32_t no_parent = std::numeric_limits<std::uint32_t>::max();

// The part of the input on one side of the plane. Its cap triangles come last.
struct Half {
    TriangleMesh mesh;
    std::size_t first_cap_triangle = 0;
    std::vector<std::uint32_t> parent;  // one per triangle: that of the input of which it is a part; caps: no_parent
    std::vector<std::uint32_t> number;  // one per point of the input: its number in this half, or no_parent
};

// Both halves of one cut. Cap triangle i of one half is cap triangle i of the other, of opposite orientation, with the
// same points to the last bit.
struct CutHalves {
    Half above;  // the side that plane.normal points to
    Half below;
    double cap_area_mm2 = 0;         // signed: sum over the loops of the section
    std::size_t loops = 0;           // of the section
    std::size_t forced_regions = 0;  // cap regions whose loops cross: the input intersects itself there
};

// Returns nothing if the plane misses the mesh: that is an answer, not an error. cap_of of new caps is cut_number,
// which is not no_cap. Throws InputError (mesh) if the mesh is open where the plane passes; repair closes it.
// O(triangles + c log c) for c crossed triangles.
std::optional<CutHalves> cut(const TriangleMesh& mesh, const Plane& plane, std::int32_t cut_number);

// The forced_regions that this cut would have, without making it: in those the cap would overlap itself. Throws as
// cut().
std::size_t crossing_regions(const TriangleMesh& mesh, const Plane& plane);

}  // namespace qchopper
