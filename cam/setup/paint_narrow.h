// Marks the triangles of a piece around the samples at which the tool's ball does not fit, for pictures.

#pragma once

#include <vector>

#include "cam/setup/surface_access.h"
#include "segment/access/surface_samples.h"
#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

// A triangle that is `reached` becomes `too_narrow` if the nearest sample, within the spacing of the samples, is too
// narrow. One entry of is_narrow per sample, one state per triangle. O(triangles + samples).
void paint_narrow(const TriangleMesh& mesh, const SurfaceSamples& samples, const std::vector<bool>& is_narrow,
                  std::vector<SurfaceState>& states);

}  // namespace qchopper
