// Per pose: the inverse kinematics, then what follows from the joints alone, then distances, where spheres and planes
// that bound a body tell first whether the exact distance can matter. Axes 4 and 6 may turn more than once: they are
// followed from pose to pose, and judged by their extent at the end. Some 5 to 10 microseconds a pose that is held.

#include "cam/setup/placement/pose_judge.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "base/units.h"

namespace qchopper {
namespace {

constexpr double full_turn = 2 * std::numbers::pi;
constexpr double rounding = 1e-9;    // of relative margins
constexpr double beside_mm = 60;     // farther apart, poses say nothing of the way between them
constexpr double largest_jump = 90;  // degrees, of an axis between poses beside each other
constexpr std::size_t axis_4 = 3;    // indices
constexpr std::size_t axis_6 = 5;

struct ToArmAngles {
    const ArmGeometry& arm;
    double operator()(const Joints& joints, std::size_t axis) const {
        return arm.sign[axis] * joints[axis] - arm.offset[axis];
    }
};

double forearm_length(const ArmGeometry& arm) {
    return std::hypot(arm.a2, arm.c3);
}

// How much nearer to the most or the least stretched arm a distance of the wrist centre from axis 2 could be; negative:
// it is beyond.
double stretch_margin(const ArmGeometry& arm, double distance) {
    const double fore = forearm_length(arm);
    return std::min(arm.c2 + fore - distance, distance - std::abs(arm.c2 - fore));
}

// Where inverse() has no answer.
double lack_of_reach(const ArmGeometry& arm, const Pose& flange, bool is_back) {
    const Vec3 z{flange.row[0].z, flange.row[1].z, flange.row[2].z};
    const Vec3 centre = flange.shift - arm.c4 * z;
    const double radicand = centre.x * centre.x + centre.y * centre.y - arm.b * arm.b;
    if (!(radicand >= 0)) return -std::abs(arm.b);
    const double reach = std::sqrt(radicand);
    const double x = is_back ? -reach - arm.a1 : reach - arm.a1;
    return std::min(-rounding, stretch_margin(arm, std::hypot(x, centre.z - arm.c1)));
}

double highest(const Cylinder& shape) {
    return -lowest(Cylinder{-shape.from, -shape.to, shape.radius});
}

double nearest_turn(double angle, double wanted) {
    return angle + full_turn * std::nearbyint((wanted - angle) / full_turn);
}

std::uint16_t code(BodyPart part) {
    return static_cast<std::uint16_t>(part);
}

std::uint16_t code(std::size_t number) {
    return static_cast<std::uint16_t>(number);
}

// As may_touch() names them.
int link_of(BodyPart part) {
    return part == BodyPart::spindle ? 6 : 7;
}

}  // namespace

// One pass over the poses of a region.
struct PoseJudge::Walk {
    const PoseRegion& region;
    ArmConfiguration configuration;
    Pose flange_at_origin;  // in the base, with the tip at the setup's origin
    Pose setup_in_base;
};

std::vector<double> judged_table_angles(double from, double to) {
    constexpr double step = 5 / degrees_per_radian;
    std::vector<double> angles{from};
    const double low = std::min(from, to);
    const double high = std::max(from, to);
    for (double k = std::floor(low / step) + 1; k * step < high; ++k) angles.push_back(k * step);
    angles.push_back(to);
    return angles;
}

PoseJudge::PoseJudge(const Cell& cell, const CuttingTool& tool)
    : cell_(cell), machine_(*cell.machine), feed_(tool.feed_max_mm_per_s), standing_(standing_bodies(cell)) {
    axis_bodies_ = bodies_on_axis(tool, machine_.spindle);
    on_axis_ = axis_bodies_;
    if (!machine_.robot) return;
    arm_ = tool_arm(*machine_.robot, machine_.spindle, tool);
    const Pose& tip = arm_->tip_in_flange;
    turns_by_axis_6_ = std::hypot(tip.shift.x, tip.shift.y) < 1e-6 && tip.row[2].z > 1 - 1e-12;
    links_ = machine_.robot->capsules;
    for (const LinkCapsule& link : links_) {
        is_over_tip_.push_back(is_about_tool_axis(link, *machine_.robot, machine_.spindle) ? 1 : 0);
    }
}

StandingBlock PoseJudge::standing(const Pose& setup_in_cell, const Box& block_in_setup) const {
    return {setup_in_cell, placed(setup_in_cell, block_in_setup)};
}

void PoseJudge::judge(const StandingBlock& block, Vec3 tool_axis, const PoseRegion& region, std::size_t count,
                      ArmPosture& posture, double bound, MarginTally& tally) {
    assert(count <= region.poses.size());
    const double sine = std::hypot(tool_axis.x, tool_axis.y);
    lowest_holder_ = std::numeric_limits<double>::infinity();
    for (const AxisBody& body : axis_bodies_) {
        if (body.part == BodyPart::tool) continue;
        lowest_holder_ = std::min(lowest_holder_, -body.shape.from.z * tool_axis.z - sine * body.shape.radius);
    }
    joints_.assign(count, std::nullopt);
    Walk walk{region, posture.configuration, {}, {}};
    const Pose frame = tip_frame({}, tool_axis, posture.redundancy_angle);
    if (arm_) {
        walk.setup_in_base = inverse(arm_->base_in_cell) * block.setup_in_cell;
        walk.flange_at_origin = walk.setup_in_base * (frame * inverse(arm_->tip_in_flange));
    }
    for (std::size_t i = 0; i < count && tally.score() >= bound; ++i) {
        const MillingPose& pose = region.poses[i];
        tally.set_pose(i);
        if (lowest_holder_ < 1e9) tally.add(PoseCheck::holder_to_block, pose.tip.z + lowest_holder_, {});
        if (arm_) {
            joints_[i] = joints_at(walk, i, rotate(walk.setup_in_base, pose.tip), tally);
            if (!joints_[i] || tally.score() < bound) continue;
            const double link_feed = pose.kind == PoseKind::retract ? machine_.program.link_feed_mm_per_s : 0;
            judge_pose(block, std::max(feed_, link_feed), *joints_[i], bound, tally);
            if (tally.score() < bound) continue;
        } else {
            judge_travel(apply(block.setup_in_cell, pose.tip), rotate(block.setup_in_cell, tool_axis), tally);
        }
        place_axis(apply(block.setup_in_cell, pose.tip), rotate(block.setup_in_cell, tool_axis));
        judge_tool(block, false, tally);
    }
    if (arm_ && tally.score() >= bound) finish_turning_axes(posture, tally);
}

void PoseJudge::judge_travel(Vec3 tip, Vec3 tool_axis, MarginTally& tally) const {
    const double upright = std::hypot(tool_axis.x, tool_axis.y) < 1e-6 && tool_axis.z > 0 ? 0 : -1;
    for (int axis = 0; axis < 3; ++axis) {
        const auto number = code(static_cast<std::size_t>(axis));
        tally.add(PoseCheck::travel, tip[axis] - cell_.workspace.min[axis], {number, 0});
        tally.add(PoseCheck::travel, cell_.workspace.max[axis] - tip[axis], {number, 1});
    }
    if (upright < 0) tally.add(PoseCheck::travel, -1000 * std::hypot(tool_axis.x, tool_axis.y), {3, 0});
}

std::optional<Joints> PoseJudge::joints_at(const Walk& walk, std::size_t index, Vec3 tip_in_base,
                                           MarginTally& tally) const {
    const MillingPose& pose = walk.region.poses[index];
    const std::optional<Joints>* beside = pose.beside == index ? nullptr : &joints_[pose.beside];
    if (beside != nullptr && !*beside) beside = joints_.front() ? &joints_.front() : nullptr;
    Joints wanted{};
    for (std::size_t axis = 0; axis < axes_of_arm; ++axis) {
        wanted[axis] = beside != nullptr ? (**beside)[axis] : 0.5 * (arm_->ranges[axis].min + arm_->ranges[axis].max);
    }
    const Pose flange{walk.flange_at_origin.row, walk.flange_at_origin.shift + tip_in_base};
    const ArmAnswers answers = inverse(arm_->geometry, flange, wanted);
    const auto* answer = std::find_if(answers.begin(), answers.end(),
                                      [&](const ArmAnswer& a) { return a.configuration == walk.configuration; });
    if (answer == answers.end()) {
        tally.add(PoseCheck::reach, lack_of_reach(arm_->geometry, flange, walk.configuration.is_back), {});
        return std::nullopt;
    }
    Joints joints = answer->joints;
    double jump = 0;
    for (std::size_t axis = 0; axis < axes_of_arm; ++axis) {
        joints[axis] = nearest_turn(joints[axis], wanted[axis]);
        jump = std::max(jump, std::abs(joints[axis] - wanted[axis]));
    }
    if (beside != nullptr && norm(pose.tip - walk.region.poses[pose.beside].tip) < beside_mm) {
        tally.add(PoseCheck::axis_step, largest_jump - jump * degrees_per_radian, {});
    }
    return joints;
}

void PoseJudge::judge_limit(std::size_t axis, double joint, std::uint16_t side, MarginTally& tally) const {
    const Robot& robot = *machine_.robot;
    const auto beyond = [&](double min, double max) {
        return degrees_per_radian * (side == 0 ? joint - min : max - joint);
    };
    const auto number = code(axis + 1);
    tally.add(PoseCheck::joint_limit, beyond(robot.ranges[axis].min, robot.ranges[axis].max), {number, side});
    if (!robot.cable || (axis != axis_4 && axis != axis_6)) return;
    const AngleRange& cable = axis == axis_4 ? robot.cable->axis_4 : robot.cable->axis_6;
    tally.add(PoseCheck::cable, beyond(cable.min, cable.max), {number, side});
}

void PoseJudge::judge_pose(const StandingBlock& block, double feed, const Joints& joints, double bound,
                           MarginTally& tally) {
    for (const std::size_t axis : {0U, 1U, 2U, 4U}) {
        judge_limit(axis, joints[axis], 0, tally);
        judge_limit(axis, joints[axis], 1, tally);
    }
    judge_singularity(joints, tally);
    place_links(joints);
    if (tally.score() < bound) return;
    judge_links(block, true, tally);
    if (tally.score() < bound) return;
    judge_speed(joints, feed, tally);
}

void PoseJudge::judge_singularity(const Joints& joints, MarginTally& tally) const {
    const ArmGeometry& arm = arm_->geometry;
    const ToArmAngles angle{arm};
    const double fore = forearm_length(arm);
    const double bend = angle(joints, 2) + std::atan2(arm.a2, arm.c3);
    const double from_axis_2 = std::sqrt(arm.c2 * arm.c2 + fore * fore + 2 * arm.c2 * fore * std::cos(bend));
    const double from_axis_1 = arm.c2 * std::sin(angle(joints, 1)) + fore * std::sin(angle(joints, 1) + bend) + arm.a1;
    tally.add(PoseCheck::reach, stretch_margin(arm, from_axis_2), {});
    tally.add(PoseCheck::elbow, 100 * (1 - from_axis_2 / (arm.c2 + fore)), {});
    tally.add(PoseCheck::shoulder, std::abs(from_axis_1), {});
    tally.add(PoseCheck::wrist, degrees_per_radian * std::asin(std::min(1.0, std::abs(std::sin(angle(joints, 4))))),
              {});
}

void PoseJudge::judge_speed(const Joints& joints, double feed, MarginTally& tally) const {
    const std::optional<Joints> speeds = largest_joint_speeds(arm_->geometry, joints);
    for (std::size_t axis = 0; axis < axes_of_arm; ++axis) {
        const double limit = degrees_per_radian * machine_.robot->ranges[axis].speed;
        const double left = speeds ? limit - degrees_per_radian * feed * (*speeds)[axis] : -limit;
        tally.add(PoseCheck::joint_speed, left, {code(axis + 1), 0});
    }
}

void PoseJudge::place_links(const Joints& joints) {
    const LinkMotions motions = link_motions(arm_->geometry, joints, arm_->base_in_cell);
    for (std::size_t i = 0; i < links_.size(); ++i) {
        const LinkCapsule& own = machine_.robot->capsules[i];
        links_[i].shape = moved(motions[static_cast<std::size_t>(own.link)], own.shape);
    }
}

void PoseJudge::place_axis(Vec3 tip, Vec3 tool_axis) {
    for (std::size_t i = 0; i < axis_bodies_.size(); ++i) {
        on_axis_[i].shape.from = tip - axis_bodies_[i].shape.from.z * tool_axis;
        on_axis_[i].shape.to = tip - axis_bodies_[i].shape.to.z * tool_axis;
    }
}

void PoseJudge::judge_links(const StandingBlock& block, bool is_milling, MarginTally& tally) const {
    for (std::size_t i = 0; i < links_.size(); ++i) {
        const auto& [link, shape] = links_[i];
        const auto number = static_cast<std::uint16_t>(link);
        for (std::size_t j = 0; j < i; ++j) {
            if (may_touch(link, links_[j].link)) continue;
            tally.add(PoseCheck::arm_to_arm, distance(shape, links_[j].shape),
                      {number, static_cast<std::uint16_t>(links_[j].link)});
        }
        if (link == 0) continue;
        if (link > 1) tally.add(PoseCheck::arm_to_floor, lowest(shape) - standing_.floor_z, {number, 0});
        if (!is_milling || is_over_tip_[i] == 0) {
            tally.add(PoseCheck::arm_to_block, distance(shape, block.block), {number, 0});
        }
        if (standing_.table) tally.add(PoseCheck::arm_to_table, distance(shape, *standing_.table), {number, 0});
        if (standing_.rotary && tally.wants(PoseCheck::arm_to_table, lowest(shape) - highest(*standing_.rotary))) {
            tally.add(PoseCheck::arm_to_table, distance(shape, *standing_.rotary), {number, 0});
        }
        for (std::size_t k = 0; k < standing_.obstacles.size(); ++k) {
            tally.add(PoseCheck::arm_to_obstacle, distance(shape, standing_.obstacles[k]), {number, code(k)});
        }
    }
}

void PoseJudge::judge_tool(const StandingBlock& block, bool is_home, MarginTally& tally) const {
    for (const AxisBody& body : on_axis_) {
        const MarginPair pair{code(body.part), 0};
        const Capsule bound = around(body.shape);
        const double low = lowest(body.shape);
        tally.add(PoseCheck::tool_to_floor, low - standing_.floor_z, pair);
        if (standing_.table && tally.wants(PoseCheck::tool_to_table, low - cell_.table.height)) {
            tally.add(PoseCheck::tool_to_table, distance(body.shape, *standing_.table), pair);
        }
        if (standing_.rotary && tally.wants(PoseCheck::tool_to_table, low - highest(*standing_.rotary))) {
            tally.add(PoseCheck::tool_to_table, distance(body.shape, *standing_.rotary), pair);
        }
        for (std::size_t k = 0; k < standing_.obstacles.size(); ++k) {
            if (!tally.wants(PoseCheck::tool_to_obstacle, distance(bound, standing_.obstacles[k]))) continue;
            tally.add(PoseCheck::tool_to_obstacle, distance(body.shape, standing_.obstacles[k]), {pair.first, code(k)});
        }
        for (const LinkCapsule& link : links_) {
            if (may_touch(link_of(body.part), link.link)) continue;
            if (!tally.wants(PoseCheck::tool_to_arm, distance(link.shape, bound))) continue;
            const auto number = static_cast<std::uint16_t>(link.link);
            tally.add(PoseCheck::tool_to_arm, distance(link.shape, body.shape), {pair.first, number});
        }
        if (!is_home || !tally.wants(PoseCheck::tool_to_block, distance(bound, block.block))) continue;
        tally.add(PoseCheck::tool_to_block, distance(body.shape, block.block), pair);
    }
}

// Axis 4 by whole turns into the middle of its range; axis 6 too, or freely.
void PoseJudge::finish_turning_axes(ArmPosture& posture, MarginTally& tally) {
    for (const std::size_t axis : {axis_4, axis_6}) {
        JointExtent extent;
        bool is_first = true;
        for (std::size_t i = 0; i < joints_.size(); ++i) {
            if (!joints_[i]) continue;
            const double joint = (*joints_[i])[axis];
            if (is_first || joint < extent.min) extent.min = joint, extent.min_pose = i;
            if (is_first || joint > extent.max) extent.max = joint, extent.max_pose = i;
            is_first = false;
        }
        if (is_first) return;
        const JointRange& range = arm_->ranges[axis];
        double shift = 0.5 * (range.min + range.max - extent.min - extent.max);
        const bool is_free = axis == axis_6 && posture.turns_freely;
        if (!is_free) shift = nearest_turn(0, shift);
        if (is_free) {
            posture.redundancy_angle =
                std::remainder(posture.redundancy_angle + arm_->geometry.sign[axis] * shift, full_turn);
        }
        for (std::optional<Joints>& joints : joints_) {
            if (joints) (*joints)[axis] += shift;
        }
        tally.set_pose(extent.min_pose);
        judge_limit(axis, extent.min + shift, 0, tally);
        tally.set_pose(extent.max_pose);
        judge_limit(axis, extent.max + shift, 1, tally);
    }
}

void PoseJudge::judge_home(const StandingBlock& block, MarginTally& tally) {
    tally.set_pose(0);
    if (!arm_) {
        judge_travel(machine_.start.tip, {0, 0, 1}, tally);
        place_axis(machine_.start.tip, {0, 0, 1});
        return judge_tool(block, true, tally);
    }
    judge_joints(block, machine_.start.joints, tally);
}

void PoseJudge::judge_joints(const StandingBlock& block, const Joints& joints, MarginTally& tally) {
    assert(arm_);
    for (std::size_t axis = 0; axis < axes_of_arm; ++axis) {
        judge_limit(axis, joints[axis], 0, tally);
        judge_limit(axis, joints[axis], 1, tally);
    }
    place_links(joints);
    judge_links(block, false, tally);
    const Pose tip = arm_->base_in_cell * (forward(arm_->geometry, joints) * arm_->tip_in_flange);
    place_axis(tip.shift, -Vec3{tip.row[0].z, tip.row[1].z, tip.row[2].z});
    judge_tool(block, true, tally);
}

}  // namespace qchopper
