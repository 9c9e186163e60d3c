// Bytes as lower-case hexadecimal digits, two per byte, and back (tests/base/text_test.cpp).

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

// Fills `bytes` from exactly two digits per byte. Returns false for any other text, upper-case digits included; the
// content of `bytes` is then unspecified.
bool read_hex(std::string_view digits, std::span<std::uint8_t> bytes);

// The same by value; nothing for any text but 2 * size digits.
template <std::size_t size>
std::optional<std::array<std::uint8_t, size>> from_hex(std::string_view digits) {
    std::array<std::uint8_t, size> bytes{};
    if (!read_hex(digits, bytes)) return std::nullopt;
    return bytes;
}

}  // namespace qchopper
