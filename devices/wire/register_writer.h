// Writes numbers, text and bytes as 16-bit registers, and reads them back.
//
// 32 and 64 bits have the high register first; of text and bytes the first of two stands in the high byte. Reading what
// was written gives it back (tests/devices/wire/register_writer_test.cpp).

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "devices/wire/bus.h"

namespace qchopper {

// The registers as they go over the wire, two bytes each, the high one first.
std::vector<std::uint8_t> bytes_of(std::span<const std::uint16_t> registers);

// CRC-32 of IEEE 802.3 (reflected, init and xorout all ones); "123456789" gives 0xCBF43926.
std::uint32_t crc32_of(std::span<const std::uint8_t> bytes);
// Of bytes_of(registers).
std::uint32_t crc32_of_registers(std::span<const std::uint16_t> registers);

// The longest beginning of `text` of at most `max_bytes` bytes that does not end inside a UTF-8 character.
std::string_view cut_utf8(std::string_view text, std::size_t max_bytes);

// Appends one field after the other. Each function returns the writer.
class RegisterWriter {
 public:
    RegisterWriter& u16(std::uint16_t value);
    RegisterWriter& u32(std::uint32_t value);
    RegisterWriter& u64(std::uint64_t value);
    RegisterWriter& i32(std::int32_t value) { return u32(static_cast<std::uint32_t>(value)); }
    RegisterWriter& bytes(std::span<const std::uint8_t> data);  // an odd last byte in the high half
    // Exactly so many registers: cut by cut_utf8, padded with zeros.
    RegisterWriter& text(std::string_view characters, std::size_t registers);
    RegisterWriter& zeros(std::size_t registers);
    RegisterWriter& crc() { return u32(crc32_of_registers(registers_)); }  // over everything so far
    const Registers& registers() const { return registers_; }

 private:
    Registers registers_;
};

// Reads one field after the other; behind the end everything is 0. The registers must outlive the reader.
class RegisterReader {
 public:
    explicit RegisterReader(std::span<const std::uint16_t> registers) : registers_(registers) {}
    std::uint16_t u16();
    std::uint32_t u32();
    std::uint64_t u64();
    std::int32_t i32() { return static_cast<std::int32_t>(u32()); }
    void bytes(std::span<std::uint8_t> data);  // fills it; (size + 1) / 2 registers
    std::string text(std::size_t registers);   // up to the first NUL
    void skip(std::size_t registers) { at_ += registers; }

 private:
    std::span<const std::uint16_t> registers_;
    std::size_t at_ = 0;
};

bool is_all_zero(std::span<const std::uint16_t> registers);

}  // namespace qchopper
