// What --help shows below the options: examples of one command, or of the whole data flow.

#pragma once

#include <string>

namespace qchopper {

// For an empty name the examples of the data flow, with the exit codes; empty for an unknown command.
std::string examples_of(const std::string& command);

}  // namespace qchopper
