// Lines that switch spindle and extraction and ask for a tool, by the signals and calls that a cell file names.

#pragma once

#include "cam/cell/cell.h"
#include "cam/post/krl_text.h"

namespace qchopper {

// Throws InputError (config) if the cell file names no signal for spindle.on or spindle.at_speed, or none that switches
// the spindle off.
void check_signals(const CellMachine& machine);

// Preconditions of all: check_signals() holds.
void start_spindle(const CellMachine& machine, double rpm, KrlText& text);
void stop_spindle(const CellMachine& machine, KrlText& text);
void start_extraction(const CellMachine& machine, KrlText& text);
void stop_extraction(const CellMachine& machine, KrlText& text);
// The call that the cell file names, or a stop in which the operator changes the tool and checks its length.
void ask_for_tool(const CellMachine& machine, const CuttingTool& tool, KrlText& text);

}  // namespace qchopper
