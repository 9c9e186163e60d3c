// One line a move. O(moves).

#include "cam/post/krl_chunk.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "base/box.h"
#include "base/error.h"
#include "base/text.h"
#include "cam/post/krl_signals.h"

namespace qchopper {
namespace {

constexpr std::size_t longest_name = 24;
constexpr double most_speed = 5;  // m/s
constexpr int point_decimals = 2;
constexpr int speed_decimals = 4;
constexpr double speed_unit = 0.1;                     // mm/s, of the last decimal in m/s
constexpr const char* orientation_speed = "100.0000";  // degrees/s

// In m/s, rounded down so that no speed is above the one that was asked for.
std::string metres_per_s(double speed_mm_s) {
    const double stepped = speed_unit * std::floor(speed_mm_s / speed_unit + 1e-6);
    if (!(stepped > 0)) {
        throw InputError(InputFault::use,
                         "a move at " + significant(speed_mm_s, 3) + " mm/s is too slow for a program");
    }
    return krl::number("$VEL.CP", stepped / 1000, speed_decimals, most_speed);
}

std::string box_words(const Box& box) {
    std::string text;
    for (int i = 0; i < 3; ++i) {
        text +=
            (i > 0 ? ", " : "") + std::string(1, "XYZ"[i]) + " " + fixed(box.min[i], 2) + " to " + fixed(box.max[i], 2);
    }
    return text;
}

}  // namespace

void set_speed(double speed_mm_s, double& current, KrlText& text) {
    if (speed_mm_s == current) return;
    const std::string wanted = metres_per_s(speed_mm_s);
    if (current <= 0 || wanted != metres_per_s(current)) text.line("$VEL.CP = " + wanted);
    current = speed_mm_s;
}

void begin_program(const std::string& name, KrlText& text) {
    if (name.size() > longest_name) {
        throw InputError(InputFault::use, "the program name " + name + " has more than 24 characters");
    }
    text.line("&ACCESS RVP");
    text.line("&REL 1");
    text.line("&PARAM EDITMASK = *");
    text.line("DEF " + name + "( )");
}

void KrlChunks::add_axis_speeds(KrlText& text) {
    const std::string percent = " = " + fixed(joint_move_percent, 0);
    for (std::size_t i = 1; i <= axes_of_arm; ++i) text.line("$VEL_AXIS[" + std::to_string(i) + "]" + percent);
    for (std::size_t i = 1; i <= axes_of_arm; ++i) text.line("$ACC_AXIS[" + std::to_string(i) + "]" + percent);
}

void KrlChunks::add_tool(std::size_t tool, KrlText& text) const {
    constexpr double most_kg = 10'000;
    const ProgramTool& own = program_.tools[tool];
    const Vec3 inertia = own.load.inertia_kg_m2;
    text.line("$LOAD = {M " + krl::number("M", own.load.mass_kg, 3, most_kg) + ",CM " +
              krl::frame(own.load.centre_in_flange) + ",J {X " + krl::number("J", inertia.x, 4, most_kg) + ",Y " +
              krl::number("J", inertia.y, 4, most_kg) + ",Z " + krl::number("J", inertia.z, 4, most_kg) + "}}");
    text.line("$TOOL = " + krl::frame(own.tool_in_flange));
}

void KrlChunks::add_base(KrlText& text) const {
    if (!program_.external_axis) return text.line("$BASE = " + krl::frame(program_.base));
    const std::string machine = "MACHINE_DEF[" + std::to_string(*program_.external_axis + 1) + "]";
    text.line("$BASE = EK(" + machine + ".ROOT," + machine + ".MECH_TYPE," + krl::frame(program_.base) + ")");
}

void KrlChunks::add_joint_move(const Joints& joints, double table_angle, KrlText& text) const {
    std::string line = "PTP {" + krl::joints(joints);
    if (program_.external_axis) line += "," + krl::external(*program_.external_axis, table_angle);
    text.line(line + "}");
}

std::string KrlChunks::full_pose(const ProgramSection& section, Vec3 tip) const {
    std::string line = "LIN {" + krl::position(tip, point_decimals) + krl::angles(section.tool_in_setup, 3);
    if (program_.external_axis) line += "," + krl::external(*program_.external_axis, section.table_angle);
    return line + "}";
}

void KrlChunks::add_settings(const ProgramSection& section, KrlText& text) const {
    constexpr double rounding_unit = 0.001;
    const double rounding = rounding_unit * std::floor(section.rounding / rounding_unit + 1e-6);
    text.line("$ADVANCE = 5");
    add_axis_speeds(text);
    add_tool(section.tool, text);
    add_base(text);
    text.line("$ACC.CP = " + krl::number("$ACC.CP", path_acceleration / 1000, 4, 100));
    text.line(std::string("$VEL.ORI1 = ") + orientation_speed);
    text.line(std::string("$VEL.ORI2 = ") + orientation_speed);
    text.line("$APO.CDIS = " + krl::number("$APO.CDIS", rounding, 3, 1000.001));
}

void KrlChunks::add_description(const RunRange& range, std::size_t order, std::size_t total, KrlText& text) const {
    const ProgramSection& section = program_.sections[range.section];
    const CarvingTool& tool = machine_.tools[section.tool];
    Box box;
    std::size_t moves = 0;
    for (std::size_t r = range.first; r < range.first + range.count; ++r) {
        const ProgramRun& run = section.runs[r];
        if (r == range.first) box = {run.start, run.start};
        moves += run.moves.size();
        for (int i = 0; i < 3; ++i) {
            const auto add = [&](double value) {
                box.min[i] = std::min(box.min[i], value);
                box.max[i] = std::max(box.max[i], value);
            };
            add(run.start[i]);
            for (const ProgramMove& move : run.moves) add(move.tip[i]);
        }
    }
    text.comment("chunk " + std::to_string(order + 1) + " of " + std::to_string(total));
    text.comment("direction " + std::to_string(section.direction + 1));
    text.comment("tool " + std::to_string(tool.number) + ", " + tool.name);
    text.comment("moves of runs: " + std::to_string(moves));
    text.comment("box of the tip in mm: " + box_words(box));
}

KrlText KrlChunks::run(const ProgramSection& section, const ProgramRun& run, bool is_first, double& speed) const {
    KrlText text;
    std::string before = krl::position(run.start, point_decimals);
    set_speed(section.link_feed, speed, text);
    text.line(is_first ? full_pose(section, run.start) : "LIN {" + before + "}");
    for (const ProgramMove& move : run.moves) {
        std::string here = krl::position(move.tip, point_decimals);
        if (here == before) continue;
        set_speed(move.speed, speed, text);
        text.line("LIN {" + here + (move.is_rounded ? "} C_DIS" : "}"));
        before = std::move(here);
    }
    return text;
}

KrlText KrlChunks::chunk(const RunRange& range, const std::string& name, std::size_t order, std::size_t total) const {
    const ProgramSection& section = program_.sections[range.section];
    KrlText text;
    begin_program(name, text);
    add_description(range, order, total, text);
    add_settings(section, text);
    start_extraction(machine_, text);
    start_spindle(machine_, section.rpm, text);
    double speed = 0;
    set_speed(section.link_feed, speed, text);
    const ProgramRun& first = section.runs[range.first];
    if (range.first > 0) add_joint_move(first.start_joints, section.table_angle, text);
    for (const Joints& target : section.entry.targets) {
        if (range.first == 0) add_joint_move(target, section.table_angle, text);
    }
    for (std::size_t r = range.first; r < range.first + range.count; ++r) {
        text.append(run(section, section.runs[r], r == range.first, speed));
    }
    const std::size_t end = range.first + range.count;
    set_speed(section.link_feed, speed, text);
    if (end < section.runs.size()) {
        text.line("LIN {" + krl::position(section.runs[end].start, point_decimals) + "}");
    } else {
        const Vec3 last = section.runs.back().moves.back().tip;
        if (section.exit.raise > 0) {
            text.line("LIN {" + krl::position(last + section.exit.raise * section.out, point_decimals) + "}");
        }
        for (const Joints& target : section.exit.targets) add_joint_move(target, section.table_angle, text);
    }
    text.line("END");
    return text;
}

}  // namespace qchopper
