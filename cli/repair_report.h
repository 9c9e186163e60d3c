// How the program tells what a repair has done, and what the operator chose of it.

#pragma once

#include <string>
#include <vector>

#include "cli/arguments.h"
#include "segment/intake/intake.h"
#include "segment/repair/choices.h"

namespace qchopper {

RepairChoices repair_choices(const RepairChoiceArguments& arguments);

// A line for each step that had something to do, the distance, and a verdict.
std::vector<std::string> lines(const RepairedScan& scan, const RepairArguments& arguments);
// The document qchopper-repair-1 (docs/repair.md).
std::string document(const RepairedScan& scan, const RepairArguments& arguments);

}  // namespace qchopper
