// Closes the open border loops of a mesh by adding triangles, never points.
//
// Existing points and triangles keep their order and their bits; the new triangles come last and no_cap is what
// cap_of says of them. The bunny of the Stanford scanning repository comes out with 69,664 faces
// (tests/segment/repair/fill_holes_test.cpp).

#pragma once

#include <cstddef>
#include <vector>

#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

// A loop that could not be closed.
struct OpenHole {
    Vec3 centre;  // mean of the points on its border
    std::size_t edges = 0;
};

struct FilledHoles {
    std::size_t filled = 0;
    std::size_t triangles = 0;  // added
    std::vector<OpenHole> left;
};

// The mesh must be manifold apart from its borders, with no border loop touching itself or another one in a point
// (see split_pinched in manifold.h).
FilledHoles fill_holes(TriangleMesh& mesh);

}  // namespace qchopper
