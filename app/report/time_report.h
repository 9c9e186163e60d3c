// Where the machine time of jobs goes, in the reports of the commands that prove programs.
//
// Seconds and mm in documents, hours in what people read.

#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "cam/job/job_program.h"

namespace qchopper {

// The sum of all rows of one kind of operation and one tool, in the order of first use.
std::vector<MachineTime> merged(const std::vector<MachineTime>& rows);

// "machine time 45.20 h: roughing 20.10, ...": by kind of operation, by what the machine does, and the rate of
// roughing against that of its tools, which is the volume over the time at removal_mm3_per_s. Empty without rows.
std::string time_line(const std::vector<MachineTime>& rows);

// Adds the rows to a document, as in a verdict.
void add_time(nlohmann::ordered_json& document, const std::vector<MachineTime>& rows);

}  // namespace qchopper
