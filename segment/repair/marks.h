// Lifts the dents that a marker pen leaves in a laser scan: narrow, shallow, like lines.
//
// The scanner reads dark shining ink as a little too far away (Nicholson 2016, section 1.2.3). Lengths are mm. Only the
// bottom and the flanks of a dent move, along the normal, up to the surface around it; every other point keeps its
// coordinates to the last bit, and triangles stay as they are (tests/segment/repair/marks_test.cpp).

#pragma once

#include <cstddef>

#include "base/context.h"
#include "segment/mesh/measure.h"

namespace qchopper {

// What a mark is. The defaults are those of a marker pen; a dent that is wider or deeper is taken for the animal's own.
struct MarkOptions {
    double most_width = 6;    // across the line
    double most_depth = 1;    // of the bottom below the surface around it
    double least_depth = 0;   // of the bottom; 0: four times the roughness around, and at least 0.02 mm
    double least_length = 0;  // of the line; 0: three times most_width
};

struct MarkReport {
    std::size_t marks = 0;  // connected dents
    std::size_t points_moved = 0;
    double area_mm2 = 0;         // of the triangles that moved
    double length_mm = 0;        // of all lines together
    double most_depth = 0;       // the farthest that a point moved
    double mean_depth = 0;       // mean over the points that moved
    Box box;                     // around all that moved
    bool is_too_coarse = false;  // the triangles are too large to tell a line that narrow; nothing was looked at
};

// Needs triangles smaller than the line is wide: where they are larger no mark can be told, and nothing moves. The mesh
// may be open. Throws InputError (use) for options that make no sense.
MarkReport smooth_marks(TriangleMesh& mesh, const MarkOptions& options = {}, const Context& context = {});

}  // namespace qchopper
