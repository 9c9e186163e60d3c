// Reduces the faces of a closed mesh to a number by collapsing edges in passes over the whole mesh: the fast way.
//
// mm. What holds for collapse.h holds here: an edge collapses to one of its points, so no point moves; no face turns by
// more than 60 degrees in a collapse or becomes a needle (sound_face.h); locked points, and faces with locked points
// only, stay. The result is closed and manifold if the mesh is. Same input, same bytes, whatever the number of threads
// (tests/segment/simplify/simplify_test.cpp).

#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/context.h"
#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

// `is_locked` has one flag per point, or is empty: then no point is locked. The result has at most `max_faces` faces,
// or more if the passes find no other edge that may collapse. Faces that stay keep their order, their caps and, where
// it stays, their first corner; points keep their order, those without a face are left out. Precondition: the mesh is
// closed, and the faces of every point form one fan (manifold.h). Throws Cancelled (base/context.h).
TriangleMesh collapse_in_passes(const TriangleMesh& mesh, const std::vector<std::uint8_t>& is_locked,
                                std::size_t max_faces, const Context& context = {});

}  // namespace qchopper
