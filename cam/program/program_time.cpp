// Speeds at corners are bounded by what the moves behind them can brake, then by what those before them can gain: one
// pass each way. O(moves).

#include "cam/program/program_time.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace qchopper {
namespace {

constexpr double table_start_s = 0.5;  // until the table has its speed

struct StraightLeg {
    Vec3 by;
    double length = 0;
    double speed = 0;      // largest
    double end_speed = 0;  // at the corner behind it
    MoveKind kind = MoveKind::link;
    bool is_rounded = false;
};

double corner_speed(const StraightLeg& before, const StraightLeg& after, double rounding, double acceleration) {
    if (!before.is_rounded || before.length <= 0 || after.length <= 0) return 0;
    const double speed = std::min(before.speed, after.speed);
    const double cosine = std::clamp(dot(before.by, after.by) / (before.length * after.length), -1.0, 1.0);
    const double half = 0.5 * std::acos(cosine);  // of the angle by which the path turns
    const double arm = std::min({rounding, 0.5 * before.length, 0.5 * after.length});
    const double sine = std::sin(half);
    if (sine < 1e-9) return speed;
    const double radius = arm * std::cos(half) * std::cos(half) / sine;
    return std::min(speed, std::sqrt(acceleration * radius));
}

// From one speed to another with a trapezoid or a triangle of speed.
double seconds_of(double length, double most, double from, double to, double acceleration) {
    if (length <= 0) return 0;
    const double peak = std::sqrt(std::max(0.0, acceleration * length + 0.5 * (from * from + to * to)));
    const double speed = std::min(most, peak);
    const double ramps = (2 * speed * speed - from * from - to * to) / (2 * acceleration);
    return (2 * speed - from - to) / acceleration + std::max(0.0, length - ramps) / speed;
}

std::vector<StraightLeg> legs_of(const ProgramSection& section) {
    std::vector<StraightLeg> legs;
    Vec3 tip = section.runs.front().start + section.entry.raise * section.out;
    const auto go = [&](Vec3 to, double speed, MoveKind kind, bool is_rounded) {
        const Vec3 by = to - tip;
        if (norm(by) > 0) legs.push_back({by, norm(by), speed, 0, kind, is_rounded});
        tip = to;
    };
    for (const ProgramRun& run : section.runs) {
        go(run.start, run.link_speed, MoveKind::link, false);
        for (const ProgramMove& move : run.moves) go(move.tip, move.speed, move.kind, move.is_rounded);
    }
    go(tip + section.exit.raise * section.out, section.exit.raise_speed, MoveKind::link, false);
    return legs;
}

void set_corner_speeds(std::vector<StraightLeg>& legs, double rounding, double acceleration) {
    const auto reached = [&](double speed, double length) {
        return std::sqrt(speed * speed + 2 * acceleration * length);
    };
    for (std::size_t i = 0; i + 1 < legs.size(); ++i) {
        legs[i].end_speed = corner_speed(legs[i], legs[i + 1], rounding, acceleration);
    }
    for (std::size_t i = legs.size(); i-- > 1;) {
        legs[i - 1].end_speed = std::min(legs[i - 1].end_speed, reached(legs[i].end_speed, legs[i].length));
    }
    double speed = 0;
    for (StraightLeg& leg : legs) {
        leg.end_speed = std::min(leg.end_speed, reached(speed, leg.length));
        speed = leg.end_speed;
    }
}

void add_section(const ProgramSection& section, double acceleration, ProgramTime& time) {
    std::vector<StraightLeg> legs = legs_of(section);
    set_corner_speeds(legs, section.rounding, acceleration);
    double speed = 0;
    for (const StraightLeg& leg : legs) {
        const double seconds = seconds_of(leg.length, leg.speed, speed, leg.end_speed, acceleration);
        speed = leg.end_speed;
        (leg.kind == MoveKind::cut ? time.cut_mm : time.link_mm) += leg.length;
        (leg.kind == MoveKind::cut        ? time.cut_s
         : leg.kind == MoveKind::approach ? time.approach_s
                                          : time.link_s) += seconds;
    }
    time.lowered_moves += section.lowered_moves;
}

void add_joint_moves(const Program& program, const ProgramSection& section, const CellMachine& machine,
                     ProgramTime& time) {
    const auto seconds = [&](const Joints& from, const Joints& to) {
        return joint_move_s(machine.robot->ranges, machine.program.joint_share, from, to);
    };
    Joints at = program.home;
    for (const Joints& target : section.entry.targets) {
        time.joint_s += seconds(at, target);
        at = target;
    }
    const std::vector<Joints>& back = section.exit.targets;
    // The raised end is not far from the first target, seen from home: the way back is reckoned from the last run's
    // end.
    at = section.runs.back().end_joints;
    for (const Joints& target : back) {
        time.joint_s += seconds(at, target);
        at = target;
    }
}

}  // namespace

double joint_move_s(const JointRanges& ranges, double share, const Joints& from, const Joints& to) {
    double longest = 0;
    for (std::size_t axis = 0; axis < axes_of_arm; ++axis) {
        const double turn = std::abs(to[axis] - from[axis]);
        longest =
            std::max(longest, seconds_of(turn, share * ranges[axis].speed, 0, 0, share * ranges[axis].acceleration));
    }
    return longest;
}

ProgramTime program_time(const Program& program, const Cell& cell) {
    const CellMachine& machine = *cell.machine;
    ProgramTime time;
    double angle = 0;
    for (std::size_t i = 0; i < program.sections.size(); ++i) {
        const ProgramSection& section = program.sections[i];
        add_section(section, machine.program.acceleration, time);
        if (machine.robot) add_joint_moves(program, section, machine, time);
        if (i > 0 && section.tool != program.sections[i - 1].tool) time.change_s += tool_change_s;
        const auto turn = [&](double to) {
            if (to == angle || !machine.rotary_table) return;
            const double speed = machine.rotary_table->speed;
            time.table_s += seconds_of(std::abs(to - angle), speed, 0, 0, speed / table_start_s);
            angle = to;
        };
        turn(section.table_angle);
        if (i + 1 == program.sections.size()) turn(0);
    }
    return time;
}

}  // namespace qchopper
