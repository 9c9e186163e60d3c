// Exit codes after sysexits, so that scripts can tell what went wrong. One table for all commands.

#pragma once

#include "base/error.h"
#include "devices/device_error.h"

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
    exit_interrupted = 130,  // Ctrl-C; finished work is kept
    exit_terminated = 143    // SIGTERM; the same
};

constexpr ExitCode exit_code(InputFault fault) {
    switch (fault) {
        case InputFault::use:
            return exit_use;
        case InputFault::mesh:
            return exit_mesh;
        case InputFault::missing:
            return exit_missing;
        case InputFault::create:
            return exit_create;
        case InputFault::io:
            return exit_io;
        case InputFault::busy:
            return exit_busy;
        case InputFault::config:
            return exit_config;
    }
    return exit_internal;
}

constexpr ExitCode exit_code(DeviceFault fault) {
    switch (fault) {
        case DeviceFault::unreachable:
            return exit_unreachable;
        case DeviceFault::protocol:
            return exit_protocol;
        case DeviceFault::busy:
            return exit_busy;
        case DeviceFault::refused:
            return exit_demand_broken;
    }
    return exit_internal;
}

}  // namespace qchopper
