// Heights of triangles at the centres of cells by barycentric coordinates. O(cells under the triangles + triangles).

#include "sim/replay/reach/target_surface.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "sim/replay/stock/dexel.h"
#include "sim/replay/stock/tool_axis_frame.h"

namespace qchopper {
namespace {

void raise(SurfaceMap& map, Vec3 p) {
    const auto i = static_cast<std::int32_t>(std::floor((p.x - map.x_min) / map.cell));
    const auto j = static_cast<std::int32_t>(std::floor((p.y - map.y_min) / map.cell));
    if (i < 0 || j < 0 || i >= map.columns || j >= map.rows) return;
    float& height = map.height[static_cast<std::size_t>(j) * map.columns + i];
    height = std::max(height, static_cast<float>(p.z));
}

// Twice the areas of the three triangles that a point of a row makes with the sides of a triangle: linear along the
// row, with the sign of the whole.
struct AreasAlongRow {
    std::array<double, 3> at_corner{};  // at the x of the first corner
    std::array<double, 3> per_mm{};

    AreasAlongRow(const std::array<Vec3, 3>& t, double y, double area) {
        const double sign = area < 0 ? -1 : 1;
        const double b = -sign * (t[2].x - t[0].x) * (y - t[0].y);
        const double c = sign * (t[1].x - t[0].x) * (y - t[0].y);
        at_corner = {b, c, std::abs(area) - b - c};
        const double b_per_mm = sign * (t[2].y - t[0].y);
        const double c_per_mm = -sign * (t[1].y - t[0].y);
        per_mm = {b_per_mm, c_per_mm, -b_per_mm - c_per_mm};
    }
    // From the x of the first corner, where none of them is below a number: sides that are nearly along the row are
    // left out.
    Dexel where_not_below(double least) const {
        constexpr double along_row = 1e-3;
        Dexel x{-1e9, 1e9};
        for (std::size_t k = 0; k < 3; ++k) {
            const double end = (least - at_corner[k]) / per_mm[k];
            if (per_mm[k] > along_row) x.low = std::max(x.low, end);
            if (per_mm[k] < -along_row) x.high = std::min(x.high, end);
        }
        return x;
    }
};

// Of a wide triangle only the cells of a row that are between its sides, and one more at each end.
void rasterise(SurfaceMap& map, const std::array<Vec3, 3>& t) {
    constexpr std::int32_t wide = 8;  // cells
    const double area = (t[1].x - t[0].x) * (t[2].y - t[0].y) - (t[2].x - t[0].x) * (t[1].y - t[0].y);
    if (std::abs(area) < 1e-12) return;
    const auto cell_of = [&](double at, double min) { return (at - min) / map.cell - 0.5; };
    const auto [x0, x1] = std::minmax({t[0].x, t[1].x, t[2].x});
    const auto [y0, y1] = std::minmax({t[0].y, t[1].y, t[2].y});
    const auto i_first = std::max(0, static_cast<std::int32_t>(std::ceil(cell_of(x0, map.x_min))));
    const auto i_last = std::min(map.columns - 1, static_cast<std::int32_t>(std::floor(cell_of(x1, map.x_min))));
    const auto j_first = std::max(0, static_cast<std::int32_t>(std::ceil(cell_of(y0, map.y_min))));
    const auto j_last = std::min(map.rows - 1, static_cast<std::int32_t>(std::floor(cell_of(y1, map.y_min))));
    const double sign = area < 0 ? -1 : 1;
    const double beside = -2e-9 * std::abs(area);  // farther than what is asked below, without a division
    for (std::int32_t j = j_first; j <= j_last; ++j) {
        const double y = map.y_min + (j + 0.5) * map.cell;
        std::int32_t begin = i_first;
        std::int32_t last = i_last;
        if (last - begin > wide) {
            const Dexel x = AreasAlongRow(t, y, area).where_not_below(beside);
            const auto within = [&](double at) {
                return static_cast<std::int32_t>(std::clamp<double>(cell_of(at, map.x_min), i_first, i_last));
            };
            begin = std::max(begin, within(t[0].x + x.low) - 1);
            last = std::min(last, within(t[0].x + x.high) + 2);
        }
        for (std::int32_t i = begin; i <= last; ++i) {
            const double x = map.x_min + (i + 0.5) * map.cell;
            const double area_b = (x - t[0].x) * (t[2].y - t[0].y) - (t[2].x - t[0].x) * (y - t[0].y);
            const double area_c = (t[1].x - t[0].x) * (y - t[0].y) - (x - t[0].x) * (t[1].y - t[0].y);
            if (sign * area_b < beside || sign * area_c < beside || sign * (area - area_b - area_c) < beside) continue;
            const double b = area_b / area;
            const double c = area_c / area;
            if (b < -1e-9 || c < -1e-9 || b + c > 1 + 1e-9) continue;
            const double z = t[0].z + b * (t[1].z - t[0].z) + c * (t[2].z - t[0].z);
            float& height = map.height[static_cast<std::size_t>(j) * map.columns + i];
            height = std::max(height, static_cast<float>(z));
        }
    }
}

// Raises the map to the horizontal plane at a height of the setup.
void raise_to_floor(SurfaceMap& map, double floor_z) {
    const Vec3 up = map.frame_in_setup.row[2];
    if (up.z < 1e-9) return;  // seen from its edge
    const double height = floor_z - map.frame_in_setup.shift.z;
    for (std::int32_t j = 0; j < map.rows; ++j) {
        const double y = map.y_min + (j + 0.5) * map.cell;
        for (std::int32_t i = 0; i < map.columns; ++i) {
            const double x = map.x_min + (i + 0.5) * map.cell;
            float& own = map.height[static_cast<std::size_t>(j) * map.columns + i];
            own = std::max(own, static_cast<float>((height - up.x * x - up.y * y) / up.z));
        }
    }
}

}  // namespace

SurfaceMap target_surface(const ReplayScene& scene, std::size_t orientation, double cell, std::int32_t around) {
    SurfaceMap map{tool_axis_frame(scene.orientations[orientation].tool_axis), 0, 0, cell, 0, 0, {}, false};
    std::vector<Vec3> points = scene.target->points;
    for (Vec3& p : points) p = apply_inverse(map.frame_in_setup, p);
    Box box{points.front(), points.front()};
    for (const Vec3 p : points) extend(box, p);
    map.x_min = (std::floor(box.min.x / cell) - around - 1) * cell;
    map.y_min = (std::floor(box.min.y / cell) - around - 1) * cell;
    map.columns = static_cast<std::int32_t>(std::ceil((box.max.x - map.x_min) / cell)) + around + 1;
    map.rows = static_cast<std::int32_t>(std::ceil((box.max.y - map.y_min) / cell)) + around + 1;
    map.height.assign(static_cast<std::size_t>(map.columns) * static_cast<std::size_t>(map.rows), no_surface);
    for (const Triangle& t : scene.target->triangles) rasterise(map, {points[t[0]], points[t[1]], points[t[2]]});
    for (const Vec3 p : points) raise(map, p);
    raise_to_floor(map, scene.floor_z());
    return map;
}

SurfaceMap narrowed(const SurfaceMap& wide, std::int32_t by) {
    SurfaceMap map{wide.frame_in_setup,
                   wide.x_min + by * wide.cell,
                   wide.y_min + by * wide.cell,
                   wide.cell,
                   wide.columns - 2 * by,
                   wide.rows - 2 * by,
                   {},
                   false};
    map.height.reserve(static_cast<std::size_t>(map.columns) * static_cast<std::size_t>(map.rows));
    for (std::int32_t j = 0; j < map.rows; ++j) {
        const auto row = wide.height.begin() + static_cast<std::ptrdiff_t>(j + by) * wide.columns + by;
        map.height.insert(map.height.end(), row, row + map.columns);
    }
    return map;
}

}  // namespace qchopper
