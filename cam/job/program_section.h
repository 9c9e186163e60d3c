// The section of the setup sheet about the robot program: tools, time, files, and what the proof of it found.

#pragma once

#include <string>

#include "cam/job/job.h"

namespace qchopper {

constexpr int deviation_picture_width = 1000;
constexpr int deviation_picture_height = 750;

// HTML. Without a program it says why there is none, and the crude time of the ticket (seconds).
std::string program_section(const JobInput& input, std::uint32_t estimated_time_s);

}  // namespace qchopper
