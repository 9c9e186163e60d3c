// Writes the setup sheet: what a person at the cell has to do, as HTML to be read beside the pictures of
// setup_picture.h and to be printed on one page of A4. What is behind it stands in sheet_details.h.
//
// Well-formed, without scripts and without anything from elsewhere; every text is escaped
// (tests/cam/job/sheet/setup_sheet_test.cpp, tests/cam/job/sheet/sheet_pages_test.cpp).

#pragma once

#include <cstdint>
#include <string>

#include "cam/job/job.h"

namespace qchopper {

// Its head says DO NOT START if the piece does not fit, and that the job is unreachable if it is. The time is that of
// the ticket, in seconds.
std::string setup_sheet(const JobInput& input, std::uint32_t estimated_time_s);

}  // namespace qchopper
