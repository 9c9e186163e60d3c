// The section of the setup sheet on what holds the block and the piece: what to do, and the check with its formulas.

#pragma once

#include <string>

#include "cam/setup/setup.h"

namespace qchopper {

// HTML. Of a cell without a machine without the check.
std::string holding_section(const Setup& setup);

// What the signs of the formulas mean, for the details.
std::string formula_section(const Setup& setup);

}  // namespace qchopper
