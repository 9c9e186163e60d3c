// Runs a program and measures its time and the most memory that it had.

#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace qchopper::bench {

struct ChildResult {
    int status = -1;        // as wait4 reports it; -1: it was not started
    double peak_bytes = 0;  // resident; Linux counts at least the peak of the program that started it
    double wall = 0;        // seconds
    double cpu = 0;         // seconds of all its threads, in user and kernel mode
};

// Where the output of a child goes: to files that are made or emptied.
struct ChildStreams {
    std::filesystem::path out = "/dev/null";
    std::filesystem::path err = {};  // empty: to stderr of this program
};

// Waits for its end. The first word is the program.
ChildResult run(const std::vector<std::string>& command, const ChildStreams& streams = {});

}  // namespace qchopper::bench
