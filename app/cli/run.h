// The whole program behind main: arguments in, exit code out. Errors are caught here and nowhere else.

#pragma once

namespace qchopper {

int run_program(int argc, const char* const* argv);

}  // namespace qchopper
