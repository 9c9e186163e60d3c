// The setup sheet: what a person at the cell has to do, as plain text.

#pragma once

#include <string>

#include "cam/job/job.h"

namespace qchopper {

std::string setup_sheet(const JobInput& input);

}  // namespace qchopper
