// Bytes as lower-case hexadecimal digits, two a byte, and back.

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace qchopper {

std::string to_hex(std::span<const std::uint8_t> bytes);

// Fills `bytes` from exactly two digits a byte; false, and nothing of use in `bytes`, for any other text.
bool read_hex(std::string_view digits, std::span<std::uint8_t> bytes);

template <std::size_t size>
std::optional<std::array<std::uint8_t, size>> from_hex(std::string_view digits) {
    std::array<std::uint8_t, size> bytes{};
    if (!read_hex(digits, bytes)) return std::nullopt;
    return bytes;
}

}  // namespace qchopper
