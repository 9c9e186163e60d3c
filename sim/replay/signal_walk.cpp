// A signal is what the cell file says it is; any other is a finding, because nobody knows what it moves.

#include "sim/replay/signal_walk.h"

#include <optional>

#include "sim/program/program_line.h"

namespace qchopper {
namespace {

using MaybeSignal = std::optional<Signal>;

constexpr double spindle_ramp_s = 5;  // in which a spindle that is switched by words has its speed

bool is_signal(const MaybeSignal& signal, SignalKind kind, const std::string& target) {
    return signal && signal->kind == kind && lower_case(signal->target) == target;
}

MaybeSignal extraction_on(const CellMachine& machine) {
    return machine.extraction ? machine.extraction->on : std::nullopt;
}

MaybeSignal extraction_off(const CellMachine& machine) {
    return machine.extraction ? machine.extraction->off : std::nullopt;
}

MaybeSignal extraction_running(const CellMachine& machine) {
    return machine.extraction ? machine.extraction->running : std::nullopt;
}

// The line that switches off; `word`: of a language that has a word for it.
std::string off_line(const CellMachine& machine, const MaybeSignal& on, const MaybeSignal& off, const char* word) {
    const MaybeSignal& signal = off ? off : on;
    const Dialect dialect = machine.program.dialect;
    if (!signal) return dialect == Dialect::ngc ? word : "a line that the cell file does not name";
    const bool is_call = signal->kind == SignalKind::call;
    if (dialect == Dialect::rapid) return is_call ? signal->target + ";" : "SetDO " + signal->target + ",0;";
    if (dialect == Dialect::ngc) return is_call ? "o<" + signal->target + "> call" : "M65 P" + signal->target;
    return is_call ? signal->target + "( )" : "$OUT[" + signal->target + "] = FALSE";
}

// A gantry's spindle is switched by words, and the program waits a while.
bool has_speed_at_once(const CellMachine& machine) {
    return !machine.spindle.at_speed && machine.robot.has_value();
}

}  // namespace

std::vector<std::string> called_programs(const Cell& cell) {
    std::vector<std::string> names;
    if (!cell.machine) return names;
    const CellMachine& machine = *cell.machine;
    const Spindle& spindle = machine.spindle;
    for (const MaybeSignal& signal : {spindle.on, spindle.speed, spindle.at_speed, spindle.off, extraction_on(machine),
                                      extraction_off(machine), extraction_running(machine)}) {
        if (signal && signal->kind == SignalKind::call) names.push_back(signal->target);
    }
    if (machine.program.tool_change_call) names.push_back(*machine.program.tool_change_call);
    return names;
}

void SignalWalk::take(const ProgramStep& step, const std::string& name) {
    const Spindle& spindle = machine_.spindle;
    if (step.kind == StepKind::output) take_output(step, name);
    if (step.kind == StepKind::call) take_call(step, name);
    if (step.kind == StepKind::analog_output) {
        if (!is_signal(spindle.speed, SignalKind::output, name)) return refuse(step, "$ANOUT", name);
        take_speed(step.value / spindle.speed->scale);
    }
    if (step.kind == StepKind::wait_input) {
        if (is_signal(extraction_running(machine_), SignalKind::input, name)) return;
        if (!is_signal(spindle.at_speed, SignalKind::input, name)) return refuse(step, "$IN", name);
        reach_speed();
    }
    if (step.kind == StepKind::spindle) {
        if (step.value > 0) take_speed(step.value);
        switch_spindle(step.value > 0);
    }
    if (step.kind == StepKind::dwell && step.value >= spindle_ramp_s) reach_speed();
}

void SignalWalk::take_output(const ProgramStep& step, const std::string& name) {
    const auto is = [&](const MaybeSignal& signal) { return is_signal(signal, SignalKind::output, name); };
    const bool is_on = step.value > 0;
    const bool of_spindle = is(machine_.spindle.on) || is(machine_.spindle.off);
    const bool of_extraction = is(extraction_on(machine_)) || is(extraction_off(machine_));
    if (!of_spindle && !of_extraction) return refuse(step, "$OUT", name);
    if (of_spindle && (!is_on || is(machine_.spindle.on))) switch_spindle(is_on);
    if (of_extraction && (!is_on || is(extraction_on(machine_)))) switch_extraction(is_on);
}

void SignalWalk::take_speed(double rpm) {
    for (SignalState* state : {&now_, &alone_}) {
        if (rpm != state->rpm) state->has_speed = has_speed_at_once(machine_);
        state->rpm = rpm;
    }
}

void SignalWalk::take_call(const ProgramStep& step, const std::string& called) {
    const Spindle& spindle = machine_.spindle;
    const auto is = [&](const MaybeSignal& signal) { return is_signal(signal, SignalKind::call, called); };
    const std::optional<std::string>& change = machine_.program.tool_change_call;
    const bool is_change = change && lower_case(*change) == called;
    if (step.has_argument != (is(spindle.speed) || is_change)) {
        log_.add(FindingKind::unknown_signal, step.place, step.value, 0, [&] {
            return called + " is called " + (step.has_argument ? "with a value, and takes none" : "without its value");
        });
    }
    if (is(spindle.speed)) take_speed(step.value / spindle.speed->scale);
    if (is(spindle.on)) switch_spindle(true);
    if (is(spindle.off)) switch_spindle(false);
    if (is(spindle.at_speed)) reach_speed();
    if (is(extraction_on(machine_))) switch_extraction(true);
    if (is(extraction_off(machine_))) switch_extraction(false);
}

void SignalWalk::switch_spindle(bool is_on) {
    for (SignalState* state : {&now_, &alone_}) {
        if (is_on && !state->spindle_is_on) state->has_speed = has_speed_at_once(machine_);
        if (!is_on) state->has_speed = false;
        state->spindle_is_on = is_on;
    }
}

void SignalWalk::switch_extraction(bool is_on) {
    now_.extraction_is_on = alone_.extraction_is_on = is_on;
}

void SignalWalk::reach_speed() {
    for (SignalState* state : {&now_, &alone_}) state->has_speed |= state->spindle_is_on;
}

void SignalWalk::refuse(const ProgramStep& step, const std::string& what, const std::string& name) const {
    log_.add(FindingKind::unknown_signal, step.place, step.number, 0, [&] {
        return (machine_.program.dialect == Dialect::krl ? what + "[" + name + "]" : "the signal " + name) +
               " is used, and the cell file names no such signal of spindle or extraction";
    });
}

void SignalWalk::check_off(FindingKind kind, SourcePlace place, const std::string& when) const {
    const auto check = [&](bool is_on, const char* what, const std::string& line) {
        if (is_on) log_.add(kind, place, std::string(what) + " is still on " + when + ", expected before: " + line);
    };
    check(now_.spindle_is_on, "the spindle", off_line(machine_, machine_.spindle.on, machine_.spindle.off, "M5"));
    check(now_.extraction_is_on, "extraction",
          off_line(machine_, extraction_on(machine_), extraction_off(machine_), "M9"));
}

}  // namespace qchopper
