// The surface of the target and of the floor of the spoil layer below it, seen along a direction.
//
// mm. Of each cell the highest point over its centre, and the points of the mesh that lie in it
// (tests/sim/replay/reach/target_surface_test.cpp).

#pragma once

#include <cstddef>
#include <cstdint>

#include "sim/replay/reach/surface_map.h"
#include "sim/replay/scene.h"

namespace qchopper {

// `around` cells wider than the target on each side. A cell has the same height on every map of its size.
SurfaceMap target_surface(const ReplayScene& scene, std::size_t orientation, double cell, std::int32_t around);

// Without so many cells on each side. Precondition: it has more.
SurfaceMap narrowed(const SurfaceMap& wide, std::int32_t by);

}  // namespace qchopper
