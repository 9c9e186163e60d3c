// The commands: each takes what was typed, calls app/project and app/report, and returns the exit code.

#pragma once

#include "app/cli/arguments.h"
#include "app/cli/terminal.h"
#include "app/project/hand_over.h"

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

// What dry-run and dispatch share: hands the jobs over, shows table or document, and returns the exit code.
int hand_over(const std::vector<PieceJob>& jobs, RegisterBus& bus, const DispatchOptions& options,
              const std::string& schema, Terminal& terminal);

}  // namespace qchopper
