// Step by step, with the joints, the table and the spindle as the state. Ways of the tip are linear in position and
// turn about one axis. O(poses * bodies^2).

#include "sim/replay/walk/machine_walk.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "base/text.h"
#include "cam/cell/reach_map.h"
#include "sim/replay/arm_pose.h"
#include "sim/replay/path_time.h"
#include "sim/replay/state_check.h"
#include "sim/replay/turn.h"
#include "sim/replay/walk/gantry_walk.h"
#include "sim/replay/walk/program_walk.h"

namespace qchopper {
namespace {

constexpr double pose_step = 5;  // mm
constexpr double turn_step = 2 * degree;
constexpr double aligned_turn = 0.02 * degree;
constexpr double lever = 3500;  // mm: of the arm, so that poses of a PTP are at most pose_step apart
constexpr double home_turn = 0.01 * degree;

// Seconds of a joint move by the slowest axis, from rest to rest.
double seconds_of(const JointRanges& ranges, const ModalState& state, const Joints& from, const Joints& to) {
    double longest = 0;
    for (std::size_t axis = 0; axis < axes_of_arm; ++axis) {
        const double way = std::abs(to[axis] - from[axis]);
        const double speed = ranges[axis].speed * state.axis_speed[axis];
        const double acceleration = ranges[axis].acceleration * state.axis_acceleration[axis];
        const bool reaches = way > speed * speed / acceleration;
        longest = std::max(longest, reaches ? way / speed + speed / acceleration : 2 * std::sqrt(way / acceleration));
    }
    return longest;
}

// How the axes take part in a line of the tip.
struct AxisMotion {
    JointRates first{};
    JointRates last{};
    double acceleration = std::numeric_limits<double>::infinity();  // of the tip, at which no axis exceeds its own
};

// The joints change by that while the tip goes on by `way` mm.
void add_step(const Joints& before, const Joints& after, double way, bool is_first, const MotionLimits& limits,
              AxisMotion& motion) {
    if (!(way > 0)) return;
    for (std::size_t axis = 0; axis < axes_of_arm; ++axis) {
        motion.last[axis] = static_cast<float>((after[axis] - before[axis]) / way);
    }
    if (is_first) motion.first = motion.last;
    motion.acceleration = std::min(motion.acceleration, tip_acceleration(motion.last, limits));
}

class Walk : public ProgramWalk {
 public:
    Walk(const ParsedProgram& program, const ReplayScene& scene, FindingLog& log)
        : ProgramWalk(program, scene, log),
          robot_(*machine_.robot),
          arm_(*scene.cell, log),
          states_(scene, setup_in_table_, log),
          limits_(motion_limits(machine_)),
          joints_(machine_.start.joints),
          table_angle_(scene.start_table_angle) {
        if (machine_.rotary_table) {
            const SceneOrientation& first = scene.orientations.front();
            setup_in_table_ = inverse(table_at(first.table_angle)) * first.setup_in_cell;
        }
    }

 private:
    Pose table_at(double angle) const { return machine_.rotary_table->table_in_cell * about_z(angle); }
    Pose setup_in_cell() const {
        return machine_.rotary_table ? table_at(table_angle_) * setup_in_table_
                                     : scene_.orientations[direction_].setup_in_cell;
    }
    PlacedBox block_in_cell() const { return placed(setup_in_cell(), scene_.block); }
    void take_rapid(const ProgramStep& step) override;
    JointSweep sweep_to(const ProgramStep& step, SourcePlace place);
    void check_start_from_home(const ProgramStep& step);
    MoveContext context_of(const ProgramStep& step) const;
    bool is_home(bool with_table) const override;
    void take_line(const ProgramStep& step) override;
    AxisMotion follow_line(const Pose& from, const Pose& to, const Pose& tool, const ProgramStep& step, double feed);
    void check_speed(const Joints& before, double way, double feed, SourcePlace place);
    void check_table(const ProgramStep& step);
    bool is_aligned(Vec3 tool_axis, SourcePlace place, double entered_turn = 0);
    void add_turning_way(const Pose& from, const Pose& to, const Pose& tool_said, const ProgramStep& step);
    void add_line(Vec3 from, const TipPose& to, const ProgramStep& step, const ModalState& state,
                  const AxisMotion& motion);
    Pose base_in_robot(const ModalState& state) const;
    TipPose tip_pose() const;

