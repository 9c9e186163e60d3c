// Drops faces with the same corners as another one, and flat doubled components, which enclose nothing.
//
// Faces that stay keep their order, points keep theirs; a point that loses its last face is dropped by the next weld.
// A second call changes nothing (tests/segment/repair/faces_test.cpp).

#pragma once

#include <cstddef>
#include <vector>

#include "segment/mesh/connectivity/edges.h"
#include "segment/mesh/triangle_mesh.h"
#include "segment/repair/source_faces.h"

namespace qchopper {

struct RepeatedFaces {
    std::size_t repeated = 0;  // with the corners of another one, which stays
    // Of flat doubled components (a wall between two solids, a fin): both sides are dropped.
    std::size_t of_doubled_components = 0;
    bool operator==(const RepeatedFaces&) const = default;
};

// Precondition: equal points are welded. Of faces with the same orientation the first stays. Of two opposite ones both
// are dropped where the surface around them closes without them, and one of them stays where it does not.
// `found` are the edges of the mesh as it is passed.
RepeatedFaces drop_repeated_faces(TriangleMesh& mesh, const Edges& found, SourceFaces* sources = nullptr);

// One flag per triangle, true for those that stay when faces with the same corners cancel in pairs of opposite
// orientation; of the rest the first stay. The difference between the numbers of every directed edge and its reverse
// stays as it was.
std::vector<bool> without_opposite_faces(const TriangleMesh& mesh);

}  // namespace qchopper
