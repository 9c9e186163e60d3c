// Where parallel lines run in the material of a closed mesh: one line per cell of a grid.
//
// Lines are upright; callers turn and scale the points so that they are. Both triangles at an edge decide alike whether
// a line passes them (line_crossing.h), so no line slips through the surface. Held to lines that are intersected one by
// one by tests/segment/objectives/sweep/connector_test.cpp, and by tests/segment/structure/voxels_test.cpp.

#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "segment/mesh/line_crossing.h"
#include "segment/mesh/polygon.h"
#include "segment/mesh/triangle_mesh.h"
#include "segment/raster/cells_under.h"

namespace qchopper {

// A solid interval of a line.
struct SolidSpan {
    double low = 0;
    double high = 0;
    bool operator==(const SolidSpan&) const = default;
};

struct SolidLines {
    std::size_t columns = 0;
    std::size_t rows = 0;
    std::vector<std::uint32_t> first;  // per line, row by row: in `spans`; and one more
    std::vector<SolidSpan> spans;      // of each line ascending; they do not overlap

    std::span<const SolidSpan> at(std::size_t line) const {
        return std::span(spans).subspan(first[line], first[line + 1] - first[line]);
    }
    std::span<const SolidSpan> at(std::size_t column, std::size_t row) const { return at(row * columns + column); }
};

// Where a line crosses the surface.
struct LineCrossing {
    std::uint32_t line = 0;         // row * columns + column
    std::int32_t depth_change = 0;  // 1 where the line enters the solid, -1 where it leaves it
    double height = 0;
};

// What lies between crossings of all lines, in any order. O(crossings log crossings + lines).
SolidLines spans_between(std::vector<LineCrossing> crossings, std::size_t columns, std::size_t rows);

// `lines` says where they stand: columns and rows, their numbers; at(column, row), a Point2; columns_within(low, high)
// and rows_within(low, high), a CellSpan of at least those that stand in an interval of x or of y. A point of a line is
// in material where the surface winds around it more than 0 times: solids that overlap are one. Precondition: the
// triangles are closed and face outwards. O(points + triangles + lines asked).
template <class Lines>
SolidLines solid_lines(std::span<const Vec3> points, std::span<const Triangle> triangles, const Lines& lines) {
    std::vector<LineCrossing> crossings;
    for (const Triangle& t : triangles) {
        const std::array<Vec3, 3> p{points[t[0]], points[t[1]], points[t[2]]};
        const CellSpan columns =
            lines.columns_within(std::min({p[0].x, p[1].x, p[2].x}), std::max({p[0].x, p[1].x, p[2].x}));
        const CellSpan rows = lines.rows_within(std::min({p[0].y, p[1].y, p[2].y}), std::max({p[0].y, p[1].y, p[2].y}));
        if (columns.first >= columns.end || rows.first >= rows.end) continue;
        const double upwards = cross(p[1] - p[0], p[2] - p[0]).z;
        if (upwards == 0) continue;
        std::array<LineCoordinates, 3> corner;  // negated across, as in containment.cpp
        for (std::size_t k = 0; k < 3; ++k) corner[k] = {-p[k].y, -p[k].x, p[k].z};
        for (std::size_t row = rows.first; row < rows.end; ++row) {
            for (std::size_t column = columns.first; column < columns.end; ++column) {
                const Point2 line = lines.at(column, row);
                const auto height = line_crossing(corner, -line.y, -line.x);
                if (!height) continue;
                crossings.push_back(
                    {static_cast<std::uint32_t>(row * lines.columns + column), upwards > 0 ? -1 : 1, *height});
            }
        }
    }
    return spans_between(std::move(crossings), lines.columns, lines.rows);
}

}  // namespace qchopper
