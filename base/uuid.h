// Universally unique identifiers (RFC 4122): 16 bytes (tests/base/text_test.cpp).

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

#include "base/hex.h"

namespace qchopper {

using Uuid = std::array<std::uint8_t, 16>;

// In lower-case digits, grouped: "7f0c9a1e-5c1f-4d0a-9c2e-0123456789ab".
inline std::string to_text(const Uuid& id) {
    std::string text = to_hex(id);
    for (const std::size_t at : {20, 16, 12, 8}) text.insert(at, "-");
    return text;
}

}  // namespace qchopper
