// Makes closed shells of a mesh whose directed edges balance: each occurs as often as its reverse.
//
// Such a mesh is the boundary of something, however its faces meet, so nothing has to be added: it is enough to say
// which two faces are neighbours at an edge of many. Faces are never turned or moved, so the signed volume stays
// (tests/segment/repair/balance_test.cpp). Doing it, welding and doing it again is doing it once.

#pragma once

#include <cstddef>
#include <optional>

#include "segment/mesh/edges.h"
#include "segment/mesh/triangle_mesh.h"
#include "segment/repair/source_faces.h"

namespace qchopper {

// `found` are the edges of the mesh. Equal points must have been welded, which keeps the balance: a face that it
// collapses has run along its edges there and back.
bool is_balanced(const TriangleMesh& mesh, const Edges& found);

struct ShellCounts {
    std::size_t cancelled = 0;    // faces that lie on each other and turn opposite ways: they go in pairs
    std::size_t edges_split = 0;  // edges of four faces or more
    std::size_t copies = 0;       // of points, at the end of the points
    bool operator==(const ShellCounts&) const = default;
};

// Needs a balanced mesh without collapsed faces. After it every edge has exactly two faces, which run along it in
// opposite directions, and every point one fan of faces. Where every face has an opposite one, which encloses nothing,
// the answer is nothing and the mesh stays.
std::optional<ShellCounts> close_balanced(TriangleMesh& mesh, SourceFaces* sources = nullptr);

}  // namespace qchopper
