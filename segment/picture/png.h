// Encodes pixels as a PNG file in memory, 8 bits per channel. The same pixels give the same bytes.

#pragma once

#include <vector>

#include "base/files/file.h"
#include "segment/picture/colour.h"

namespace qchopper {

// Rows from the top, each from the left. Preconditions: width and height are positive, pixels.size() is their product.
Bytes to_png(const std::vector<Rgb>& pixels, int width, int height);

}  // namespace qchopper
