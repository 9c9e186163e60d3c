// Makes a manifold of a mesh in which more than two faces meet at an edge, or neighbours turn opposite ways.
//
// Every edge gets at most two faces, which run along it in opposite directions, and every point one fan of faces: a
// point that several sheets share gets a copy for each but the first, at the end of the points. Faces keep their order;
// only which way they turn may change. Doing it, welding and doing it again is doing it once
// (tests/segment/repair/sheets_test.cpp).

#pragma once

#include <cstddef>

#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

struct SheetOptions {
    bool turn = true;    // turn faces so that neighbours agree; else the surface is cut open between them
    bool stitch = true;  // join borders that coincide once the sheets are known
};

struct SheetCounts {
    std::size_t edges_split = 0;   // edges of three faces or more
    std::size_t edges_cut = 0;     // cut open because the surface there has only one side, or may not be turned
    std::size_t stitched = 0;      // edges at which two sheets became one
    std::size_t faces_turned = 0;  // so that they agree with their neighbours: the smaller part of each sheet
    std::size_t copies = 0;        // of points
};

// Equal points must have been welded.
SheetCounts separate_sheets(TriangleMesh& mesh, const SheetOptions& options = {});

}  // namespace qchopper
