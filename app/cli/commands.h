// The commands: each passes its arguments to app/engine or app/dispatch, shows the report of app/report and returns the
// exit code.
//
// They throw InputError, DeviceError and Cancelled, which run_program() reports; terminal.unchanged is then the
// sentence about what is unchanged.

#pragma once

#include "app/cli/arguments/arguments.h"
#include "app/cli/terminal.h"
#include "app/dispatch/hand_over.h"
#include "devices/wire/modbus_tcp.h"

namespace qchopper {

int run(const SampleArguments& arguments, Terminal& terminal);
int run(const InspectArguments& arguments, Terminal& terminal);
int run(const RepairArguments& arguments, Terminal& terminal);
int run(const PrepareArguments& arguments, Terminal& terminal);
int run(const SegmentArguments& arguments, Terminal& terminal);
int run(const ExplainArguments& arguments, Terminal& terminal);
int run(const ExportArguments& arguments, Terminal& terminal);
int run(const CellsListArguments& arguments, Terminal& terminal);
int run(const CellsShowArguments& arguments, Terminal& terminal);
int run(const CellsCheckArguments& arguments, Terminal& terminal);
int run(const CellsReachArguments& arguments, Terminal& terminal);
int run(const SetupArguments& arguments, Terminal& terminal);
int run(const VerifyArguments& arguments, Terminal& terminal);
int run(const DryRunArguments& arguments, Terminal& terminal);
int run(const CellSimArguments& arguments, Terminal& terminal);
int run(const DispatchArguments& arguments, Terminal& terminal);
int run(const JournalArguments& arguments, Terminal& terminal);
int run(const CellControlArguments& arguments, Terminal& terminal);

// For dry-run and dispatch: hands the jobs over, shows table or document, and returns the exit code. `next` is the
// command that comes next if all end complete, or empty.
int hand_over(const std::vector<PieceJob>& jobs, RegisterBus& bus, const DispatchOptions& options, Journal& journal,
              const std::string& schema, const std::string& next, Terminal& terminal);

// STATUS of the cell, read before anything is sent. Throws DeviceError, and Cancelled if a stop was requested.
Status first_status(ModbusTcpBus& bus, const std::string& where, Terminal& terminal);

// Asks on the terminal. Throws InputError (use) if there is none, and Cancelled if a stop was requested.
bool is_confirmed(const std::string& question);

}  // namespace qchopper
