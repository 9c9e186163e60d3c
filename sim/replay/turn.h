// Rotations of a replay: frames as a program states them, and how far two poses turn from each other.
//
// O(1) (tests/sim/replay/replay_test.cpp).

#pragma once

#include "base/pose.h"
#include "base/units.h"
#include "sim/program/parsed_program.h"

namespace qchopper {

Pose pose_of(const ProgramFrame& frame);

// A rotation about z, radians.
Pose about_z(double angle);

// The j-th axis of the pose's frame.
Vec3 column(const Pose& pose, int j);

// An angle in radians about an axis.
struct Turn {
    double angle = 0;
    Vec3 axis{0, 0, 1};
};

// From the first pose to the second, about an axis of the first; the shifts do not count.
Turn turn_between(const Pose& a, const Pose& b);

// The pose turned by a share of a turn about its own axes.
Pose turned(const Pose& pose, const Turn& turn, double share);

}  // namespace qchopper
