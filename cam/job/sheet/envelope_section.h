// The section of the details on the work envelope: every check with its margin, and the tightest pose.

#pragma once

#include <string>

#include "cam/job/job.h"

namespace qchopper {

// HTML. Of a cell without a machine: that the arm was not checked.
std::string envelope_section(const JobInput& input);

}  // namespace qchopper
