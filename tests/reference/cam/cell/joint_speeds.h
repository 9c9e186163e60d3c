// The speeds of the joints for one velocity of the tool tip: what largest_joint_speeds() (cam/cell/arm.h) is the
// largest of.
//
// mm, radians, seconds.

#pragma once

#include <optional>

#include "cam/cell/arm.h"

namespace qchopper {

// Along x, y, z of the base.
struct CartesianVelocity {
    Vec3 linear;   // mm/s
    Vec3 angular;  // rad/s
};

// Speeds of the joints (radians/s) at which the tool tip has a velocity; tip_in_flange is the tool tip in the frame of
// the flange (mm). Nothing at a singularity, or if an argument is not finite: singular is a pivot of at most 1e-9 when
// lengths are divided by that of the stretched arm.
std::optional<Joints> joint_speeds(const ArmGeometry& arm, const Joints& joints, Vec3 tip_in_flange,
                                   const CartesianVelocity& tip);

}  // namespace qchopper
