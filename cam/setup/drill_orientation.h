// Directions in which a tool comes to drill and to nothing else: they follow those of the setup.
//
// mm, radians. The setup chooses its directions for what they reach of the surface; a hole needs the normal of its cap,
// which seldom is one of them. tests/cam/program/reachable_holes_test.cpp.

#pragma once

#include <span>

#include "base/vec3.h"
#include "cam/setup/setup.h"

namespace qchopper {

struct DrillOrientation {
    Vec3 tool_axis{0, 0, 1};  // unit, in setup coordinates, from the tip into the spindle
    double table_angle = 0;   // of a rotary table while it is used; else 0
    bool operator==(const DrillOrientation&) const = default;
};

// The setup with these directions behind its own, so that an index counts through both. Its table angles, if it has
// any, are one per direction again.
Setup with_drill_orientations(Setup setup, std::span<const DrillOrientation> drilling);

}  // namespace qchopper
