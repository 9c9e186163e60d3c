// Runs a program and measures its time and the most memory that it had.

#pragma once

#include <string>
#include <vector>

namespace qchopper::bench {

struct ChildResult {
    int status = -1;        // as wait4 reports it; -1: it was not started
    double peak_bytes = 0;  // resident
    double wall = 0;        // seconds
    double cpu = 0;         // seconds of all its threads, in user and kernel mode
};

// Waits for its end; its stdout is discarded. The first word is the program.
ChildResult run(const std::vector<std::string>& command);

}  // namespace qchopper::bench
