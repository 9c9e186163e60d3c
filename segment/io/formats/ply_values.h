// Reads the values of a PLY body one after the other, from text or from bytes.
//
// Where a value is missing or wrong the result is nothing, and place() names the line or the byte. AsciiValues and
// BinaryValues have the same functions, so that one template reads both. O(1) per value.

#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "segment/io/formats/ply_header.h"
#include "segment/io/formats/text.h"

namespace qchopper {

// Values of a text body; `lines` is the number of lines before it.
class AsciiValues {
 public:
    AsciiValues(std::string_view body, std::size_t lines) : text_(body), lines_before_(lines) {}

    std::optional<double> real(PlyType) { return number(text_.word()); }
    std::optional<std::int64_t> whole(PlyType) { return integer(text_.word()); }
    bool skip(PlyType) { return !text_.word().empty(); }
    std::string place() const { return "line " + std::to_string(lines_before_ + text_.line()); }
    // Whether so many values can follow: a character and a space each, at the least.
    bool can_hold(std::uint64_t values, std::uint64_t /*bytes*/) const { return values <= (text_.left() + 1) / 2; }
    bool is_at_end() { return text_.word().empty(); }
    // Passes the rest of the line: some writers put more values into a line than the header announces.
    void end_element() { text_.rest_of_line(); }

 private:
    Text text_;
    std::size_t lines_before_;
};

// Values of a binary body, which begins at byte `start`. Precondition: start <= file.size().
template <std::endian order>
class BinaryValues {
 public:
    BinaryValues(std::string_view file, std::size_t start) : file_(file), at_(start) {}

    std::optional<double> real(PlyType type) {
        if (type == PlyType::f32 && left() >= 4) return std::bit_cast<float>(take<std::uint32_t>());
        if (type == PlyType::f64 && left() >= 8) return std::bit_cast<double>(take<std::uint64_t>());
        if (!is_integer(type)) return {};
        const std::optional<std::int64_t> value = whole(type);
        if (!value) return {};
        return static_cast<double>(*value);
    }

    std::optional<std::int64_t> whole(PlyType type) {
        if (left() < size_of(type)) return {};
        switch (type) {
            case PlyType::i8:
                return static_cast<std::int8_t>(take<std::uint8_t>());
            case PlyType::u8:
                return take<std::uint8_t>();
            case PlyType::i16:
                return static_cast<std::int16_t>(take<std::uint16_t>());
            case PlyType::u16:
                return take<std::uint16_t>();
            case PlyType::i32:
                return static_cast<std::int32_t>(take<std::uint32_t>());
            case PlyType::u32:
                return take<std::uint32_t>();
            default:
                return {};
        }
    }

    bool skip(PlyType type) {
        if (left() < size_of(type)) return false;
        at_ += size_of(type);
        return true;
    }

    std::string place() const { return "byte " + std::to_string(at_); }
    // Whether so many bytes follow.
    bool can_hold(std::uint64_t /*values*/, std::uint64_t bytes) const { return bytes <= left(); }

    void end_element() {}

    // Some writers end a binary file with a line end or pad it with zeros.
    bool is_at_end() const {
        return std::all_of(file_.begin() + static_cast<std::ptrdiff_t>(at_), file_.end(),
                           [](char c) { return c == '\0' || c == ' ' || (c >= '\t' && c <= '\r'); });
    }

 private:
    std::size_t left() const { return file_.size() - at_; }

    template <class Unsigned>
    Unsigned take() {
        Unsigned value = 0;
        for (std::size_t i = 0; i < sizeof(Unsigned); ++i) {
            const std::size_t shift = 8 * (order == std::endian::little ? i : sizeof(Unsigned) - 1 - i);
            value = static_cast<Unsigned>(value | static_cast<Unsigned>(static_cast<std::uint8_t>(file_[at_ + i]))
                                                      << shift);
        }
        at_ += sizeof(Unsigned);
        return value;
    }

    std::string_view file_;
    std::size_t at_;
};

// read(values) with the values of the body that follows a header of `file`, and its result.
template <class Read>
auto with_values(const PlyHeader& header, std::string_view file, const Read& read) {
    if (header.format == MeshFormat::ply_little_endian)
        return read(BinaryValues<std::endian::little>(file, header.size));
    if (header.format == MeshFormat::ply_big_endian) return read(BinaryValues<std::endian::big>(file, header.size));
    return read(AsciiValues(file.substr(header.size), header.lines));
}

}  // namespace qchopper