    const Robot& robot_;
    ArmPoses arm_;
    StateCheck states_;
    MotionLimits limits_;
    Joints joints_;
    double table_angle_;
    Pose setup_in_table_;
    bool is_lost_ = false;       // no joints held the pose: lines are not followed until the next PTP
    double since_bodies_ = 1e9;  // mm of way
};

bool Walk::is_home(bool with_table) const {
    double off = with_table ? std::abs(table_angle_ - scene_.start_table_angle) : 0;
    for (std::size_t axis = 0; axis < axes_of_arm; ++axis) {
        off = std::max(off, std::abs(joints_[axis] - machine_.start.joints[axis]));
    }
    return off <= home_turn;
}

TipPose Walk::tip_pose() const {
    const Pose tip = robot_.base_in_cell *
                     (forward(robot_.geometry, joints_) * tool_arm(robot_, machine_.spindle, tool()).tip_in_flange);
    const Pose setup = setup_in_cell();
    return {apply_inverse(setup, tip.shift), rotate_inverse(setup, -column(tip, 2))};
}

MoveContext Walk::context_of(const ProgramStep& step) const {
    return {chunk_, direction_, is_in_chunk_ ? &tool() : nullptr, step.state, step.place};
}

// Moves the joints and the table to the end of a joint move.
JointSweep Walk::sweep_to(const ProgramStep& step, SourcePlace place) {
    const Joints from = joints_;
    const double table_from = table_angle_;
    const Joints to{step.values};
    double largest = step.e1 ? std::abs(*step.e1 - table_from) : 0;
    for (std::size_t axis = 0; axis < axes_of_arm; ++axis) largest = std::max(largest, std::abs(to[axis] - from[axis]));
    const double step_angle = std::min(turn_step, pose_step / lever);
    const auto count = static_cast<std::size_t>(std::ceil(std::min(largest, 100.0) / step_angle)) + 1;
    JointSweep sweep{{}, place, tool_, seconds_of(robot_.ranges, program_.states[step.state], from, to), false, use_};
    sweep.poses.reserve(count);
    for (std::size_t k = 1; k <= count; ++k) {
        const double share = static_cast<double>(k) / static_cast<double>(count);
        for (std::size_t axis = 0; axis < axes_of_arm; ++axis)
            joints_[axis] = from[axis] + share * (to[axis] - from[axis]);
        if (step.e1) table_angle_ = table_from + share * (*step.e1 - table_from);
        if (k % 4 == 0 || k == count) arm_.check_bodies(joints_, tool(), block_in_cell(), false, place);
        sweep.poses.push_back(tip_pose());
    }
    joints_ = to;
    return sweep;
}

// A comment of the chunk says that it may be started from home: that way is looked at, and not gone. The table stands
// as it does for the chunk.
void Walk::check_start_from_home(const ProgramStep& step) {
    const SourcePlace comment = std::exchange(free_from_home_, {});
    const Joints joints = joints_;
    const double table_angle = table_angle_;
    if (is_home(false) && step.e1.value_or(table_angle) == table_angle) return;  // the program goes that way
    joints_ = machine_.start.joints;
    if (step.e1) table_angle_ = *step.e1;
    JointSweep sweep = sweep_to(step, comment);
    sweep.seconds = 0;
    sweep.is_checked_only = true;
    path_.order.push_back({false, path_.sweeps.size()});
    path_.sweeps.push_back(std::move(sweep));
    joints_ = joints;
    table_angle_ = table_angle;
}

void Walk::take_rapid(const ProgramStep& step) {
    states_.take_joint_move(program_.states[step.state], context_of(step));
    if (is_in_chunk_ && free_from_home_.line > 0) check_start_from_home(step);
    JointSweep sweep = sweep_to(step, step.place);
    arm_.check_joints(joints_, step.place);
    if (!has_moved_ && !is_home(true)) {
        log_.add(FindingKind::not_home, step.place,
                 "the first move does not lead home, expected: a PTP to the start of the cell file");
    }
    has_moved_ = true;
    if (is_in_chunk_ && machine_.rotary_table) check_table(step);
    follows_line_ = is_lost_ = false;
    path_.order.push_back({false, path_.sweeps.size()});
    path_.sweeps.push_back(std::move(sweep));
}

void Walk::check_table(const ProgramStep& step) {
    const double wanted = scene_.orientations[direction_].table_angle;
    const double off = step.e1 ? std::abs(std::remainder(*step.e1 - wanted, 2 * std::numbers::pi)) / degree : 360;
    if (off <= 0.01) return;
    log_.add(FindingKind::table_angle, step.place, off, off,
             [&] { return "the table is " + fixed(off, 3) + " degrees from where the job says"; });
}

Pose Walk::base_in_robot(const ModalState& state) const {
    const Pose base = pose_of(*state.base);
    if (state.base_machine == 0 || !machine_.rotary_table) return base;
    return inverse(robot_.base_in_cell) * (table_at(table_angle_) * base);
}

void Walk::take_line(const ProgramStep& step) {
    const ModalState& state = program_.states[step.state];
    states_.take_line(state, context_of(step));
    if (step.e1 && std::abs(*step.e1 - table_angle_) > 1e-9) {
        const double off = std::abs(*step.e1 - table_angle_) / degree;
        log_.add(FindingKind::table_angle, step.place, off, off, [] { return "the table turns on a line"; });
        table_angle_ = *step.e1;
    }
    const Pose tool_said = pose_of(*state.tool);
    const Pose to = base_in_robot(state) * pose_of({{step.values[0], step.values[1], step.values[2]},
                                                    {step.values[3], step.values[4], step.values[5]}});
    const Pose from = forward(robot_.geometry, joints_) * tool_said;
    const TipPose before = tip_pose();
    AxisMotion motion;
    if (!is_lost_) motion = follow_line(from, to, tool_said, step, state.feed);
    const Pose flange = to * inverse(tool_said);
    const Pose tip = robot_.base_in_cell * (flange * tool_arm(robot_, machine_.spindle, tool()).tip_in_flange);
    const Pose setup = setup_in_cell();
    if (!follows_line_) is_aligned(before.tool_axis, step.place, scene_.entered_turn);
    if (!follows_line_ && scene_.entered_turn > 0) add_turning_way(from, to, tool_said, step);
    const Vec3 start = follows_line_ && !path_.lines.empty() ? path_.lines.back().to : before.tip;
    add_line(start, {apply_inverse(setup, tip.shift), rotate_inverse(setup, -column(tip, 2))}, step, state, motion);
    follows_line_ = true;
}

// The line behind a joint move, on which the tool turns from the joints as planned to the frame as entered. It must be
// in air, with the tool as it really leans: what a tool removes while it turns is not reckoned.
void Walk::add_turning_way(const Pose& from, const Pose& to, const Pose& tool_said, const ProgramStep& step) {
    const Turn turn = turn_between(from, to);
    const Pose setup = setup_in_cell();
    const Pose tip_in_said = inverse(tool_said) * tool_arm(robot_, machine_.spindle, tool()).tip_in_flange;
    const auto count = static_cast<std::size_t>(std::ceil(norm(to.shift - from.shift) / pose_step)) + 1;
    JointSweep sweep{{}, step.place, tool_, 0, false, use_, true};
    sweep.poses.reserve(count + 1);
    for (std::size_t k = 0; k <= count; ++k) {
        const double share = static_cast<double>(k) / static_cast<double>(count);
        Pose said = turned(from, turn, share);
        said.shift = from.shift + share * (to.shift - from.shift);
        const Pose tip = robot_.base_in_cell * (said * tip_in_said);
        sweep.poses.push_back({apply_inverse(setup, tip.shift), rotate_inverse(setup, -column(tip, 2))});
    }
    path_.order.push_back({false, path_.sweeps.size()});
    path_.sweeps.push_back(std::move(sweep));
}

// Where a line begins and ends: one along which the tool turns removes other foam than a tool that stands.
bool Walk::is_aligned(Vec3 tool_axis, SourcePlace place, double entered_turn) {
    const Vec3 wanted = scene_.orientations[direction_].tool_axis;
    const double turn = std::atan2(norm(cross(tool_axis, wanted)), dot(tool_axis, wanted));
    if (turn <= aligned_turn + entered_turn) return true;
    log_.add(FindingKind::tool_axis, place, turn / degree, turn, [&] {
        return "the tool axis is " + fixed(turn / degree, 3) + " degrees from the orientation of the chunk";
    });
    return false;
}

void Walk::add_line(Vec3 from, const TipPose& to, const ProgramStep& step, const ModalState& state,
                    const AxisMotion& motion) {
    TipLine line{from,
                 to.tip,
                 step.place,
                 chunk_,
                 tool_,
                 direction_,
                 state.feed,
                 std::min(state.acceleration, motion.acceleration),
                 step.is_rounded ? state.rounding : 0,
                 is_aligned(to.tool_axis, step.place),
                 follows_line_,
                 signals_.in_chunk(),
                 step.hole,
                 use_,
                 motion.first,
                 motion.last};
    path_.order.push_back({true, path_.lines.size()});
    path_.lines.push_back(line);
}

AxisMotion Walk::follow_line(const Pose& from, const Pose& to, const Pose& tool_said, const ProgramStep& step,
                             double feed) {
    const Turn turn = turn_between(from, to);
    const double way = norm(to.shift - from.shift);
    const double parts = std::max(way / pose_step, turn.angle / turn_step);
    const auto count = static_cast<std::size_t>(std::ceil(std::min(parts, 1e5))) + (parts > 0 ? 0 : 1);
    const Pose flange_in_tip = inverse(tool_said);
    AxisMotion motion;
    for (std::size_t k = 1; k <= count; ++k) {
        const double share = static_cast<double>(k) / static_cast<double>(count);
        Pose tip = k == count ? to : turned(from, turn, share);
        tip.shift = from.shift + share * (to.shift - from.shift);
        const std::optional<Joints> next = arm_.follow(tip * flange_in_tip, joints_);
        if (!next) {
            log_.add(FindingKind::reach, step.place, "no joints hold the pose in this arm configuration");
            is_lost_ = true;
            return motion;
        }
        const Joints before = joints_;
        joints_ = *next;
        check_speed(before, way / static_cast<double>(count), feed, step.place);
        add_step(before, joints_, way / static_cast<double>(count), k == 1, limits_, motion);
        arm_.check_joints(joints_, step.place);
        arm_.check_singularity(joints_, step.place);
        since_bodies_ += way / static_cast<double>(count);
        if (since_bodies_ < pose_step) continue;
        arm_.check_bodies(joints_, tool(), block_in_cell(), true, step.place);
        since_bodies_ = 0;
    }
    return motion;
}

void Walk::check_speed(const Joints& before, double way, double feed, SourcePlace place) {
    constexpr double jump = 20 * degree;
    for (std::size_t axis = 0; axis < axes_of_arm; ++axis) {
        const double turn = std::abs(joints_[axis] - before[axis]);
        if (turn > jump) {
            log_.add(FindingKind::arm_configuration, place, turn / degree, turn, [&] {
                return "axis " + std::to_string(axis + 1) + " jumps by " + fixed(turn / degree, 1) + " degrees";
            });
        }
        // Coordinates are written to 0.01 mm: what shorter ways ask of the joints is rounding.
        if (way < 0.2) continue;
        const double speed = turn * feed / way;
        if (speed <= 1.02 * robot_.ranges[axis].speed) continue;
        log_.add(FindingKind::joint_speed, place, speed / degree, speed / robot_.ranges[axis].speed, [&] {
            return "axis " + std::to_string(axis + 1) + " would have to turn at " + fixed(speed / degree, 1) +
                   " degrees/s";
        });
    }
}

}  // namespace

ToolPath walk_machine(const ParsedProgram& program, const ReplayScene& scene, FindingLog& log, const Context& context) {
    if (!scene.cell->machine->robot) return walk_gantry(program, scene, log, context);
    return Walk(program, scene, log).run(context);
}

}  // namespace qchopper
