// Exit codes of all commands, after sysexits.h of BSD, so that scripts can distinguish errors
// (docs/user/troubleshooting.md).

#pragma once

namespace qchopper {

enum ExitCode : int {
    exit_done = 0,
    exit_demand_broken = 1,  // finished, but a piece does not fit, a rule is not met, a job did not run
    exit_use = 64,           // wrong option or value
    exit_mesh = 65,          // the scan is wrong
    exit_missing = 66,       // input missing or unreadable
    exit_unreachable = 69,   // cell not reachable
    exit_internal = 70,      // internal error
    exit_create = 73,        // cannot create output
    exit_io = 74,            // read or write error
    exit_busy = 75,          // try again later
    exit_protocol = 76,      // the cell answered against the protocol
    exit_config = 78,        // cell file or project file wrong
    exit_hung_up = 129,      // SIGHUP: the terminal was closed; finished work is kept
    exit_interrupted = 130,  // Ctrl-C; finished work is kept
    exit_terminated = 143    // SIGTERM; the same
};

}  // namespace qchopper
