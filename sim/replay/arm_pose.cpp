// Distances of simple shapes (cam/cell/shape_distance.h); only overlapping is refused.

#include "sim/replay/arm_pose.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/text.h"
#include "sim/replay/turn.h"

namespace qchopper {
namespace {

constexpr double min_gap = 1e-6;  // mm
constexpr ArmThresholds thresholds{};

const char* word_of(BodyPart part) {
    constexpr const char* words[] = {"link", "spindle", "holder", "tool"};  // in the order of BodyPart
    return words[static_cast<std::size_t>(part)];
}

}  // namespace

void ArmPoses::check_joints(const Joints& joints, SourcePlace place) {
    const Robot& robot = *cell_.machine->robot;
    const auto check = [&](FindingKind kind, std::size_t axis, double min, double max) {
        const double beyond = std::max(min - joints[axis], joints[axis] - max) / degree;
        if (beyond <= 1e-6) return;
        log_.add(kind, place, beyond, beyond, [&] {
            return "axis " + std::to_string(axis + 1) + " is " + fixed(beyond, 2) + " degrees beyond its range";
        });
    };
    for (std::size_t axis = 0; axis < axes_of_arm; ++axis) {
        check(FindingKind::joint_limit, axis, robot.ranges[axis].min, robot.ranges[axis].max);
    }
    if (!robot.cable) return;
    check(FindingKind::cable, 3, robot.cable->axis_4.min, robot.cable->axis_4.max);
    check(FindingKind::cable, 5, robot.cable->axis_6.min, robot.cable->axis_6.max);
}

void ArmPoses::check_singularity(const Joints& joints, SourcePlace place) {
    const ArmSingularity at = singularity(cell_.machine->robot->geometry, joints);
    const auto refuse = [&](const char* which, double value) {
        log_.add(FindingKind::singularity, place, value, -value,
                 [&] { return std::string("the arm is next to its ") + which + " singularity"; });
    };
    if (at.wrist < std::sin(thresholds.wrist_deg * degree)) refuse("wrist", at.wrist);
    if (at.shoulder < thresholds.shoulder_mm) refuse("shoulder", at.shoulder);
    if (at.elbow < thresholds.elbow) refuse("elbow", at.elbow);
}

std::optional<Joints> ArmPoses::follow(const Pose& flange, const Joints& now) const {
    const ArmGeometry& arm = cell_.machine->robot->geometry;
    const ArmConfiguration configuration = configuration_of(arm, now);
    const ArmAnswers answers = inverse(arm, flange, now);
    for (const ArmAnswer& answer : answers) {
        if (!(answer.configuration == configuration)) continue;
        Joints joints = answer.joints;
        for (std::size_t axis = 0; axis < axes_of_arm; ++axis) {
            joints[axis] = now[axis] + std::remainder(joints[axis] - now[axis], 2 * std::numbers::pi);
        }
        return joints;
    }
    return std::nullopt;
}

void ArmPoses::collide(const std::string& what, SourcePlace place) {
    log_.add(FindingKind::collision, place, what);
}

template <class Shape>
bool ArmPoses::meets_table(const Shape& shape) const {
    return (standing_.table && distance(shape, *standing_.table) <= min_gap) ||
           (standing_.rotary && distance(shape, *standing_.rotary) <= min_gap);
}

void ArmPoses::check_bodies(const Joints& joints, const CuttingTool& tool, const PlacedBox& block, bool is_milling,
                            SourcePlace place) {
    const MovingBodies bodies = bodies_at(cell_, tool, joints);
    check_links(bodies, place);
    check_block(bodies, block, is_milling, place);
    for (const AxisBody& body : bodies.on_axis) check_axis_body(bodies, body, place);
}

void ArmPoses::check_links(const MovingBodies& bodies, SourcePlace place) {
    for (std::size_t i = 0; i < bodies.links.size(); ++i) {
        const LinkCapsule& link = bodies.links[i];
        const std::string name = "link " + std::to_string(link.link);
        for (std::size_t j = 0; j < i; ++j) {
            const LinkCapsule& other = bodies.links[j];
            if (may_touch(link.link, other.link) || distance(link.shape, other.shape) > min_gap) continue;
            collide(name + " meets link " + std::to_string(other.link), place);
        }
        if (link.link == 0) continue;
        if (link.link > 1 && lowest(link.shape) < standing_.floor_z) collide(name + " meets the floor", place);
        if (meets_table(link.shape)) collide(name + " meets the table", place);
        for (const PlacedBox& box : standing_.obstacles) {
            if (distance(link.shape, box) <= min_gap) collide(name + " meets an obstacle", place);
        }
    }
}

void ArmPoses::check_block(const MovingBodies& bodies, const PlacedBox& block, bool is_milling, SourcePlace place) {
    const CellMachine& machine = *cell_.machine;
    for (std::size_t i = 0; i < bodies.links.size(); ++i) {
        if (is_milling && is_about_tool_axis(machine.robot->capsules[i], *machine.robot, machine.spindle)) continue;
        if (distance(bodies.links[i].shape, block) > min_gap) continue;
        collide("link " + std::to_string(bodies.links[i].link) + " meets the block", place);
    }
}

void ArmPoses::check_axis_body(const MovingBodies& bodies, const AxisBody& body, SourcePlace place) {
    const std::string name = word_of(body.part);
    const double low = lowest(body.shape);
    if (low < standing_.floor_z) collide(name + " meets the floor", place);
    const double table_top =
        standing_.rotary ? standing_.rotary->from.z + standing_.rotary->radius * 0.02 : cell_.table.height;
    if (low <= table_top + min_gap && meets_table(body.shape)) collide(name + " meets the table", place);
    for (const PlacedBox& box : standing_.obstacles) {
        if (distance(around(body.shape), box) <= min_gap && distance(body.shape, box) <= min_gap) {
            collide(name + " meets an obstacle", place);
        }
    }
    const int own = body.part == BodyPart::spindle ? 6 : 7;
    for (const LinkCapsule& link : bodies.links) {
        if (may_touch(own, link.link) || distance(link.shape, around(body.shape)) > min_gap) continue;
        if (distance(link.shape, body.shape) <= min_gap) {
            collide(name + " meets link " + std::to_string(link.link), place);
        }
    }
}

}  // namespace qchopper
