// The steps of repair() that make closed shells of a surface, repeated until a pass over them changes nothing.

#pragma once

#include <cstddef>
#include <string>

#include "base/context.h"
#include "segment/mesh/triangle_mesh.h"
#include "segment/repair/options.h"
#include "segment/repair/report.h"
#include "segment/repair/source_faces.h"

namespace qchopper {

// A scan during its repair.
struct RepairState {
    TriangleMesh mesh;
    SourceFaces sources;  // of the mesh
    RepairReport report;
};

struct StepProgress {
    const Context& context;
    std::size_t steps = 0;  // begun so far
    // `what` names the step, as "edges paired". Throws Cancelled if the context asks for it.
    void begin(const std::string& what) {
        context.check_cancelled();
        context.progress("steps of the repair (" + what + ")", ++steps, 0);
    }
};

// Precondition: equal points are welded, the mesh has no caps. At most twelve passes; their counts are added to the
// report.
void settle(RepairState& state, const RepairOptions& options, StepProgress& progress);

}  // namespace qchopper
