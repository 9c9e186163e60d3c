// Runs another program to its end and returns what it says (tests/base/child_process_test.cpp).

#pragma once

#include <chrono>
#include <string>
#include <vector>

namespace qchopper {

struct ChildOutput {
    int code = 0;  // its exit code; 127 if there is no such program, 128 + signal if it was killed
    std::string out;
    std::string err;
};

// `words` are the program, searched in PATH, and its arguments; its standard input is empty. It is killed after the
// limit. Precondition: there is a word. Throws std::system_error if no process can be made.
ChildOutput run_child(const std::vector<std::string>& words, std::chrono::milliseconds limit);

}  // namespace qchopper
