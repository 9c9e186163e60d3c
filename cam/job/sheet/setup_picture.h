// Draws the piece in its block as it will be milled, from two opposite sides, for the setup sheet.
//
// Shown are the surface in colours by what becomes of it, the block and its spoil layer as thin bars, an arrow for each
// direction with its number in the sheet, and the points to touch off. Same input, same bytes, whatever the number of
// threads (tests/cam/job/sheet/setup_picture_test.cpp).

#pragma once

#include <array>

#include "base/files/file.h"
#include "cam/job/job.h"
#include "segment/picture/colour.h"

namespace qchopper {

// PNG, setup_picture_width x setup_picture_height pixels.
struct SetupPictures {
    Bytes front;  // from the side of -y and a little of -x, a little from above
    Bytes back;   // from the opposite side, a little from below
};

constexpr int setup_picture_width = 900;
constexpr int setup_picture_height = 675;

// Colours that differ for colour-blind eyes too. What is too narrow is pale unless it counts as out of reach: it covers
// much of a bone, and what does count must be seen beside it.
Rgb surface_colour(SurfaceState state, bool narrow_counts);
constexpr Rgb base_colour{130, 134, 140};  // of the base, which is left out of all shares

// A corner of the block that the operator touches off with the tool tip.
struct TouchPoint {
    const char* name = "";
    const char* where = "";
    Vec3 at;  // mm, setup coordinates
};

// Three corners of the block's top: the first two lie along x, the third gives the side of y.
std::array<TouchPoint, 3> touch_points(const Setup& setup);

// `lying` is the piece in setup coordinates, its triangles in the order of the piece's.
SetupPictures setup_pictures(const JobInput& input, const TriangleMesh& lying);

}  // namespace qchopper
