// Wraps a mesh in a closed surface: the last resort for what no other step makes a solid (CGAL's alpha wrap: Portaneri,
// Rouxel-Labbe, Hemmer, Cohen-Steiner and Alliez, "Alpha wrapping with an offset", 2022).
//
// Lengths are mm. For any input, also a triangle soup, the result is closed, faces outwards, does not intersect itself
// and encloses the input: it lies outside of it by about the offset, and covers gaps narrower than alpha
// (tests/segment/repair/alpha_wrap_test.cpp). It keeps no point of the input; distance.h measures its distance.

#pragma once

#include "base/context.h"
#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

struct AlphaWrapOptions {
    double alpha_mm = 0;   // radius of the ball that cannot enter; 0: 1/100 of the box's diagonal. Halved, it costs 5 x
    double offset_mm = 0;  // distance of the wrap from the mesh; 0: 1/30 of alpha
};

// The options with the lengths that are meant by 0 for this mesh. Throws InputError: (use) for negative or not finite
// lengths, an alpha below 1/2000 of the diagonal (hours) or an offset below 1/10000 of alpha, (mesh) for a mesh without
// a triangle or of no size.
AlphaWrapOptions filled_in(const AlphaWrapOptions& options, const TriangleMesh& mesh);

// Throws what filled_in throws, and Cancelled before it starts; it cannot be cancelled later.
TriangleMesh alpha_wrap(const TriangleMesh& mesh, const AlphaWrapOptions& options, const Context& context = {});

}  // namespace qchopper
