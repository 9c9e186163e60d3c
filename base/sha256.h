// SHA-256 (FIPS 180-4) of bytes and files, by OpenSSL.

#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

namespace qchopper {

using Sha256 = std::array<std::uint8_t, 32>;

Sha256 sha256(std::span<const std::uint8_t> bytes);

// 64 lower-case hexadecimal digits.
std::string to_hex(const Sha256& digest);

}  // namespace qchopper
