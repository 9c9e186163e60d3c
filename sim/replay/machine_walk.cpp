// Step by step, with the joints, the table and the spindle as the state. Ways of the tip are linear in position and
// turn about one axis.

#include "sim/replay/machine_walk.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/text.h"
#include "cam/cell/kuka_angles.h"
#include "cam/cell/reach_map.h"
#include "sim/program/krl_file.h"
#include "sim/replay/arm_pose.h"

namespace qchopper {
namespace {

constexpr double degree = std::numbers::pi / 180;
constexpr double pose_step = 5;  // mm
constexpr double turn_step = 2 * degree;
constexpr double frame_mm = 0.01;  // of $TOOL and $BASE
constexpr double frame_turn = 0.01 * degree;
constexpr double aligned_turn = 0.02 * degree;
constexpr double lever = 3500;  // mm: of the arm, so that poses of a PTP are at most pose_step apart
constexpr double load_kg = 0.5;

Pose pose_of(const ProgramFrame& frame) {
    return pose_of(KukaAngles{frame.abc.x, frame.abc.y, frame.abc.z}, frame.shift);
}

Pose about_z(double angle) {
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    return {{Vec3{c, -s, 0}, Vec3{s, c, 0}, Vec3{0, 0, 1}}, {}};
}

Vec3 column(const Pose& pose, int j) {
    return {pose.row[0][j], pose.row[1][j], pose.row[2][j]};
}

// How far two poses turn from each other, and about which axis of the first.
struct Turn {
    double angle = 0;
    Vec3 axis{0, 0, 1};
};

Turn turn_between(const Pose& a, const Pose& b) {
    const Pose r = inverse(Pose{a.row, {}}) * Pose{b.row, {}};
    const Vec3 twice_sine{r.row[2].y - r.row[1].z, r.row[0].z - r.row[2].x, r.row[1].x - r.row[0].y};
    const double trace = r.row[0].x + r.row[1].y + r.row[2].z;
    const double angle = std::atan2(norm(twice_sine), trace - 1);
    if (norm(twice_sine) > 1e-12) return {angle, normalized(twice_sine)};
    return {angle < 1 ? 0.0 : angle, {0, 0, 1}};
}

Pose turned(const Pose& pose, const Turn& turn, double share) {
    const double c = std::cos(share * turn.angle);
    const double s = std::sin(share * turn.angle);
    const Vec3 k = turn.axis;
    const auto row = [&](Vec3 unit) {
        // Rodrigues: the rows of the rotation matrix.
        const Vec3 across = cross(unit, k);
        return c * unit + s * across + ((1 - c) * dot(k, unit)) * k;
    };
    const Pose rotation{{row({1, 0, 0}), row({0, 1, 0}), row({0, 0, 1})}, {}};
    return pose * rotation;
}

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

class Walk {
 public:
    Walk(const ParsedProgram& program, const ReplayScene& scene, FindingLog& log)
        : program_(program),
          scene_(scene),
          machine_(*scene.cell->machine),
          robot_(*machine_.robot),
          log_(log),
          arm_(*scene.cell, log),
          joints_(machine_.start.joints),
          table_angle_(scene.start_table_angle) {
        if (machine_.rotary_table) {
            const SceneDirection& first = scene.directions.front();
            setup_in_table_ = inverse(table_at(first.table_angle)) * first.setup_in_cell;
        }
    }
    ToolPath run(const Context& context);

