// Makes closed shells of a mesh whose directed edges balance: each occurs as often as its reverse.
//
// Such a mesh is the boundary of a volume, however its faces meet, so nothing has to be added: it is enough to pair the
// faces at edges of more than two. Faces are never turned or moved, so the signed volume stays
// (tests/segment/repair/balance_test.cpp). A weld and a second call change nothing.

#pragma once

#include <cstddef>
#include <optional>

#include "segment/mesh/connectivity/edges.h"
#include "segment/mesh/triangle_mesh.h"
#include "segment/repair/source_faces.h"

namespace qchopper {

// `found` are the edges of the mesh. Precondition: equal points are welded. That keeps the balance: the directed edges
// of a collapsed face cancel.
bool is_balanced(const TriangleMesh& mesh, const Edges& found);

struct ShellCounts {
    std::size_t cancelled = 0;    // faces with the same corners and opposite orientation, dropped in pairs
    std::size_t edges_split = 0;  // edges of four faces or more
    std::size_t copies = 0;       // of points, at the end of the points
    bool operator==(const ShellCounts&) const = default;
};

// Precondition: the mesh is balanced and has no collapsed faces. Postcondition: every edge has exactly two faces, which
// run along it in opposite directions, and every point one fan of faces. Returns nothing and leaves the mesh as it is
// where all faces cancel: such a mesh encloses nothing.
std::optional<ShellCounts> close_balanced(TriangleMesh& mesh, SourceFaces* sources = nullptr);

}  // namespace qchopper
