// Bytes as text of 64 characters, as data in a document of text needs it (RFC 4648, section 4;
// tests/base/text_test.cpp).

#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace qchopper {

// Four characters for three bytes, filled up with "=".
std::string to_base64(std::span<const std::uint8_t> bytes);

}  // namespace qchopper
