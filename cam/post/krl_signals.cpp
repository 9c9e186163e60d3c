// One or two lines a signal.

#include "cam/post/krl_signals.h"

#include <optional>
#include <string>

namespace qchopper {
namespace {

constexpr double max_analogue = 1.000001;  // of $ANOUT
constexpr double max_argument = 1e6;

void switch_signal(const std::optional<Signal>& signal, bool is_on, KrlText& text) {
    if (!signal) return;
    if (signal->kind == SignalKind::call) return text.line(signal->target + "( )");
    text.line("$OUT[" + signal->target + "] = " + (is_on ? "TRUE" : "FALSE"));
}

void wait_for(const Signal& signal, KrlText& text) {
    if (signal.kind == SignalKind::call) return text.line(signal.target + "( )");
    text.line("WAIT FOR $IN[" + signal.target + "]");
}

}  // namespace

void start_spindle(const CellMachine& machine, double rpm, KrlText& text) {
    const Spindle& spindle = machine.spindle;
    if (spindle.speed) {
        const double value = rpm * spindle.speed->scale;
        if (spindle.speed->kind == SignalKind::call) {
            text.line(spindle.speed->target + "(" + written_number("speed of the spindle", value, 1, max_argument) +
                      ")");
        } else {
            const std::string volts = written_number("speed of the spindle", value, 5, max_analogue);
            text.line("$ANOUT[" + spindle.speed->target + "] = " + volts);
        }
    }
    switch_signal(spindle.on, true, text);
    wait_for(*spindle.at_speed, text);
}

void stop_spindle(const CellMachine& machine, KrlText& text) {
    switch_signal(machine.spindle.off ? machine.spindle.off : machine.spindle.on, false, text);
}

void start_extraction(const CellMachine& machine, KrlText& text) {
    if (!machine.extraction) return;
    switch_signal(machine.extraction->on, true, text);
    if (machine.extraction->running) wait_for(*machine.extraction->running, text);
}

void stop_extraction(const CellMachine& machine, KrlText& text) {
    if (machine.extraction) switch_signal(machine.extraction->off, false, text);
}

}  // namespace qchopper
