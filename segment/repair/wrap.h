// Shrinks a skin around a mesh: the last resort for what nothing else makes a solid (CGAL's alpha wrap: Portaneri,
// Rouxel-Labbe, Hemmer, Cohen-Steiner and Alliez, "Alpha wrapping with an offset", 2022).
//
// Lengths are mm. Whatever the input, also a soup, the result is closed, faces outwards, does not run through itself
// and encloses the input: it lies outside of it by about the offset, and hides what is narrower than alpha
// (tests/segment/repair/wrap_test.cpp). It keeps no point of the input; distance.h tells how far it is from it.

#pragma once

#include "base/context.h"
#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

struct WrapOptions {
    double alpha_mm = 0;   // radius of the ball that cannot enter; 0: 1/100 of the box's diagonal. Halved, it costs 5 x
    double offset_mm = 0;  // distance of the skin; 0: 1/30 of alpha
};

// What the options mean for this mesh. Throws InputError: (use) for negative or not finite lengths, an alpha below
// 1/2000 of the diagonal (hours) or an offset of no size beside it, (mesh) for a mesh without a triangle.
WrapOptions filled_in(const WrapOptions& options, const TriangleMesh& mesh);

// Throws what filled_in throws. Cannot be stopped before it is done.
TriangleMesh wrap(const TriangleMesh& mesh, const WrapOptions& options, const Context& context = {});

}  // namespace qchopper
