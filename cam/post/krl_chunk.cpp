// One line a move. O(moves).

#include "cam/post/krl_chunk.h"

#include <string>

#include "base/error.h"
#include "base/text.h"
#include "base/units.h"
#include "cam/post/chunk_lines.h"
#include "cam/post/krl_signals.h"

namespace qchopper {
namespace {

constexpr double max_speed = 5;  // m/s
constexpr int point_decimals = 2;
constexpr int speed_decimals = 4;
constexpr double rounding_unit = 0.001;  // mm, of $APO.CDIS
constexpr double speed_unit = 0.1;       // mm/s, of the last decimal in m/s

// In m/s, rounded down so that no speed is above the one that was asked for.
std::string metres_per_s(double speed_mm_s) {
    const double stepped = rounded_down(speed_mm_s, speed_unit);
    if (!(stepped > 0)) {
        throw InputError(InputFault::use,
                         "a move at " + significant(speed_mm_s, 3) + " mm/s is too slow for a program");
    }
    return written_number("$VEL.CP", stepped / 1000, speed_decimals, max_speed);
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
    const double stepped = rounded_down(rounding_mm, rounding_unit);
    if (!(stepped > 0)) return false;
    if (stepped != current) text.line("$APO.CDIS = " + written_number("$APO.CDIS", stepped, 3, 1000.001));
    current = stepped;
    return true;
}

}  // namespace

void KrlChunks::add_axis_speeds(KrlText& text) const {
    const std::string percent = " = " + fixed(100 * machine_.program.joint_share, 0);
    for (std::size_t i = 1; i <= axes_of_arm; ++i) text.line("$VEL_AXIS[" + std::to_string(i) + "]" + percent);
    for (std::size_t i = 1; i <= axes_of_arm; ++i) text.line("$ACC_AXIS[" + std::to_string(i) + "]" + percent);
    if (!program_.external_axis) return;
    const std::string external = "[" + std::to_string(*program_.external_axis) + "]";
    text.line("$VEL_EXTAX" + external + percent);
    text.line("$ACC_EXTAX" + external + percent);
}

void KrlChunks::add_tool(std::size_t tool, KrlText& text) const {
    const std::uint16_t number = machine_.tools[tool].number;
    text.line("$LOAD = " + names_.load(number));
    text.line("$TOOL = " + names_.tool(number));
}

void KrlChunks::add_base(KrlText& text) const {
    if (!program_.external_axis) return text.line("$BASE = " + names_.base());
    const std::string machine = "MACHINE_DEF[" + std::to_string(*program_.external_axis + 1) + "]";
    text.line("$BASE = EK(" + machine + ".ROOT," + machine + ".MECH_TYPE," + names_.base() + ")");
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
    text.line("$ACC.CP = " + written_number("$ACC.CP", machine_.program.acceleration / 1000, 4, 100));
    for (const char* name : {"$VEL.ORI1", "$VEL.ORI2"}) {
        text.line(std::string(name) + " = " +
                  written_number(name, degrees_per_radian * machine_.program.turn_speed, 4, 10'000));
    }
}

KrlText KrlChunks::run(const ProgramOperation& operation, const ProgramRun& run, bool is_first, Stated& stated) const {
    KrlText text;
    if (run.hole > 0) text.comment("hole " + std::to_string(run.hole));
    const auto position = [](Vec3 tip) { return krl::position(tip, point_decimals); };
    set_speed(run.link_speed, stated.speed, text);
    text.line(is_first ? full_pose(operation, run.start) : "LIN {" + position(run.start) + "}");
    for (const WrittenMove& move : written_moves(run, position)) {
        set_speed(move.speed, stated.speed, text);
        const bool is_rounded = set_rounding(move.rounding, stated.rounding, text);
        text.line("LIN {" + move.position + (is_rounded ? "} C_DIS" : "}"));
    }
    return text;
}

KrlText KrlChunks::chunk(const RunRange& range, const std::string& name, std::size_t order, std::size_t total) const {
    const ProgramOperation& operation = program_.operations[range.operation];
    KrlText text;
    krl::begin_program(name, text);
    describe_chunk(program_, machine_, range, order, total, text);
    krl::watch_stops(names_, text);
    add_settings(operation, text);
    start_extraction(machine_, text);
    start_spindle(machine_, operation.rpm, text);
    krl::watch_signals(machine_, names_, text);
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
    krl::unwatch_signals(machine_, text);
    text.line("END");
    return text;
}

}  // namespace qchopper
