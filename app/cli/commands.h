// The commands: each takes what was typed, calls the rooms in their order, and returns the exit code.

#pragma once

#include "app/cli/arguments.h"
#include "app/cli/terminal.h"

namespace qchopper {

int run(const SampleArguments& arguments, Terminal& terminal);
int run(const InspectArguments& arguments, Terminal& terminal);
int run(const RepairArguments& arguments, Terminal& terminal);
int run(const PrepareArguments& arguments, Terminal& terminal);
int run(const SegmentArguments& arguments, Terminal& terminal);
int run(const ExplainArguments& arguments, Terminal& terminal);
int run(const ExportArguments& arguments, Terminal& terminal);
int run(const DryRunArguments& arguments, Terminal& terminal);
int run(const CellSimArguments& arguments, Terminal& terminal);
int run(const DispatchArguments& arguments, Terminal& terminal);

}  // namespace qchopper
