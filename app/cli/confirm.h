// Questions on the terminal.

#pragma once

#include <string>

#include "app/dispatch/operator.h"

namespace qchopper {

// Asks on the terminal. Throws InputError (use) if there is none, and Cancelled if a stop was requested.
bool is_confirmed(const std::string& question);

// The person at the terminal, if there is one.
Operator operator_at_terminal();

}  // namespace qchopper
