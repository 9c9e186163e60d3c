// Lifts the grooves that a marker pen leaves in a laser scan: narrow, shallow lines.
//
// The scanner measures dark shining ink a little too far away (Nicholson 2016, section 1.2.3). Lengths are mm. Only the
// bottom and the flanks of a groove move, along the normal, up to the surface around it; every other point keeps its
// coordinates to the last bit, and triangles stay as they are (tests/segment/repair/pen_grooves/pen_grooves_test.cpp).

#pragma once

#include <cstddef>

#include "base/context.h"
#include "segment/mesh/measure.h"

namespace qchopper {

// What a pen groove is. The defaults are those of a marker pen; a wider or deeper groove counts as part of the bone.
struct PenGrooveOptions {
    double max_width = 6;   // across the line; above 0
    double max_depth = 1;   // of the bottom below the surface around it; above min_depth
    double min_depth = 0;   // of the bottom; 0: four times the roughness around, and at least 0.02 mm
    double min_length = 0;  // of the line; 0: three times max_width
};

struct PenGrooveReport {
    std::size_t count = 0;  // connected grooves
    std::size_t points_moved = 0;
    double area_mm2 = 0;         // of the triangles with a moved corner
    double length_mm = 0;        // of all lines together
    double max_depth = 0;        // the largest distance that a point moved
    double mean_depth = 0;       // mean over the points that moved
    Box box;                     // around all moved points
    bool is_too_coarse = false;  // the triangles are too large for lines of max_width; nothing was searched
};

// Where the mean edge is longer than 0.4 of max_width, is_too_coarse is set and nothing moves. The mesh may be open.
// Throws InputError (use) for options that are negative, not finite or out of the order above, and Cancelled before a
// point has moved.
PenGrooveReport smooth_pen_grooves(TriangleMesh& mesh, const PenGrooveOptions& options = {},
                                   const Context& context = {});

}  // namespace qchopper
