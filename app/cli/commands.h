// The commands: each passes its arguments to app/engine or app/dispatch, shows the report of app/report and returns the
// exit code.
//
// They throw InputError, DeviceError and Cancelled, which run_program() reports; terminal.unchanged is then the
// sentence about what is unchanged.

#pragma once

#include "app/cli/arguments/arguments.h"
#include "app/cli/terminal.h"
#include "app/engine/open_project.h"
#include "app/report/cell/dispatch_report.h"

namespace qchopper {

int run(const SampleArguments& arguments, Terminal& terminal);
int run(const FuseArguments& arguments, Terminal& terminal);
int run(const InspectArguments& arguments, Terminal& terminal);
int run(const RepairArguments& arguments, Terminal& terminal);
int run(const PrepareArguments& arguments, Terminal& terminal);
int run(const SegmentArguments& arguments, Terminal& terminal);
int run(const ExplainArguments& arguments, Terminal& terminal);
int run(const GuideArguments& arguments, Terminal& terminal);
int run(const ExportArguments& arguments, Terminal& terminal);
int run(const CellsListArguments& arguments, Terminal& terminal);
int run(const CellsShowArguments& arguments, Terminal& terminal);
int run(const CellsCheckArguments& arguments, Terminal& terminal);
int run(const CellsRobotsArguments& arguments, Terminal& terminal);
int run(const CellsNewArguments& arguments, Terminal& terminal);
int run(const CellsReachArguments& arguments, Terminal& terminal);
int run(const SetupArguments& arguments, Terminal& terminal);
int run(const WorkArguments& arguments, Terminal& terminal);
int run(const SubmitArguments& arguments, Terminal& terminal);
int run(const GatherArguments& arguments, Terminal& terminal);
int run(const VerifyArguments& arguments, Terminal& terminal);
int run(const KeysArguments& arguments, Terminal& terminal);
int run(const DryRunArguments& arguments, Terminal& terminal);
int run(const CellSimArguments& arguments, Terminal& terminal);
int run(const DispatchArguments& arguments, Terminal& terminal);
int run(const JournalArguments& arguments, Terminal& terminal);
int run(const JournalJobsArguments& arguments, Terminal& terminal);
int run(const JournalExportArguments& arguments, Terminal& terminal);
int run(const CellControlArguments& arguments, Terminal& terminal);
int run(const CellCheckArguments& arguments, Terminal& terminal);
int run(const SchemaArguments& arguments, Terminal& terminal);
int run(const ServeArguments& arguments, Terminal& terminal);
int run(const ConsoleWorkerArguments& arguments, Terminal& terminal);
int run(const ConsoleMeshArguments& arguments, Terminal& terminal);
int run(const ConsolePaintArguments& arguments, Terminal& terminal);
int run(const ConsoleReplayArguments& arguments, Terminal& terminal);

struct GatherAnswer;
// For gather and submit: what prepare shows, or why it is not there yet.
int show(const GatherAnswer& answer, const std::filesystem::path& project, Terminal& terminal);

// For prepare and gather: shows table or document and returns the exit code.
int show(const PreparedProject& prepared, Terminal& terminal);

// For dry-run and dispatch: shows table or document and returns the exit code.
int show(const DispatchReport& report, const std::string& schema, Terminal& terminal);

}  // namespace qchopper
