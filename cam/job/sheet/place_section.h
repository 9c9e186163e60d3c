// The section of the setup sheet on where the block stands and from what its base frame is touched off.
//
// Tests: tests/cam/job/sheet/setup_sheet_test.cpp, tests/cam/job/sheet/glue_sheet_test.cpp.

#pragma once

#include <string>

#include "cam/job/job.h"

namespace qchopper {

// HTML.
std::string place_section(const JobInput& input);

}  // namespace qchopper
