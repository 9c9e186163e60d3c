// Finds for each face of a display mesh the triangle of the exact mesh that it shows, whose state it takes.
//
// mm. Same input, same result, whatever the number of threads (tests/app/display/exact_faces_test.cpp).

#pragma once

#include <cstdint>
#include <vector>

#include "app/display/display_mesh.h"
#include "base/context.h"
#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

// One triangle of `piece` per face of `shown`, which was made of it: the first one that has the same corners on the
// grid, as all caps have. For others the nearest to the middle of the face, of the skin and turned alike, within 60
// degrees; where there is none within eight times the distance of the nearest and eight steps of the grid, the nearest.
// Precondition: the piece has a triangle, or `shown` has none. Throws Cancelled.
std::vector<std::uint32_t> exact_faces(const DisplayMesh& shown, const TriangleMesh& piece,
                                       const Context& context = {});

}  // namespace qchopper
