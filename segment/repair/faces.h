// Drops faces that say nothing: those that repeat another one, and flat double sheets.
//
// Faces that stay keep their order, points keep theirs; a point that loses its last face is dropped by the next weld.
// Doing it twice is doing it once (tests/segment/repair/faces_test.cpp).

#pragma once

#include <cstddef>
#include <vector>

#include "segment/mesh/edges.h"
#include "segment/mesh/triangle_mesh.h"
#include "segment/repair/source_faces.h"

namespace qchopper {

struct RepeatedFaces {
    std::size_t repeated = 0;   // with the corners of another one: one of them stays
    std::size_t of_sheets = 0;  // of flat double sheets (a wall between two solids, a fin): both sides go
    bool operator==(const RepeatedFaces&) const = default;
};

// Equal points must have been welded. Of faces that turn the same way the first stays. Two that turn opposite ways both
// go where the surface around them closes without them, and one of them stays where it needs one.
RepeatedFaces drop_repeated_faces(TriangleMesh& mesh);
// `found` are the edges of the mesh.
RepeatedFaces drop_repeated_faces(TriangleMesh& mesh, const Edges& found, SourceFaces* sources = nullptr);

// Marks what stays when of faces with the same corners as many go that turn one way as turn the other; of the rest the
// first stay. So each directed edge still occurs as often more than its reverse as it did.
std::vector<bool> without_opposite_faces(const TriangleMesh& mesh);

}  // namespace qchopper
