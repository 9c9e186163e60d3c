// Adds pen grooves to a specimen: narrow shallow grooves along curves on its surface, as a marker pen leaves in a scan.
//
// Lengths are mm. Points move inwards along their normals and nothing else changes, so the distance of a point from its
// place in the mesh before is the depth of the groove there (tests/segment/sample/draw_pen_grooves_test.cpp). Same mesh
// and options, same grooves.

#pragma once

#include <cstddef>
#include <vector>

#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

struct DrawOptions {
    int pen_grooves = 1;  // number of grooves
    double width = 0;     // from rim to rim; 0: 4, or 3.5 times the mean edge if that is more
    double depth = 0;     // of the bottom; 0: a tenth of the width
};

struct DrawnPenGrooves {
    double width = 0;                      // as used
    double depth = 0;                      // as used
    std::vector<std::vector<Vec3>> lines;  // one per groove: its middle line on the surface before; fewer than
                                           // pen_grooves if there is no smooth place for more
    std::size_t points_moved = 0;
};

// Each line is fourteen times as long as the groove is wide; every second one is bent. O(triangles), and for each
// groove up to 300 lines are tried.
DrawnPenGrooves draw_pen_grooves(TriangleMesh& mesh, const DrawOptions& options);

}  // namespace qchopper