 private:
    Pose table_at(double angle) const { return machine_.rotary_table->table_in_cell * about_z(angle); }
    Pose setup_in_cell() const {
        return machine_.rotary_table ? table_at(table_angle_) * setup_in_table_
                                     : scene_.directions[direction_].setup_in_cell;
    }
    void enter(const ProgramChunk& chunk);
    void take_tool(std::uint16_t number, SourcePlace place);
    void take(const ProgramStep& step);
    void take_signal(const ProgramStep& step);
    void take_call(const ProgramStep& step);
    void switch_spindle(bool on);
    void take_joint_move(const ProgramStep& step);
    void take_line(const ProgramStep& step);
    void follow_line(const Pose& from, const Pose& to, const Pose& tool, const ProgramStep& step, double feed);
    void check_speed(const Joints& before, double way, double feed, SourcePlace place);
    void check_frames(const ProgramStep& step, const ModalState& state);
    void check_tool_frame(const ModalState& state, SourcePlace place);
    void check_base_frame(const ModalState& state, SourcePlace place);
    void check_load(const ModalState& state, SourcePlace place);
    void check_table(const ProgramStep& step);
    void add_line(Vec3 from, Vec3 to, Vec3 out, const ProgramStep& step, const ModalState& state);
    Pose base_in_robot(const ModalState& state) const;
    TipPose tip_pose() const;
    const CarvingTool& tool() const { return machine_.tools[tool_]; }
    bool is_signal(const std::optional<Signal>& signal, SignalKind kind, const std::string& target) const {
        return signal && signal->kind == kind && lower_case(signal->target) == target;
    }

