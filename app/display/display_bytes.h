// What the forms of display_format.h and display_path.h are written of: numbers, points and codes.
//
// Little-endian. Readers throw InputError (mesh) for what writers do not write. O(bytes).

#pragma once

#include <array>
#include <bit>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "app/display/display_mesh.h"
#include "base/files/file.h"

namespace qchopper {

constexpr std::size_t display_point_bytes = 6;

// Throws InputError (mesh).
void demand_display(bool holds, const char* what);

inline bool has_mark(std::span<const std::uint8_t> bytes, const std::array<std::uint8_t, 4>& mark) {
    return bytes.size() >= mark.size() && std::equal(mark.begin(), mark.end(), bytes.begin());
}

template <class Unsigned>
void put(Bytes& out, Unsigned value) {
    for (std::size_t i = 0; i < sizeof value; ++i) out.push_back(static_cast<std::uint8_t>(value >> 8 * i));
}

inline void put(Bytes& out, double value) {
    put(out, std::bit_cast<std::uint64_t>(value));
}

// To base 128, the lowest digit first, in as few bytes as it takes.
void put_code(Bytes& out, std::uint32_t code);
// From `at`, which goes on.
std::uint32_t read_code(std::span<const std::uint8_t> bytes, std::size_t& at);

// 0, 1, 2, 3, 4 for 0, -1, 1, -2, 2.
constexpr std::uint32_t zigzag(std::int64_t difference) {
    return static_cast<std::uint32_t>(difference >= 0 ? 2 * difference : -2 * difference - 1);
}
constexpr std::int64_t from_zigzag(std::uint32_t code) {
    const auto half = static_cast<std::int64_t>(code >> 1);
    return code % 2 == 0 ? half : -half - 1;
}

// Of the bytes that are left, which the caller has counted.
class DisplayReader {
 public:
    explicit DisplayReader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}
    std::span<const std::uint8_t> take(std::size_t count) {
        assert(count <= bytes_.size());
        const auto taken = bytes_.first(count);
        bytes_ = bytes_.subspan(count);
        return taken;
    }
    template <class Unsigned>
    Unsigned number() {
        Unsigned value = 0;
        std::size_t i = 0;
        for (const std::uint8_t byte : take(sizeof value)) value |= static_cast<Unsigned>(Unsigned{byte} << 8 * i++);
        return value;
    }
    double real() { return std::bit_cast<double>(number<std::uint64_t>()); }

 private:
    std::span<const std::uint8_t> bytes_;
};

// Of x, y and z the low bytes of the differences to the point before, then their high bytes.
void put_positions(Bytes& out, const std::vector<DisplayPoint>& points);
std::vector<DisplayPoint> read_positions(DisplayReader& in, std::size_t count);

}  // namespace qchopper
