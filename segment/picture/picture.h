// Renders meshes as a PNG by casting rays. No GPU, no window.
//
// Millimetres. The projection is orthographic and the frame is chosen so that all is in the picture. The same input
// gives the same bytes for any number of threads (tests/segment/picture/picture_test.cpp).

#pragma once

#include <span>

#include "base/context.h"
#include "base/file.h"
#include "segment/picture/coloured.h"

namespace qchopper {

struct PictureOptions {
    int width = 1200;  // pixels
    int height = 900;
    Vec3 view{-0.55, 0.75, -0.38};  // the direction of the view; any length
    Vec3 up{0, 0, 1};
    Rgb background{250, 250, 248};
    int supersampling = 2;  // rays per pixel: this squared
    int ambient_rays = 16;  // per ray that hits, for the soft light of the sky; 0: none
    double outline = 1.2;   // width of the dark line at the border of a piece, in pixels; 0: none
    double frame = 0.06;    // empty border, as a share of the picture
};

// A mesh that is null or empty is left out. Reports progress in rows of samples. Throws InputError (use) if there is no
// triangle to draw or an option is out of its range, Cancelled if the context is cancelled.
Bytes render_png(std::span<const ColouredMesh> meshes, const PictureOptions& options = {}, const Context& context = {});

}  // namespace qchopper
