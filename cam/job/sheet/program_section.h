// The section of the details about the robot program: its files, and what the proof of it found.

#pragma once

#include <string>

#include "cam/job/job.h"

namespace qchopper {

constexpr int deviation_picture_width = 1000;
constexpr int deviation_picture_height = 750;

// HTML. Without a program it says why there is none.
std::string program_section(const JobInput& input);

}  // namespace qchopper
