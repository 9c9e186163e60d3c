// Directions in which a tool comes to drill and to nothing else: they follow those of the setup.
//
// mm, radians. The setup chooses its directions for what they reach of the surface; a hole needs the normal of its cap,
// which seldom is one of them. tests/cam/program/hold_drilling_test.cpp.

#pragma once

#include <span>

#include "base/vec3.h"
#include "cam/setup/setup.h"

namespace qchopper {

struct DrillDirection {
    Vec3 out{0, 0, 1};       // unit, in setup coordinates: the way the tool comes out
    double table_angle = 0;  // of a rotary table while it is used; else 0
    bool operator==(const DrillDirection&) const = default;
};

// The setup with these directions behind its own, so that an index counts through both. Its table angles, if it has
// any, are one per direction again.
Setup with_drill_directions(Setup setup, std::span<const DrillDirection> drilling);

}  // namespace qchopper
