// Tells solids from sheets: any border can be closed somehow, but a sheet that is closed so has no inside.
//
// A shell is a sheet when what closes its holes is larger than 80 % of what was scanned of it
// (tests/segment/repair/open_components_test.cpp).

#pragma once

#include <cstddef>

#include "segment/mesh/triangle_mesh.h"
#include "segment/repair/source_faces.h"

namespace qchopper {

constexpr double most_fill_of_surface = 0.8;   // of a shell's area: beyond this it is a sheet, not a solid
constexpr double open_component_share = 0.01;  // of the scanned surface: so much may go as open components

struct Sheets {
    std::size_t dropped = 0;        // small ones beside a solid: taken away with what closed them
    std::size_t dropped_faces = 0;  // of the scan
    std::size_t left = 0;
    Vec3 first;  // the middle of the first one left
    double added_area_share = 0;
};

// Sheets go when all together have at most `drop_share` of the scanned
// surface and something else is left.
Sheets judge_sheets(TriangleMesh& mesh, SourceFaces& sources, double drop_share);

}  // namespace qchopper
