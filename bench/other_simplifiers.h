// The simplification of meshoptimizer, for comparison.

#pragma once

#include <cstddef>
#include <optional>

#include "segment/mesh/triangle_mesh.h"

namespace qchopper::bench {

struct OtherSimplified {
    TriangleMesh mesh;   // with all points of the input
    double seconds = 0;  // CPU time of this thread, conversions left out
};

// Without a limit of the error. Nothing if this bench was built without meshoptimizer.
std::optional<OtherSimplified> meshoptimizer_simplify(const TriangleMesh& mesh, std::size_t faces);

}  // namespace qchopper::bench
