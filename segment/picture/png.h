// The pixels of a picture, and these encoded as a PNG file in memory, 8 bits per channel. The same pixels give the same
// bytes.

#pragma once

#include <string>
#include <vector>

#include "base/files/file.h"
#include "segment/picture/colour.h"

namespace qchopper {

struct Pixels {
    int width = 0;
    int height = 0;
    std::vector<Rgb> rows;  // from the top, each from the left: width * height
};

// Preconditions: width and height are positive, and there are as many pixels as their product.
Bytes to_png(const Pixels& pixels);

// "libpng 1.6.39, zlib 1.2.13": files of other versions may have other bytes.
std::string png_libraries();

}  // namespace qchopper
