// Draws the machine over the block at the tightest pose of a work envelope, for the setup sheet.
//
// Links of the arm are capsules; spindle, holder and tool cylinders; the block is drawn by its edges with the piece in
// it; table and obstacles are solid. Same input, same bytes, whatever the number of threads
// (tests/cam/job/sheet/envelope_picture_test.cpp).

#pragma once

#include "base/files/file.h"
#include "cam/job/job.h"

namespace qchopper {

constexpr int envelope_picture_width = 1000;
constexpr int envelope_picture_height = 750;

// PNG. `lying` is the piece in setup coordinates. Precondition: input.machine_reachability.is_arm_checked.
Bytes envelope_picture(const JobInput& input, const TriangleMesh& lying);

}  // namespace qchopper
