// Draws the piece in its block as it will be milled, from two opposite sides, for the setup sheet.
//
// Shown are the surface in colours by what becomes of it, glue faces of the block with the names of their neighbours,
// the block and its spoil layer as thin bars, an arrow for each direction with its number in the sheet, and the points
// to touch off. Same input, same bytes, whatever the number of threads (tests/cam/job/sheet/setup_picture_test.cpp).

#pragma once

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

// Of a face of the block that is a glue face, in colours that differ from those of the surface for colour-blind eyes
// too.
Rgb glue_colour(BlockFace face);

// `lying` is the piece in setup coordinates, its triangles in the order of the piece's.
SetupPictures setup_pictures(const JobInput& input, const TriangleMesh& lying);

}  // namespace qchopper
