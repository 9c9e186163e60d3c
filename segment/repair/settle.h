// The steps of repair() that make closed shells of a surface, over and over until none of them makes work for another.

#pragma once

#include <cstddef>
#include <string>

#include "base/context.h"
#include "segment/mesh/triangle_mesh.h"
#include "segment/repair/options.h"
#include "segment/repair/report.h"
#include "segment/repair/source_faces.h"

namespace qchopper {

// A scan on its way through the steps.
struct RepairState {
    TriangleMesh mesh;
    SourceFaces sources;  // of the mesh
    RepairReport report;
};

struct StepProgress {
    const Context& context;
    std::size_t steps = 0;  // begun so far
    void begin(const std::string& what) {
        context.check_cancelled();
        context.progress(what, ++steps, 0);
    }
};

// Equal points must have been welded. At most twelve passes; what they did is added to the report.
void settle(RepairState& state, const RepairOptions& options, StepProgress& progress);

}  // namespace qchopper
