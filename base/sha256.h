// SHA-256 (FIPS 180-4) of bytes, by OpenSSL.

#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "base/hex.h"

namespace qchopper {

using Sha256 = std::array<std::uint8_t, 32>;

Sha256 sha256(std::span<const std::uint8_t> bytes);

}  // namespace qchopper
