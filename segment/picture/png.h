// Pixels to a PNG file in memory, 8 bits a channel. Same pixels, same bytes.

#pragma once

#include <vector>

#include "base/file.h"
#include "segment/picture/colour.h"

namespace qchopper {

// Rows from the top, each from the left; pixels.size() = width * height.
Bytes to_png(const std::vector<Rgb>& pixels, int width, int height);

}  // namespace qchopper
