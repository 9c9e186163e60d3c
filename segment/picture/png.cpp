// libpng's simplified API. O(pixels).

#include "segment/picture/png.h"

#include <png.h>
#include <zlib.h>

#include <cassert>
#include <new>

namespace qchopper {

Bytes to_png(const Pixels& pixels) {
    static_assert(sizeof(Rgb) == 3, "libpng reads the rows in place");
    assert(pixels.rows.size() == static_cast<std::size_t>(pixels.width) * static_cast<std::size_t>(pixels.height));
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = static_cast<png_uint_32>(pixels.width);
    image.height = static_cast<png_uint_32>(pixels.height);
    image.format = PNG_FORMAT_RGB;
    png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(image);
    Bytes bytes(size);
    if (png_image_write_to_memory(&image, bytes.data(), &size, 0, pixels.rows.data(), 0, nullptr) == 0) {
        throw std::bad_alloc();  // with these sizes nothing else can fail
    }
    bytes.resize(size);
    return bytes;
}

std::string png_libraries() {
    return std::string("libpng ") + png_get_libpng_ver(nullptr) + ", zlib " + zlibVersion();
}

}  // namespace qchopper
