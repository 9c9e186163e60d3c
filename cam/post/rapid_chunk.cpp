// One line a move: a shift of the chunk's target, which lies in the origin of the work object and has the orientation.
// O(moves).

#include "cam/post/rapid_chunk.h"

#include "base/error.h"
#include "base/text.h"
#include "base/units.h"
#include "cam/post/chunk_lines.h"

namespace qchopper {
namespace {

constexpr double max_speed = 5000;  // mm/s
constexpr double speed_unit = 0.1;
constexpr double rounding_unit = 0.001;

void set_speed(double speed_mm_s, double& current, RapidText& text) {
    const double stepped = rounded_down(speed_mm_s, speed_unit);
    if (!(stepped > 0)) {
        throw InputError(InputFault::use,
                         "a move at " + significant(speed_mm_s, 3) + " mm/s is too slow for a program");
    }
    if (stepped != current) text.line("v.v_tcp:=" + written_number("v_tcp", stepped, 1, max_speed) + ";");
    current = stepped;
}

bool set_rounding(double rounding_mm, double& current, RapidText& text) {
    const double stepped = rounded_down(rounding_mm, rounding_unit);
    if (!(stepped > 0)) return false;
    if (stepped != current) text.line("z.pzone_tcp:=" + written_number("pzone_tcp", stepped, 3, 1000.001) + ";");
    current = stepped;
    return true;
}

}  // namespace

void RapidChunks::add_joint_speeds(RapidText& text) const {
    const std::string percent = fixed(100 * machine_.program.joint_share, 0);
    text.line("VelSet " + percent + ",5000;");
    text.line("AccSet " + percent + ",100;");
}

void RapidChunks::add_joint_move(std::size_t tool, const Joints& joints, double table_angle, RapidText& text) const {
    std::string axes;
    for (const double joint : joints) {
        axes += (axes.empty() ? "" : ",") + written_number("joint", degrees_per_radian * joint, 3, 3600);
    }
    text.line("MoveAbsJ [[" + axes + "]," + rapid::external_axes(program_.external_axis, table_angle) + "],vmax,fine," +
              names_.tool(machine_.tools[tool].number) + "\\WObj:=" + names_.work_object() + ";");
}

void RapidChunks::add_data(const ProgramOperation& operation, const ProgramRun& first, RapidText& text) const {
    const std::string turn = written_number("v_ori", degrees_per_radian * machine_.program.turn_speed, 3, 10'000);
    text.line("LOCAL VAR speeddata v:=[10," + turn + ",1000,100];");
    text.line("LOCAL VAR zonedata z:=[FALSE,1,1,1,0.1,1,0.1];");
    text.line("LOCAL CONST robtarget p:=[[0,0,0]," + rapid::quaternion(operation.tool_in_setup) + "," +
              rapid::configuration(first.start_joints) + "," +
              rapid::external_axes(program_.external_axis, operation.table_angle) + "];");
}

// From here on a spindle that loses its speed ends the program, in the trap of the main module.
void RapidChunks::add_watch(RapidText& text) const {
    const Signal& at_speed = *machine_.spindle.at_speed;
    if (at_speed.kind == SignalKind::call) return text.line(at_speed.target + ";");
    text.line("WaitDI " + at_speed.target + ",1;");
    text.line("IDelete " + names_.interrupt() + ";");
    text.line("CONNECT " + names_.interrupt() + " WITH " + names_.trap() + ";");
    text.line("ISignalDI\\Single," + at_speed.target + ",0," + names_.interrupt() + ";");
}

void RapidChunks::add_line(const ProgramOperation& operation, const std::string& position, bool is_rounded,
                           RapidText& text) const {
    text.line("MoveL Offs(p," + position + "),v," + (is_rounded ? "z," : "fine,") +
              names_.tool(machine_.tools[operation.tool].number) + "\\WObj:=" + names_.work_object() + ";");
}

RapidText RapidChunks::run(const ProgramOperation& operation, const ProgramRun& run, Stated& stated) const {
    RapidText text;
    if (run.hole > 0) text.comment("hole " + std::to_string(run.hole));
    const auto position = [](Vec3 tip) { return rapid::position(tip); };
    set_speed(run.link_speed, stated.speed, text);
    add_line(operation, position(run.start), false, text);
    for (const WrittenMove& move : written_moves(run, position)) {
        set_speed(move.speed, stated.speed, text);
        const bool is_rounded = set_rounding(move.rounding, stated.rounding, text);
        add_line(operation, move.position, is_rounded, text);
    }
    return text;
}

void RapidChunks::add_end(const RunRange& range, Stated& stated, RapidText& text) const {
    const ProgramOperation& operation = program_.operations[range.operation];
    const std::size_t end = range.first + range.count;
    if (end < operation.runs.size()) {
        set_speed(operation.runs[end].link_speed, stated.speed, text);
        return add_line(operation, rapid::position(operation.runs[end].start), false, text);
    }
    const Vec3 last = operation.runs.back().moves.back().tip;
    if (operation.exit.retract > 0) {
        set_speed(operation.exit.retract_speed, stated.speed, text);
        add_line(operation, rapid::position(last + operation.exit.retract * operation.tool_axis), false, text);
    }
    add_joint_speeds(text);
    for (const Joints& target : operation.exit.targets) {
        add_joint_move(operation.tool, target, operation.table_angle, text);
    }
}

RapidText RapidChunks::chunk(const RunRange& range, const std::string& name, std::size_t order,
                             std::size_t total) const {
    const ProgramOperation& operation = program_.operations[range.operation];
    const ProgramRun& first = operation.runs[range.first];
    RapidText text;
    rapid::begin_module(name, text);
    describe_chunk(program_, machine_, range, order, total, text);
    add_data(operation, first, text);
    text.line("PROC " + rapid_procedure(name) + "()");
    text.line("ConfL\\Off;");
    add_joint_speeds(text);
    if (machine_.extraction) rapid::switch_signal(machine_.extraction->on, true, text);
    if (machine_.spindle.speed) rapid::set_speed(*machine_.spindle.speed, operation.rpm, text);
    rapid::switch_signal(machine_.spindle.on, true, text);
    add_watch(text);
    if (range.first > 0) add_joint_move(operation.tool, first.start_joints, operation.table_angle, text);
    for (const Joints& target : operation.entry.targets) {
        if (range.first == 0) add_joint_move(operation.tool, target, operation.table_angle, text);
    }
    text.line("VelSet 100,5000;");
    const std::string limit = written_number("AccMax", machine_.program.acceleration / 1000, 4, 100);
    text.line("PathAccLim TRUE\\AccMax:=" + limit + ",TRUE\\DecelMax:=" + limit + ";");
    Stated stated;
    for (std::size_t r = range.first; r < range.first + range.count; ++r) {
        text.append(run(operation, operation.runs[r], stated));
    }
    add_end(range, stated, text);
    text.line("ENDPROC");
    text.line("ENDMODULE");
    return text;
}

}  // namespace qchopper
