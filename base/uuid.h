// Universally unique identifiers (RFC 4122): 16 bytes (tests/base/text_test.cpp).

#pragma once

#include <array>
#include <cstdint>
#include <string>

namespace qchopper {

using Uuid = std::array<std::uint8_t, 16>;

// In lower-case digits, grouped: "7f0c9a1e-5c1f-4d0a-9c2e-0123456789ab".
std::string to_text(const Uuid& id);

}  // namespace qchopper
