// Finds the open components among the shells of a filled mesh: any border can be closed somehow, but an open component
// that is closed so has no inside. Small ones are dropped.
//
// A shell counts as an open component when what fills its holes has more than 80 % of the area that was scanned of it
// (tests/segment/repair/open_components_test.cpp).

#pragma once

#include <cstddef>

#include "segment/mesh/triangle_mesh.h"
#include "segment/repair/source_faces.h"

namespace qchopper {

constexpr double max_fill_of_surface = 0.8;    // of a shell's scanned area: with more it is an open component
constexpr double open_component_share = 0.01;  // of the scanned area: open components of so much are dropped

struct OpenComponents {
    std::size_t dropped = 0;        // with what filled their holes
    std::size_t dropped_faces = 0;  // of the scan
    std::size_t left = 0;
    Vec3 first;                   // centre of the box of the first one found
    double added_area_share = 0;  // area of the new faces left, of that and the scanned area; 0 to 1
};

// Drops all open components if together they have at most `drop_share` of the scanned area and another shell is left;
// otherwise all stay. New triangles in `sources`, one per triangle, are what fills the holes.
OpenComponents drop_open_components(TriangleMesh& mesh, SourceFaces& sources, double drop_share);

}  // namespace qchopper
