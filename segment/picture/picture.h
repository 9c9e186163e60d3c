// The picture of meshes as PNG. No GPU, no window.
//
// The view is orthographic and framed on its own, so that everything is in it. Same input, same bytes, whatever the
// number of threads (tests/segment/picture/picture_test.cpp).

#pragma once

#include <span>

#include "base/context.h"
#include "base/files/file.h"
#include "segment/picture/camera.h"
#include "segment/picture/lettering.h"
#include "segment/picture/scene.h"

namespace qchopper {

// Throws InputError (use) if there is no triangle to draw or an option makes no sense; Cancelled on request. Progress:
// rows drawn.
Pixels render(const Scene& scene, const PictureOptions& options = {}, const Context& context = {});
// The same as PNG.
Bytes render_png(const Scene& scene, const PictureOptions& options = {}, const Context& context = {});
Bytes render_png(std::span<const ColouredMesh> meshes, const PictureOptions& options = {}, const Context& context = {});

}  // namespace qchopper
