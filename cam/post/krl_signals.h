// Lines that switch spindle and extraction, by the signals and calls that a cell file names.

#pragma once

#include "cam/cell/cell.h"
#include "cam/post/krl_text.h"
#include "cam/post/post_signals.h"

namespace qchopper {

// Preconditions of all: check_signals() holds.
void start_spindle(const CellMachine& machine, double rpm, KrlText& text);
void stop_spindle(const CellMachine& machine, KrlText& text);
void start_extraction(const CellMachine& machine, KrlText& text);
void stop_extraction(const CellMachine& machine, KrlText& text);

}  // namespace qchopper
