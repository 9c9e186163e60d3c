// The cap triangulation of last resort: bridges holes to their outer loop and cuts ears.
//
// Always N + 2L - 4 triangles whose edges match the loops, whatever the geometry; good triangles where it can.

#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "segment/mesh/polygon.h"

namespace qchopper {

std::vector<std::array<std::uint32_t, 3>> clip_ears(std::span<const Point2> points, const Loop& outer,
                                                    std::span<const Loop> holes);

}  // namespace qchopper
