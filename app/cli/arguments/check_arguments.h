// Checks which options go together and with the input.

#pragma once

#include "app/cli/arguments/arguments.h"

namespace qchopper {

// Throws InputError: (use) options that do not go together, that a new project needs, or that only a new project takes;
// (missing) an input that is a folder, but no project. Reads the scan of a new project if no unit is given, and throws
// what read_mesh throws.
void check_arguments(const PrepareArguments& arguments);
void check_arguments(const SegmentArguments& arguments);
void check_arguments(const CellSimArguments& arguments);
void check_arguments(const SubmitArguments& arguments);

}  // namespace qchopper
