// One line a move. O(moves).

#include "cam/post/krl_chunk.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "base/box.h"
#include "base/error.h"
#include "base/text.h"
#include "base/units.h"
#include "cam/post/krl_signals.h"

namespace qchopper {
namespace {

constexpr std::size_t longest_name = 24;
constexpr double max_speed = 5;  // m/s
constexpr int point_decimals = 2;
constexpr int speed_decimals = 4;
constexpr double rounding_unit = 0.001;  // mm, of $APO.CDIS
constexpr double speed_unit = 0.1;       // mm/s, of the last decimal in m/s

// In m/s, rounded down so that no speed is above the one that was asked for.
std::string metres_per_s(double speed_mm_s) {
    const double stepped = speed_unit * std::floor(speed_mm_s / speed_unit + 1e-6);
    if (!(stepped > 0)) {
        throw InputError(InputFault::use,
                         "a move at " + significant(speed_mm_s, 3) + " mm/s is too slow for a program");
    }
    return krl::number("$VEL.CP", stepped / 1000, speed_decimals, max_speed);
}

std::string box_words(const Box& box) {
    std::string text;
    for (int i = 0; i < 3; ++i) {
        text +=
            (i > 0 ? ", " : "") + std::string(1, "XYZ"[i]) + " " + fixed(box.min[i], 2) + " to " + fixed(box.max[i], 2);
    }
    return text;
}

// Sets a speed if it is another one: a line $VEL.CP.
void set_speed(double speed_mm_s, double& current, KrlText& text) {
    if (speed_mm_s == current) return;
    const std::string wanted = metres_per_s(speed_mm_s);
    if (current <= 0 || wanted != metres_per_s(current)) text.line("$VEL.CP = " + wanted);
    current = speed_mm_s;
}

// Sets the distance of rounding if it is another one: a line $APO.CDIS. A corner of less than the unit is exact.
bool set_rounding(double rounding_mm, double& current, KrlText& text) {
    const double stepped = rounding_unit * std::floor(rounding_mm / rounding_unit + 1e-6);
    if (!(stepped > 0)) return false;
    if (stepped != current) text.line("$APO.CDIS = " + krl::number("$APO.CDIS", stepped, 3, 1000.001));
    current = stepped;
    return true;
}

}  // namespace

void begin_program(const std::string& name, KrlText& text) {
    if (name.size() > longest_name) {
        throw InputError(InputFault::use, "the program name " + name + " has more than 24 characters");
    }
    text.line("&ACCESS RVP");
    text.line("&REL 1");
    text.line("&PARAM EDITMASK = *");
    text.line("DEF " + name + "( )");
}

void KrlChunks::add_axis_speeds(KrlText& text) const {
    const std::string percent = " = " + fixed(100 * machine_.program.joint_share, 0);
    for (std::size_t i = 1; i <= axes_of_arm; ++i) text.line("$VEL_AXIS[" + std::to_string(i) + "]" + percent);
    for (std::size_t i = 1; i <= axes_of_arm; ++i) text.line("$ACC_AXIS[" + std::to_string(i) + "]" + percent);
}

void KrlChunks::add_tool(std::size_t tool, KrlText& text) const {
    constexpr double max_kg = 10'000;
    const ProgramTool& own = program_.tools[tool];
    const Vec3 inertia = own.load.inertia_kg_m2;
    text.line("$LOAD = {M " + krl::number("M", own.load.mass_kg, 3, max_kg) + ",CM " +
              krl::frame(own.load.centre_in_flange) + ",J {X " + krl::number("J", inertia.x, 4, max_kg) + ",Y " +
              krl::number("J", inertia.y, 4, max_kg) + ",Z " + krl::number("J", inertia.z, 4, max_kg) + "}}");
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

std::string KrlChunks::full_pose(const ProgramOperation& operation, Vec3 tip) const {
    std::string line = "LIN {" + krl::position(tip, point_decimals) + krl::angles(operation.tool_in_setup, 3);
    if (program_.external_axis) line += "," + krl::external(*program_.external_axis, operation.table_angle);
    return line + "}";
}

void KrlChunks::add_settings(const ProgramOperation& operation, KrlText& text) const {
    text.line("$ADVANCE = 5");
    add_axis_speeds(text);
    add_tool(operation.tool, text);
    add_base(text);
    text.line("$ACC.CP = " + krl::number("$ACC.CP", machine_.program.acceleration / 1000, 4, 100));
    for (const char* name : {"$VEL.ORI1", "$VEL.ORI2"}) {
        text.line(std::string(name) + " = " +
                  krl::number(name, degrees_per_radian * machine_.program.turn_speed, 4, 10'000));
    }
}

bool KrlChunks::starts_from_home(const RunRange& range) const {
    const ProgramOperation& operation = program_.operations[range.operation];
    return range.first == 0 || operation.runs[range.first].starts_from_home;
}

void KrlChunks::add_description(const RunRange& range, std::size_t order, std::size_t total, KrlText& text) const {
    const ProgramOperation& operation = program_.operations[range.operation];
    const CuttingTool& tool = machine_.tools[operation.tool];
    Box box;
    std::size_t moves = 0;
    for (std::size_t r = range.first; r < range.first + range.count; ++r) {
        const ProgramRun& run = operation.runs[r];
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
    text.comment("direction " + std::to_string(operation.orientation + 1));
    text.comment("tool " + std::to_string(tool.number) + ", " + tool.name);
    text.comment(std::string("operation ") + to_word(operation.kind));
    text.comment("moves of runs: " + std::to_string(moves));
    text.comment("box of the tip in mm: " + box_words(box));
    text.comment(std::string("start from home: ") +
                 (starts_from_home(range) ? "free" : "not free, see the chunks before"));
}

// A place that is stated already is left out; the corner there is rounded only if every move that ends there allows it,
// and never where a run ends.
KrlText KrlChunks::run(const ProgramOperation& operation, const ProgramRun& run, bool is_first, Stated& stated) const {
    KrlText text;
    if (run.hole > 0) text.comment("hole " + std::to_string(run.hole));
    std::string here = krl::position(run.start, point_decimals);
    set_speed(run.link_speed, stated.speed, text);
    text.line(is_first ? full_pose(operation, run.start) : "LIN {" + here + "}");
    const auto position_of = [&](std::size_t i) {
        return i < run.moves.size() ? krl::position(run.moves[i].tip, point_decimals) : std::string();
    };
    std::string next = position_of(0);
    for (std::size_t i = 0; i < run.moves.size();) {
        const ProgramMove& move = run.moves[i];
        const std::string own = std::move(next);
        double rounding = move.rounding;
        for (next = position_of(++i); next == own; next = position_of(++i)) {
            rounding = std::min(rounding, run.moves[i].rounding);
        }
        if (own == here) continue;
        set_speed(move.speed, stated.speed, text);
        const bool is_rounded = i < run.moves.size() && set_rounding(rounding, stated.rounding, text);
        text.line("LIN {" + own + (is_rounded ? "} C_DIS" : "}"));
        here = own;
    }
    return text;
}

KrlText KrlChunks::chunk(const RunRange& range, const std::string& name, std::size_t order, std::size_t total) const {
    const ProgramOperation& operation = program_.operations[range.operation];
    KrlText text;
    begin_program(name, text);
    add_description(range, order, total, text);
    add_settings(operation, text);
    start_extraction(machine_, text);
    start_spindle(machine_, operation.rpm, text);
    Stated stated;
    const ProgramRun& first = operation.runs[range.first];
    if (range.first > 0) add_joint_move(first.start_joints, operation.table_angle, text);
    for (const Joints& target : operation.entry.targets) {
        if (range.first == 0) add_joint_move(target, operation.table_angle, text);
    }
    for (std::size_t r = range.first; r < range.first + range.count; ++r) {
        text.append(run(operation, operation.runs[r], r == range.first, stated));
    }
    const std::size_t end = range.first + range.count;
    if (end < operation.runs.size()) {
        set_speed(operation.runs[end].link_speed, stated.speed, text);
        text.line("LIN {" + krl::position(operation.runs[end].start, point_decimals) + "}");
    } else {
        const Vec3 last = operation.runs.back().moves.back().tip;
        if (operation.exit.retract > 0) {
            set_speed(operation.exit.retract_speed, stated.speed, text);
            text.line("LIN {" + krl::position(last + operation.exit.retract * operation.tool_axis, point_decimals) +
                      "}");
        }
        for (const Joints& target : operation.exit.targets) add_joint_move(target, operation.table_angle, text);
    }
    text.line("END");
    return text;
}

}  // namespace qchopper
