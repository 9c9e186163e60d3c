// SHA-256 (FIPS 180-4) of bytes, by OpenSSL, as a value of its own type (tests/base/files/file_test.cpp).

#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "base/hex.h"

namespace qchopper {

struct Sha256 {
    std::array<std::uint8_t, 32> bytes{};
    bool operator==(const Sha256&) const = default;
};

Sha256 sha256(std::span<const std::uint8_t> bytes);

// 64 lower-case digits.
std::string to_hex(const Sha256& digest);
// The inverse of to_hex; nothing for any other text.
std::optional<Sha256> sha256_from_hex(std::string_view digits);

}  // namespace qchopper