    const ParsedProgram& program_;
    const ReplayScene& scene_;
    const CellMachine& machine_;
    const Robot& robot_;
    FindingLog& log_;
    ArmPoses arm_;
    Joints joints_;
    double table_angle_;
    Pose setup_in_table_;
    std::uint32_t chunk_ = 0;
    std::uint32_t direction_ = 0;
    std::uint32_t tool_ = 0;
    std::optional<std::uint16_t> asked_tool_;  // by a call with its number
    std::string asked_;                        // by the last HALT, in lower case
    bool has_tool_ = false;
    bool is_in_chunk_ = false;
    bool follows_line_ = false;
    bool is_lost_ = false;  // no joints held the pose: lines are not followed until the next PTP
    std::uint32_t checked_state_ = ~0U;
    std::uint32_t checked_chunk_ = ~0U;
    double since_bodies_ = 1e9;  // mm of way
    SpindleState spindle_;
    ToolPath path_;
};

ToolPath Walk::run(const Context& context) {
    std::size_t next = 0;
    std::size_t done = 0;
    for (const ProgramChunk& chunk : program_.chunks) {
        is_in_chunk_ = !chunk.is_main;
        if (is_in_chunk_) chunk_ = static_cast<std::uint32_t>(next++);
        if (is_in_chunk_) enter(chunk);
        for (std::size_t i = chunk.first; i < chunk.end; ++i, ++done) {
            if (done % 1024 == 0) {
                context.check_cancelled();
                context.progress("steps of the program followed", done, program_.steps.size());
            }
            take(program_.steps[i]);
        }
    }
    if (next != scene_.chunks.size()) {
        log_.add(FindingKind::chunk_order, {}, 0, 0, [&] {
            return "the program calls " + counted(next, "chunk") + ", the job has " +
                   std::to_string(scene_.chunks.size());
        });
    }
    return std::move(path_);
}

void Walk::enter(const ProgramChunk& chunk) {
    const SourcePlace place{chunk.file, 1};
    const std::string stem = lower_case(program_.files[chunk.file].substr(0, program_.files[chunk.file].find('.')));
    const bool is_known = chunk_ < scene_.chunks.size() && lower_case(scene_.chunks[chunk_].name) == stem;
    if (!is_known) {
        log_.add(FindingKind::chunk_order, place, 0, 0,
                 [] { return "the job does not say that this chunk comes here"; });
        chunk_ = std::min(chunk_, static_cast<std::uint32_t>(scene_.chunks.size() - 1));
        for (std::size_t i = 0; i < scene_.chunks.size(); ++i) {
            if (lower_case(scene_.chunks[i].name) == stem) chunk_ = static_cast<std::uint32_t>(i);
        }
    }
    direction_ = static_cast<std::uint32_t>(scene_.chunks[chunk_].direction);
    take_tool(scene_.chunks[chunk_].tool, place);
}

// The person or the program that was asked has changed the tool to that of the chunk.
void Walk::take_tool(std::uint16_t number, SourcePlace place) {
    std::uint32_t index = 0;
    while (index + 1 < machine_.tools.size() && machine_.tools[index].number != number) ++index;
    if (!has_tool_ || index != tool_) {
        const bool was_called = asked_tool_ && *asked_tool_ == number;
        const bool was_asked = !machine_.program.tool_change_call &&
                               asked_.find("tool " + std::to_string(number) + " ") != std::string::npos;
        if (!was_called && !was_asked) {
            log_.add(FindingKind::tool_change, place, number, 0,
                     [&] { return "tool " + std::to_string(number) + " is needed, and nobody was asked for it"; });
        }
    }
    has_tool_ = true;
    tool_ = index;
    asked_.clear();
}

void Walk::take(const ProgramStep& step) {
    switch (step.kind) {
        case StepKind::joint_move:
            return take_joint_move(step);
        case StepKind::linear_move:
            return take_line(step);
        case StepKind::output:
        case StepKind::analog_output:
        case StepKind::wait_input:
            return take_signal(step);
        case StepKind::halt:
            asked_ = lower_case(program_.texts[step.text]) + " ";
            if (spindle_.is_on) {
                log_.add(FindingKind::tool_change, step.place, 0, 0, [] { return "the spindle runs at a HALT"; });
            }
            return;
        case StepKind::call:
            return take_call(step);
    }
}

void Walk::switch_spindle(bool on) {
    if (on && !spindle_.is_on) spindle_.has_speed = !machine_.spindle.at_speed;
    spindle_.is_on = on;
    if (!on) spindle_.has_speed = false;
}

void Walk::take_signal(const ProgramStep& step) {
    const Spindle& spindle = machine_.spindle;
    const std::string number = std::to_string(step.number);
    if (step.kind == StepKind::output) {
        if (step.value > 0 && is_signal(spindle.on, SignalKind::output, number)) switch_spindle(true);
        if (step.value == 0 && is_signal(spindle.off, SignalKind::output, number)) switch_spindle(false);
        if (step.value == 0 && is_signal(spindle.on, SignalKind::output, number)) switch_spindle(false);
    } else if (step.kind == StepKind::analog_output) {
        if (!is_signal(spindle.speed, SignalKind::output, number)) return;
        const double rpm = step.value / spindle.speed->scale;
        if (rpm != spindle_.rpm) spindle_.has_speed = !spindle.at_speed;
        spindle_.rpm = rpm;
    } else if (is_signal(spindle.at_speed, SignalKind::input, number) && spindle_.is_on) {
        spindle_.has_speed = true;
    }
}

void Walk::take_call(const ProgramStep& step) {
    const Spindle& spindle = machine_.spindle;
    const std::string& name = program_.texts[step.text];
    const auto calls = [&](const std::optional<Signal>& signal) { return is_signal(signal, SignalKind::call, name); };
    if (calls(spindle.speed)) spindle_.rpm = step.value / spindle.speed->scale;
    if (calls(spindle.on)) switch_spindle(true);
    if (calls(spindle.off)) switch_spindle(false);
    if (calls(spindle.at_speed) && spindle_.is_on) spindle_.has_speed = true;
    const std::optional<std::string>& change = machine_.program.tool_change_call;
    if (change && lower_case(*change) == name)
        asked_tool_ = static_cast<std::uint16_t>(std::clamp(step.value, 0.0, 65535.0));
}

TipPose Walk::tip_pose() const {
    const Pose tip = robot_.base_in_cell *
                     (forward(robot_.geometry, joints_) * tool_arm(robot_, machine_.spindle, tool()).tip_in_flange);
    const Pose setup = setup_in_cell();
    return {apply_inverse(setup, tip.shift), rotate_inverse(setup, -column(tip, 2))};
}

void Walk::take_joint_move(const ProgramStep& step) {
    const ModalState& state = program_.states[step.state];
    const Joints from = joints_;
    const double table_from = table_angle_;
    const Joints to{step.values};
    double largest = step.e1 ? std::abs(*step.e1 - table_from) : 0;
    for (std::size_t axis = 0; axis < axes_of_arm; ++axis) largest = std::max(largest, std::abs(to[axis] - from[axis]));
    const double step_angle = std::min(turn_step, pose_step / lever);
    const auto count = static_cast<std::size_t>(std::ceil(std::min(largest, 100.0) / step_angle)) + 1;
    JointSweep sweep{{}, step.place, tool_, seconds_of(robot_.ranges, state, from, to)};
    sweep.poses.reserve(count);
    for (std::size_t k = 1; k <= count; ++k) {
        const double share = static_cast<double>(k) / static_cast<double>(count);
        for (std::size_t axis = 0; axis < axes_of_arm; ++axis)
            joints_[axis] = from[axis] + share * (to[axis] - from[axis]);
        if (step.e1) table_angle_ = table_from + share * (*step.e1 - table_from);
        if (k % 4 == 0 || k == count) arm_.check_bodies(joints_, tool(), step.place);
        sweep.poses.push_back(tip_pose());
    }
    joints_ = to;
    arm_.check_joints(joints_, step.place);
    if (is_in_chunk_ && machine_.rotary_table) check_table(step);
    follows_line_ = is_lost_ = false;
    path_.order.push_back({false, path_.sweeps.size()});
    path_.sweeps.push_back(std::move(sweep));
}

void Walk::check_table(const ProgramStep& step) {
    const double wanted = scene_.directions[direction_].table_angle;
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

void Walk::check_tool_frame(const ModalState& state, SourcePlace place) {
    const Pose said = pose_of(*state.tool);
    const Pose& nose = machine_.spindle.spindle_in_flange;
    const int along = machine_.spindle.tool_axis == ToolAxis::z ? 2 : 0;
    const Vec3 axis = column(nose, along);
    const double off = norm(said.shift - (nose.shift + gauge_length(tool()) * axis));
    const double turn = std::atan2(norm(cross(column(said, along), axis)), dot(column(said, along), axis));
    if (off <= frame_mm && turn <= frame_turn) return;
    log_.add(FindingKind::tool_frame, place, off, std::max(off, turn * 1000), [&] {
        return "$TOOL is " + fixed(off, 3) + " mm and " + fixed(turn / degree, 3) + " degrees from tool " +
               std::to_string(tool().number) + " of the cell file";
    });
}

void Walk::check_base_frame(const ModalState& state, SourcePlace place) {
    const Pose said = pose_of(*state.base);
    const bool turns = machine_.rotary_table.has_value();
    const Pose wanted =
        turns ? setup_in_table_ : inverse(robot_.base_in_cell) * scene_.directions[direction_].setup_in_cell;
    const double off = norm(said.shift - wanted.shift);
    const double turn = turn_between(said, wanted).angle;
    const std::uint32_t machine = turns ? static_cast<std::uint32_t>(machine_.rotary_table->external_axis) + 1 : 0;
    if (off <= frame_mm && turn <= frame_turn && state.base_machine == machine) return;
    log_.add(FindingKind::base_frame, place, off, std::max(off, turn * 1000), [&] {
        if (state.base_machine != machine) return std::string("$BASE is not chained to the table as the cell is built");
        return "$BASE is " + fixed(off, 3) + " mm and " + fixed(turn / degree, 3) + " degrees from where the job says";
    });
}

void Walk::check_load(const ModalState& state, SourcePlace place) {
    const double mass = machine_.spindle.mass_kg + tool().mass_kg;
    const double off = state.load ? std::abs(state.load->mass_kg - mass) : mass;
    if (off <= load_kg) return;
    log_.add(FindingKind::load, place, off, off,
             [&] { return "the load data are " + fixed(off, 2) + " kg from the mass of spindle and tool"; });
}

void Walk::check_frames(const ProgramStep& step, const ModalState& state) {
    if (checked_state_ == step.state && checked_chunk_ == chunk_) return;
    checked_state_ = step.state;
    checked_chunk_ = chunk_;
    check_tool_frame(state, step.place);
    check_base_frame(state, step.place);
    check_load(state, step.place);
}

void Walk::take_line(const ProgramStep& step) {
    const ModalState& state = program_.states[step.state];
    check_frames(step, state);
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
    if (!is_lost_) follow_line(from, to, tool_said, step, state.feed);
    const Pose flange = to * inverse(tool_said);
    const Pose tip = robot_.base_in_cell * (flange * tool_arm(robot_, machine_.spindle, tool()).tip_in_flange);
    const Pose setup = setup_in_cell();
    const Vec3 start = follows_line_ && !path_.lines.empty() ? path_.lines.back().to : before.tip;
    add_line(start, apply_inverse(setup, tip.shift), rotate_inverse(setup, -column(tip, 2)), step, state);
    follows_line_ = true;
}

void Walk::add_line(Vec3 from, Vec3 to, Vec3 out, const ProgramStep& step, const ModalState& state) {
    const Vec3 wanted = scene_.directions[direction_].out;
    const double turn = std::atan2(norm(cross(out, wanted)), dot(out, wanted));
    if (turn > aligned_turn) {
        log_.add(FindingKind::tool_axis, step.place, turn / degree, turn, [&] {
            return "the tool axis is " + fixed(turn / degree, 3) + " degrees from the direction of the chunk";
        });
    }
    TipLine line{from,
                 to,
                 step.place,
                 chunk_,
                 tool_,
                 direction_,
                 state.feed,
                 state.acceleration,
                 step.is_rounded ? state.rounding : 0,
                 turn <= aligned_turn,
                 follows_line_,
                 spindle_,
                 step.hole};
    path_.order.push_back({true, path_.lines.size()});
    path_.lines.push_back(line);
}

void Walk::follow_line(const Pose& from, const Pose& to, const Pose& tool_said, const ProgramStep& step, double feed) {
    const Turn turn = turn_between(from, to);
    const double way = norm(to.shift - from.shift);
    const double parts = std::max(way / pose_step, turn.angle / turn_step);
    const auto count = static_cast<std::size_t>(std::ceil(std::min(parts, 1e5))) + (parts > 0 ? 0 : 1);
    const Pose flange_in_tip = inverse(tool_said);
    for (std::size_t k = 1; k <= count; ++k) {
        const double share = static_cast<double>(k) / static_cast<double>(count);
        Pose tip = k == count ? to : turned(from, turn, share);
        tip.shift = from.shift + share * (to.shift - from.shift);
        const std::optional<Joints> next = arm_.follow(tip * flange_in_tip, joints_);
        if (!next) {
            log_.add(FindingKind::reach, step.place, 0, 0, [] { return "no joints hold the pose on this branch"; });
            is_lost_ = true;
            return;
        }
        const Joints before = joints_;
        joints_ = *next;
        check_speed(before, way / static_cast<double>(count), feed, step.place);
        arm_.check_joints(joints_, step.place);
        arm_.check_singularity(joints_, step.place);
        since_bodies_ += way / static_cast<double>(count);
        if (since_bodies_ < pose_step) continue;
        arm_.check_bodies(joints_, tool(), step.place);
        since_bodies_ = 0;
    }
}

void Walk::check_speed(const Joints& before, double way, double feed, SourcePlace place) {
    constexpr double jump = 20 * degree;
    for (std::size_t axis = 0; axis < axes_of_arm; ++axis) {
        const double turn = std::abs(joints_[axis] - before[axis]);
        if (turn > jump) {
            log_.add(FindingKind::branch, place, turn / degree, turn, [&] {
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

std::vector<std::string> called_programs(const Cell& cell) {
    std::vector<std::string> names;
    if (!cell.machine) return names;
    const CellMachine& machine = *cell.machine;
    const auto add = [&](const std::optional<Signal>& signal) {
        if (signal && signal->kind == SignalKind::call) names.push_back(signal->target);
    };
    for (const auto& signal :
         {machine.spindle.on, machine.spindle.speed, machine.spindle.at_speed, machine.spindle.off}) {
        add(signal);
    }
    if (machine.extraction) add(machine.extraction->on), add(machine.extraction->off);
    if (machine.program.tool_change_call) names.push_back(*machine.program.tool_change_call);
    return names;
}

ToolPath walk_machine(const ParsedProgram& program, const ReplayScene& scene, FindingLog& log, const Context& context) {
    return Walk(program, scene, log).run(context);
}

}  // namespace qchopper
