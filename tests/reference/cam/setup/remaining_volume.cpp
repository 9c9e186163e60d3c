// A loop over the points, by slices.

#include "tests/reference/cam/setup/remaining_volume.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cassert>
#include <cmath>

#include "base/parallel.h"

namespace qchopper {

double remaining_volume(std::span<const HeightField> maps, Vec3 box_size, const Pose& box_in_piece, double step) {
    assert(!maps.empty() && step > 0);
    const auto count = [&](double length) {
        return std::max<std::size_t>(1, static_cast<std::size_t>(std::lround(length / step)));
    };
    const std::array<std::size_t, 3> counts{count(box_size.x), count(box_size.y), count(box_size.z)};
    const auto place = [&](std::size_t i, double length, std::size_t n) {
        return (static_cast<double>(i) + 0.5) * length / static_cast<double>(n);
    };
    const auto is_below = [](const HeightField& map, Vec3 in_piece) {
        const Vec3 p = apply(map.piece_in_field, in_piece);
        const double column = p.x / map.cell;
        const double row = p.y / map.cell;
        if (column < 0 || row < 0) return false;
        const auto c = static_cast<std::size_t>(column);
        const auto r = static_cast<std::size_t>(row);
        return c < map.columns && r < map.rows && p.z <= static_cast<double>(map.at(c, r));
    };
    std::atomic<std::size_t> remaining = 0;
    parallel_for(0, counts[0], [&](std::size_t x) {
        std::size_t found = 0;
        for (std::size_t y = 0; y < counts[1]; ++y) {
            for (std::size_t z = 0; z < counts[2]; ++z) {
                const Vec3 at = apply(box_in_piece, {place(x, box_size.x, counts[0]), place(y, box_size.y, counts[1]),
                                                     place(z, box_size.z, counts[2])});
                found +=
                    std::all_of(maps.begin(), maps.end(), [&](const HeightField& map) { return is_below(map, at); })
                        ? 1
                        : 0;
            }
        }
        remaining += found;
    });
    const double points =
        static_cast<double>(counts[0]) * static_cast<double>(counts[1]) * static_cast<double>(counts[2]);
    return box_size.x * box_size.y * box_size.z * static_cast<double>(remaining.load()) / points;
}

}  // namespace qchopper
