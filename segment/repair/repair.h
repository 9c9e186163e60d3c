// Makes a closed solid of a scan, changing as little as that takes: the order of steps of docs/repair.md.
//
// Points and triangles that no step touches keep their bits and their order. Repairing twice is repairing once
// (tests/segment/repair/repair_test.cpp). What cannot be made a solid comes back with what is left open, never as an
// error. The mesh may be in any unit and anywhere; lengths in the options are mm.

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

// Throws InputError (use) for lengths that make no sense.
Repaired repair(TriangleMesh scan, const RepairOptions& options = {}, const Context& context = {});

}  // namespace qchopper
