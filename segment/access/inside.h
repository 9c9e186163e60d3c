// Finds the surface inside a scan: what no direction of the whole sphere reaches on the uncut scan, such as the inside
// of a skull.
//
// mm, for a tool of radius zero. Every solid is asked alone: others do not hide it, as in accessibility.h. The same for
// any number of threads (tests/segment/access/ignored_test.cpp).

#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/context.h"
#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

// One per triangle: 1 if it lies inside. Samples of all solids together are asked along the 264 directions of
// tool_directions.h. A triangle lies inside if more than half of its samples are open along none of them; one without
// a sample as its nearest neighbour along the surface that has one. So the border between inside and outside is right
// to about the distance of samples, the root of area / samples, and narrow openings for light that falls between the
// directions count as closed. A shell without any sample is taken as outside. Precondition: the mesh is closed.
// O(triangles) and at most samples x 264 rays; throws Cancelled.
std::vector<std::uint8_t> inside_surface(const TriangleMesh& scan, const Context& context = {},
                                         std::size_t samples = 100'000);

}  // namespace qchopper
