// Makes a closed solid of a scan by the steps of docs/user/repair.md, changing as little as possible.
//
// Points and triangles that no step touches keep their bits and their order (-0.0 becomes 0.0). A second repair changes
// nothing (tests/segment/repair/repair_test.cpp). What cannot be made a solid is returned with a report of what is left
// open; that is no error. The mesh may be in any unit and at any place; lengths in the options are mm.

#pragma once

#include "base/context.h"
#include "segment/mesh/triangle_mesh.h"
#include "segment/repair/options.h"
#include "segment/repair/report.h"

namespace qchopper {

struct Repaired {
    TriangleMesh mesh;  // has no caps
    RepairReport report;
};

// Precondition: corners of triangles are numbers of points, and coordinates are finite. Caps are dropped. Throws
// InputError (use) for lengths in the options that are negative or not finite, what smooth_pen_grooves and alpha_wrap
// throw, and Cancelled.
Repaired repair(TriangleMesh scan, const RepairOptions& options = {}, const Context& context = {});

}  // namespace qchopper
