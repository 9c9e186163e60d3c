// Ways are tried from the shortest on: straight in the joints, then by a pose over home that already faces the goal,
// with the tool retracted farther and farther. Where the block is higher than the tool at home the same ways are tried
// from above home: a turn of axis 1 alone would take the tool into a block beside it. Some 5 microseconds a sample.

#include "cam/program/ptp_planner.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/units.h"
#include "cam/cell/reach_map.h"
#include "cam/program/posture_search.h"
#include "cam/program/sampled_path.h"

namespace qchopper {
namespace {

constexpr double full_turn = 2 * std::numbers::pi;
constexpr double longest_step = radians(0.5);  // some 20 mm of the tip
constexpr double coarse_step = radians(2);
constexpr double rounding = 1e-9;  // of relative margins
constexpr std::array<double, 5> retracts{0, 50, 100, 200, 400};

Joints between(const Joints& from, const Joints& to, double share) {
    Joints joints{};
    for (std::size_t i = 0; i < axes_of_arm; ++i) joints[i] = from[i] + share * (to[i] - from[i]);
    return joints;
}

int steps_of(double change, double longest) {
    return std::max(1, static_cast<int>(std::ceil(change / longest - 1e-9)));
}

// Ways by which a goal is come to from home, without both ends: none, home facing the goal, and with the wrist turned.
std::vector<std::vector<Joints>> middles(const Joints& home, const Joints& goal) {
    Joints facing = home;
    facing[0] = goal[0];
    Joints turned = goal;
    turned[1] = home[1];
    turned[2] = home[2];
    return {{}, {facing}, {turned}, {facing, turned}};
}

}  // namespace

PtpPlanner::PtpPlanner(const Setup& setup, const Cell& cell, std::size_t tool)
    : setup_(setup),
      cell_(cell),
      slow_tool_(slowed(cell.machine->tools[tool])),
      judge_(cell, slow_tool_),
      home_(cell.machine->start.joints) {}

StandingBlock PtpPlanner::standing_at(double table_angle) const {
    const Pose in_cell = table_in_cell(cell_, table_angle) * setup_in_table(setup_.placement, setup_.spoil);
    return judge_.standing(in_cell, setup_.block_box());
}

bool PtpPlanner::is_clear(const StandingBlock& block, const Joints& joints) {
    MarginTally tally;
    judge_.judge_joints(block, joints, tally);
    if (tally.score() >= -rounding) return true;
    for (std::size_t i = 0; i < pose_checks; ++i) {
        const auto check = static_cast<PoseCheck>(i);
        const TightestMargin& tightest = tally.of(check);
        if (tightest.relative >= -rounding) continue;
        refusal_ = describe_pair(cell_, check, tightest.pair);
        break;
    }
    return false;
}

bool PtpPlanner::is_clear(const StandingBlock& block, const Joints& from, const Joints& to, double step) {
    double change = 0;
    for (std::size_t i = 0; i < axes_of_arm; ++i) change = std::max(change, std::abs(to[i] - from[i]));
    const int steps = steps_of(change, step);
    for (int i = 0; i <= steps; ++i) {
        if (!is_clear(block, between(from, to, static_cast<double>(i) / steps))) return false;
    }
    return true;
}

std::optional<Joints> PtpPlanner::retracted(const OperationEnd& end, double retract, double& speed) {
    speed = end.operation->link_feed;
    if (retract == 0) return end.joints;
    const ProgramOperation& operation = *end.operation;
    const std::vector<PathRun> runs{{end.tip, {{end.tip + retract * operation.tool_axis, MoveKind::retract, false}}}};
    const SampledPath path = sampled_path(runs);
    ArmPosture posture{operation.configuration, operation.redundancy_angle, false};
    MarginTally tally(false);
    const StandingBlock block = standing_at(operation.table_angle);
    judge_.judge(block, operation.tool_axis, path.region, path.region.poses.size(), posture, -rounding, tally);
    if (tally.score() < -rounding) return std::nullopt;
    const ToolArm arm = tool_arm(*cell_.machine->robot, cell_.machine->spindle, slow_tool_);
    for (std::size_t i = 1; i < path.poses(); ++i) {
        const double length = norm(path.region.poses[i].tip - path.region.poses[i - 1].tip);
        speed = std::min(speed, followed_speed(arm.ranges, *judge_.joints()[i - 1], *judge_.joints()[i], length));
    }
    Joints joints = *judge_.joints().back();
    for (std::size_t axis = 0; axis < axes_of_arm; ++axis) {
        joints[axis] += full_turn * std::nearbyint((end.joints[axis] - (*judge_.joints().front())[axis]) / full_turn);
    }
    if (!is_within(arm.ranges, arm.margin, joints)) return std::nullopt;
    return joints;
}

std::optional<Joints> PtpPlanner::over_home(const StandingBlock& block) const {
    const ToolArm arm = tool_arm(*cell_.machine->robot, cell_.machine->spindle, slow_tool_);
    Pose flange = forward(arm.geometry, home_);
    const Vec3 tip = apply(arm.base_in_cell * flange * arm.tip_in_flange, Vec3{});
    const double top = apply(block.setup_in_cell, setup_.block_box().max).z;
    const double rise = top + cell_.clearance + rule_of(PoseCheck::tool_to_block).needed - tip.z;
    if (rise <= 0) return std::nullopt;
    flange.shift = flange.shift + rotate(inverse(arm.base_in_cell), {0, 0, rise});
    const ArmConfiguration own = configuration_of(arm.geometry, home_);
    for (const ArmAnswer& answer : inverse_within(arm.geometry, arm.ranges, arm.margin, flange, home_)) {
        if (answer.configuration == own) return answer.joints;
    }
    return std::nullopt;
}

bool PtpPlanner::is_clear(const StandingBlock& block, const std::vector<Joints>& targets) {
    Joints from = home_;
    return std::all_of(targets.begin(), targets.end(), [&](const Joints& to) {
        const bool is_free_leg = is_clear(block, from, to, longest_step);
        from = to;
        return is_free_leg;
    });
}

std::optional<PtpPath> PtpPlanner::from_home(const OperationEnd& end) {
    const StandingBlock block = standing_at(end.operation->table_angle);
    const std::optional<Joints> over = over_home(block);
    for (const double retract : retracts) {
        double speed = 0;
        const std::optional<Joints> goal = retracted(end, retract, speed);
        if (!goal) continue;
        for (std::vector<Joints>& targets : middles(home_, *goal)) {
            targets.push_back(*goal);
            if (is_clear(block, targets)) return PtpPath{retract, speed, targets};
        }
        if (!over) continue;
        for (std::vector<Joints>& targets : middles(*over, *goal)) {
            targets.insert(targets.begin(), *over);
            targets.push_back(*goal);
            if (is_clear(block, targets)) return PtpPath{retract, speed, targets};
        }
    }
    return std::nullopt;
}

bool PtpPlanner::starts_clear(const OperationEnd& end) {
    return is_clear(standing_at(end.operation->table_angle), home_, end.joints, coarse_step);
}

bool PtpPlanner::turns_clear(double from_angle, double to_angle) {
    const std::vector<double> angles = judged_table_angles(from_angle, to_angle);
    return std::all_of(angles.begin(), angles.end(), [&](double angle) { return is_clear(standing_at(angle), home_); });
}

}  // namespace qchopper
