// The setup sheet: what a person at the cell has to do, as plain text.

#pragma once

#include <cstdint>
#include <string>

#include "cam/job/job.h"

namespace qchopper {

// The time is that of the ticket.
std::string setup_sheet(const JobInput& input, std::uint32_t estimated_time_s);

}  // namespace qchopper
