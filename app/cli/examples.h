// What --help shows below the options: examples of the one command, or of all.

#pragma once

#include <string>

namespace qchopper {

// Of a command by its name; of the whole way, with the exit codes, for an empty name.
std::string examples_of(const std::string& command);

}  // namespace qchopper
