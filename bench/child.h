// A program of its own: how long it took and how much memory it had at most.

#pragma once

#include <string>
#include <vector>

namespace qchopper::bench {

struct Ended {
    int status = -1;
    double peak_bytes = 0;
    double wall = 0;
    double cpu = 0;  // of all its threads, in the program and for it
};

// Its stdout is thrown away.
Ended run(const std::vector<std::string>& command);

}  // namespace qchopper::bench
