// What the setup sheet says of glue faces: the sides of the block that a saw makes in the planes of caps.
//
// HTML; empty for a block without one. Tests: tests/cam/job/sheet/glue_sheet_test.cpp.

#pragma once

#include <string>

#include "cam/job/job.h"

namespace qchopper {

// The faces of the block with their foam and their neighbours, what to do where one is off, and the holes in them that
// are drilled by hand before the block is placed.
std::string glue_face_section(const JobInput& input);

// Whether a hole is drilled by hand before the block is milled, because its cap is a sawn side.
bool is_drilled_before(const Setup& setup, const JobCap& cap);

// "glue face -x towards B, C" behind a patch of the colour that the face has in the pictures, for each.
std::string glue_keys(const JobInput& input);

}  // namespace qchopper
