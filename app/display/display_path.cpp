// As display_format.cpp: differences, and bytes of one meaning together.

#include "app/display/display_path.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>

#include "app/display/display_bytes.h"

namespace qchopper {
namespace {

constexpr std::array<std::uint8_t, 4> path_mark{'Q', 'C', 'P', '1'};
constexpr std::size_t head_bytes = 4 + 2 * 4 + 4 * 8;
constexpr std::uint32_t max_line = std::numeric_limits<std::int32_t>::max();  // so that a difference has a zigzag code

Bytes codes_of(const DisplayPath& path) {
    Bytes codes;
    std::uint32_t ms = 0;
    for (const std::uint32_t next : path.ms) {
        put_code(codes, next - ms);
        ms = next;
    }
    std::int64_t line = 0;
    for (const std::uint32_t next : path.lines) {
        put_code(codes, zigzag(next - line));
        line = next;
    }
    return codes;
}

std::vector<std::uint32_t> read_times(std::span<const std::uint8_t> codes, std::size_t& at, std::size_t count) {
    std::vector<std::uint32_t> times(count);
    std::uint64_t ms = 0;
    for (std::uint32_t& time : times) {
        ms += read_code(codes, at);
        demand_display(ms <= std::numeric_limits<std::uint32_t>::max(), "a time is too large");
        time = static_cast<std::uint32_t>(ms);
    }
    return times;
}

std::vector<std::uint32_t> read_lines(std::span<const std::uint8_t> codes, std::size_t& at, std::size_t count) {
    std::vector<std::uint32_t> lines(count);
    std::int64_t line = 0;
    for (std::uint32_t& own : lines) {
        line += from_zigzag(read_code(codes, at));
        demand_display(line >= 0 && line <= max_line, "a line is none");
        own = static_cast<std::uint32_t>(line);
    }
    return lines;
}

}  // namespace

bool is_valid(const DisplayPath& path) {
    const std::size_t count = path.points.size();
    if (path.ms.size() != count || path.lines.size() != count || path.kinds.size() != count) return false;
    const double most = path.grid.step * max_display_coordinate;
    for (int axis = 0; axis < 3; ++axis) {
        if (!std::isfinite(path.grid.origin[axis]) || !std::isfinite(path.grid.origin[axis] + most)) return false;
    }
    const auto is_in_grid = [](const DisplayPoint& p) {
        return std::ranges::all_of(p, [](std::uint16_t x) { return x <= max_display_coordinate; });
    };
    return std::isfinite(path.grid.step) && path.grid.step > 0 && std::ranges::all_of(path.points, is_in_grid) &&
           std::ranges::is_sorted(path.ms) &&
           std::ranges::all_of(path.lines, [](std::uint32_t line) { return line <= max_line; }) &&
           std::ranges::all_of(path.kinds, [](std::uint8_t kind) { return kind < display_way_kinds; });
}

Bytes encode_display_path(const DisplayPath& path) {
    assert(is_valid(path));
    const Bytes codes = codes_of(path);
    Bytes out(path_mark.begin(), path_mark.end());
    put(out, static_cast<std::uint32_t>(path.points.size()));
    put(out, static_cast<std::uint32_t>(codes.size()));
    const Vec3& origin = path.grid.origin;
    for (const double x : {origin.x, origin.y, origin.z, path.grid.step}) put(out, x);
    put_positions(out, path.points);
    out.insert(out.end(), path.kinds.begin(), path.kinds.end());
    out.insert(out.end(), codes.begin(), codes.end());
    return out;
}

DisplayPath decode_display_path(std::span<const std::uint8_t> bytes) {
    demand_display(has_mark(bytes, path_mark), "it does not begin with QCP1");
    demand_display(bytes.size() >= head_bytes, "it ends within its head");
    DisplayReader in(bytes.subspan(path_mark.size()));
    const std::uint64_t count = in.number<std::uint32_t>();
    const std::uint64_t code_bytes = in.number<std::uint32_t>();
    // before anything is made of that size
    demand_display(bytes.size() == head_bytes + (display_point_bytes + 1) * count + code_bytes,
                   "it is not as long as its head says");
    DisplayPath path;
    for (double* x : {&path.grid.origin.x, &path.grid.origin.y, &path.grid.origin.z, &path.grid.step}) *x = in.real();
    path.points = read_positions(in, count);
    const auto kinds = in.take(count);
    path.kinds.assign(kinds.begin(), kinds.end());
    const auto codes = in.take(code_bytes);
    std::size_t at = 0;
    path.ms = read_times(codes, at, count);
    path.lines = read_lines(codes, at, count);
    demand_display(at == codes.size(), "there are more bytes than points need");
    demand_display(is_valid(path), "grid, points and kinds do not belong together");
    return path;
}

}  // namespace qchopper
