// Cuts a closed mesh in two along a plane and caps both halves.
//
// Lengths are millimetres. Whatever the plane, the two halves close again and their volumes add up to the volume of
// the input to 1e-9 (tests/segment/cut/cut_test.cpp). No vertex of the mesh may lie numerically on the plane: nudge()
// finds an offset for which that holds (nudge.h). A vertex at the height of the plane counts as above.

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
    std::vector<std::uint32_t>
        parent;  // per triangle: the triangle of the input that it is (a part of); caps: no_parent
    std::vector<std::uint32_t> number;  // per point of the input: its number in this half, or no_parent
};

// Both halves of one cut. Cap triangle i of one is cap triangle i of the other, turned over, with the same points to
// the last bit.
struct CutHalves {
    Half above;  // the side that plane.normal points to
    Half below;
    double cap_area_mm2 = 0;  // signed: sum over the loops of the section
    std::size_t loops = 0;
    std::size_t forced_regions = 0;  // cap regions whose loops cross: the input runs through itself there
};

// Returns nothing if the plane misses the mesh: that is an answer, not an error. New caps are marked cut_number in
// cap_of. Throws InputError if the mesh is open where the plane passes; repair closes it.
std::optional<CutHalves> cut(const TriangleMesh& mesh, const Plane& plane, std::int32_t cut_number);

// The forced_regions of a cut that is not made: the sections cross there, and a cap would overlap itself.
std::size_t crossing_regions(const TriangleMesh& mesh, const Plane& plane);

}  // namespace qchopper
