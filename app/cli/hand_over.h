// What dry-run and dispatch share on the terminal.

#pragma once

#include <string>

#include "app/cli/terminal.h"
#include "app/project/hand_over.h"

namespace qchopper {

// Hands the jobs over, shows table or document, and returns the exit code.
int hand_over(const std::vector<PieceJob>& jobs, RegisterBus& bus, const DispatchOptions& options,
              const std::string& schema, Terminal& terminal);

}  // namespace qchopper
