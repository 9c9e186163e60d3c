// Where a ball-ended tool fits: surface that is in sight of the tool but too narrow for it.
//
// mm. A ball of radius r that touches the surface at p from outside has its centre at p + r n; it fits if no surface is
// nearer to the centre than r. A larger ball never fits where a smaller one does not
// (tests/segment/score/tool_fit_test.cpp).

#pragma once

#include <span>
#include <vector>

#include "segment/mesh/triangle_mesh.h"
#include "segment/score/surface_samples.h"

namespace qchopper {

struct BallFit {
    double radius = 0;     // > 0
    double allowance = 0;  // of foam that is left on the surface: the centre stands at p + (r + allowance) n
};

// Per sample whether the ball does not fit. Triangles of which is_left_out is true (one per triangle, or empty) hinder
// no ball: caps, because another piece or the table lies there. The samples lie on the mesh. In parallel, the same
// result for any number of threads.
std::vector<bool> too_narrow(const TriangleMesh& mesh, const std::vector<bool>& is_left_out,
                             std::span<const SurfaceSample> samples, const BallFit& ball);

}  // namespace qchopper
