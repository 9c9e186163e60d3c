// The section of the details on joints: holes, who drills them, and the templates.
//
// Tests: tests/cam/job/job_caps_test.cpp.

#pragma once

#include <string>

#include "cam/job/job.h"

namespace qchopper {

// HTML; a sentence if the piece has no joint.
std::string cap_section(const JobInput& input);

}  // namespace qchopper
