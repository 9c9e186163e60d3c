// Shifts and masks, so that the byte order of the computer does not matter; CRC-32 by zlib. O(bytes).

#include "devices/wire/register_writer.h"

#include <zlib.h>

#include <algorithm>
#include <cassert>

namespace qchopper {

std::vector<std::uint8_t> bytes_of(std::span<const std::uint16_t> registers) {
    std::vector<std::uint8_t> bytes(2 * registers.size());
    RegisterReader(registers).bytes(bytes);
    return bytes;
}

std::uint32_t crc32_of(std::span<const std::uint8_t> bytes) {
    return static_cast<std::uint32_t>(crc32_z(0, bytes.data(), bytes.size()));
}

std::uint32_t crc32_of_registers(std::span<const std::uint16_t> registers) {
    return crc32_of(bytes_of(registers));
}

std::string_view cut_utf8(std::string_view text, std::size_t max_bytes) {
    if (text.size() <= max_bytes) return text;
    std::size_t end = max_bytes;
    while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80) --end;
    return text.substr(0, end);
}

RegisterWriter& RegisterWriter::u16(std::uint16_t value) {
    registers_.push_back(value);
    return *this;
}

RegisterWriter& RegisterWriter::u32(std::uint32_t value) {
    return u16(static_cast<std::uint16_t>(value >> 16)).u16(static_cast<std::uint16_t>(value & 0xFFFF));
}

RegisterWriter& RegisterWriter::u64(std::uint64_t value) {
    return u32(static_cast<std::uint32_t>(value >> 32)).u32(static_cast<std::uint32_t>(value & 0xFFFFFFFF));
}

RegisterWriter& RegisterWriter::bytes(std::span<const std::uint8_t> data) {
    for (std::size_t i = 0; i < data.size(); i += 2) {
        const unsigned low = i + 1 < data.size() ? data[i + 1] : 0U;
        u16(static_cast<std::uint16_t>((data[i] << 8U) | low));
    }
    return *this;
}

RegisterWriter& RegisterWriter::text(std::string_view characters, std::size_t registers) {
    const std::string_view fitting = cut_utf8(characters, 2 * registers);
    assert(fitting.size() <= 2 * registers);
    std::vector<std::uint8_t> padded(2 * registers, 0);
    std::copy(fitting.begin(), fitting.end(), padded.begin());
    return bytes(padded);
}

RegisterWriter& RegisterWriter::zeros(std::size_t registers) {
    registers_.insert(registers_.end(), registers, 0);
    return *this;
}

std::uint16_t RegisterReader::u16() {
    const std::size_t at = at_++;
    return at < registers_.size() ? registers_[at] : std::uint16_t{0};
}

std::uint32_t RegisterReader::u32() {
    const std::uint32_t high = u16();
    return (high << 16) | u16();
}

std::uint64_t RegisterReader::u64() {
    const std::uint64_t high = u32();
    return (high << 32) | u32();
}

void RegisterReader::bytes(std::span<std::uint8_t> data) {
    for (std::size_t i = 0; i < data.size(); i += 2) {
        const std::uint16_t pair = u16();
        data[i] = static_cast<std::uint8_t>(pair >> 8);
        if (i + 1 < data.size()) data[i + 1] = static_cast<std::uint8_t>(pair & 0xFF);
    }
}

std::string RegisterReader::text(std::size_t registers) {
    std::vector<std::uint8_t> raw(2 * registers);
    bytes(raw);
    return {raw.begin(), std::find(raw.begin(), raw.end(), std::uint8_t{0})};
}

bool is_all_zero(std::span<const std::uint16_t> registers) {
    return std::all_of(registers.begin(), registers.end(), [](std::uint16_t value) { return value == 0; });
}

}  // namespace qchopper
