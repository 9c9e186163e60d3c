// Packs bytes by gzip (RFC 1952), the same for the same content (tests/base/files/gzip_test.cpp).
//
// Level 6 of deflate, no name, time 0 and system 255 (unknown). Another version of zlib may make other bytes; they
// unpack to the same (segment/io/formats/unpack.h). O(bytes), about 20 ms per MB.

#pragma once

#include <span>

#include "base/files/file.h"

namespace qchopper {

Bytes gzip(std::span<const std::uint8_t> bytes);

}  // namespace qchopper
