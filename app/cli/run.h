// The program behind main: from the command line to the exit code (exit_code.h).
//
// Every error is caught here and reported in one line (docs/user/troubleshooting.md, tests/app/cli/bad_input_test.cpp).

#pragma once

namespace qchopper {

// Throws nothing.
int run_program(int argc, const char* const* argv);

}  // namespace qchopper
