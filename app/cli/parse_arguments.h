// Reads the command line. The only files that know the option parser are parse_arguments.cpp and project_options.cpp.

#pragma once

#include <optional>

#include "app/cli/arguments.h"

namespace qchopper {

// Nothing if help or version was asked for: it is on stdout then. Throws InputError (use).
std::optional<Arguments> parse_arguments(int argc, const char* const* argv);

}  // namespace qchopper
