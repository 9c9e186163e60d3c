// Reads the command line. Only parse_arguments.cpp and project_options.cpp include the option parser.

#pragma once

#include <optional>

#include "app/cli/arguments/arguments.h"

namespace qchopper {

// Nothing if help or version was asked for, which is then printed on stdout. Throws InputError (use) for unknown
// options and commands, missing ones, and wrong values; which options go together is not checked (check_arguments.h).
std::optional<Arguments> parse_arguments(int argc, const char* const* argv);

}  // namespace qchopper
