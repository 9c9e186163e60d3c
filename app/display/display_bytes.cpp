// Differences to the point before are small, and bytes of one meaning stand together, which is what deflate packs well.

#include "app/display/display_bytes.h"

#include <limits>
#include <string>

#include "base/error.h"

namespace qchopper {

void demand_display(bool holds, const char* what) {
    if (holds) return;
    throw InputError(InputFault::mesh, std::string("the display mesh is damaged: ") + what, "make it again");
}

void put_code(Bytes& out, std::uint32_t code) {
    for (; code >= 128; code /= 128) out.push_back(static_cast<std::uint8_t>(code % 128 + 128));
    out.push_back(static_cast<std::uint8_t>(code));
}

std::uint32_t read_code(std::span<const std::uint8_t> bytes, std::size_t& at) {
    std::uint64_t code = 0;
    for (unsigned shift = 0;; shift += 7) {
        demand_display(at < bytes.size() && shift < 35, "a number has no end");
        const std::uint8_t byte = bytes[at++];
        code |= std::uint64_t{byte % 128U} << shift;
        if (byte >= 128) continue;
        demand_display(byte > 0 || shift == 0, "a number is longer than it needs to be");
        demand_display(code <= std::numeric_limits<std::uint32_t>::max(), "a number is too large");
        return static_cast<std::uint32_t>(code);
    }
}

void put_positions(Bytes& out, const std::vector<DisplayPoint>& points) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::size_t low = out.size();
        const std::size_t high = low + points.size();
        out.resize(high + points.size());
        int before = 0;
        for (std::size_t i = 0; i < points.size(); ++i) {
            const std::uint32_t code = zigzag(points[i][axis] - before);
            before = points[i][axis];
            out[low + i] = static_cast<std::uint8_t>(code);
            out[high + i] = static_cast<std::uint8_t>(code >> 8);
        }
    }
}

std::vector<DisplayPoint> read_positions(DisplayReader& in, std::size_t count) {
    std::vector<DisplayPoint> points(count);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto low = in.take(count);
        const auto high = in.take(count);
        std::int64_t here = 0;
        for (std::size_t i = 0; i < count; ++i) {
            here += from_zigzag(low[i] + 256U * high[i]);
            demand_display(here >= 0 && here <= max_display_coordinate, "a point is outside of the grid");
            points[i][axis] = static_cast<std::uint16_t>(here);
        }
    }
    return points;
}

}  // namespace qchopper
