// Presses narrow shallow grooves into a specimen along curves on its surface, as a scan shows the ink of a marker pen.
//
// Lengths are mm. Points move inwards along their normals and nothing else changes, so the specimen without marks says
// how deep every point lies (tests/segment/sample/draw_marks_test.cpp). Same mesh and options, same marks.

#pragma once

#include <cstddef>
#include <vector>

#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

struct DrawOptions {
    int marks = 1;
    double width = 0;   // of a groove, rim to rim; 0: 4, or three and a half mean edges if that is more
    double depth = 0;   // of its bottom; 0: a tenth of the width
    double length = 0;  // 0: fourteen times the width
};

struct DrawnMarks {
    double width = 0;
    double depth = 0;
    std::vector<std::vector<Vec3>> lines;  // on the surface as it was; every other one is bent; fewer than asked for
                                           // where there is no even place left
    std::size_t points_moved = 0;
};

DrawnMarks draw_marks(TriangleMesh& mesh, const DrawOptions& options);

}  // namespace qchopper
