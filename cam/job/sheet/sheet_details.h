// Writes the details behind the setup sheet: why the piece lies as it lies, what was checked, joints and proof.
//
// Well-formed, without scripts and without anything from elsewhere; every text is escaped
// (tests/cam/job/sheet/setup_sheet_test.cpp).

#pragma once

#include <string>
#include <vector>

#include "cam/job/job.h"

namespace qchopper {

// HTML, details.html of the job.
std::string sheet_details(const JobInput& input);

// What sheet and details share: "piece AB (2 of 5)", the warnings of setup and project, and the end of the page.
std::string title_of(const JobInput& input);
std::vector<std::string> warnings_of(const JobInput& input);
std::string sheet_footer(const JobInput& input);

}  // namespace qchopper
