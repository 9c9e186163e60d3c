// Writes the setup sheet: what a person at the cell has to do, as plain text (tests/cam/job/job_file_test.cpp).

#pragma once

#include <cstdint>
#include <string>

#include "cam/job/job.h"

namespace qchopper {

// Its head says DO NOT START if the piece does not fit. The time is that of the ticket, in seconds.
std::string setup_sheet(const JobInput& input, std::uint32_t estimated_time_s);

}  // namespace qchopper
