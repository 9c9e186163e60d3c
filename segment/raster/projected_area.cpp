// Triangles drawn into a grid of about 2^18 cells. O(triangles + cells drawn), one byte per cell.

#include "segment/raster/projected_area.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "segment/mesh/plane_frame.h"
#include "segment/mesh/polygon.h"
#include "segment/raster/cells_under.h"

namespace qchopper {
namespace {

// Cells side by side along one axis.
struct CellAxis {
    CellAxis(double size, double wanted_step)
        : count(static_cast<std::size_t>(std::clamp(std::ceil(size / wanted_step), 1.0, 4096.0))),
          step(size / static_cast<double>(count)) {}
    std::size_t count;
    double step;  // mm
};

}  // namespace

double projected_area_mm2(const TriangleMesh& mesh, Vec3 up) {
    const auto [e1, e2] = frame_across(up);
    std::vector<Point2> flat;
    flat.reserve(mesh.points.size());
    Rectangle2 box;
    for (const Vec3& p : mesh.points) {
        flat.push_back({dot(e1, p), dot(e2, p)});
        box.include(flat.back());
    }
    if (!(box.max.x > box.min.x) || !(box.max.y > box.min.y)) return 0;
    const Point2 size{box.max.x - box.min.x, box.max.y - box.min.y};
    const double step = std::sqrt(size.x * size.y / static_cast<double>(1 << 18));
    const CellAxis columns(size.x, step);
    const CellAxis rows(size.y, step);
    for (Point2& p : flat) p = {(p.x - box.min.x) / columns.step, (p.y - box.min.y) / rows.step};
    std::vector<char> is_covered(columns.count * rows.count, 0);  // row by row
    for (const Triangle& t : mesh.triangles) {
        const std::array<Point2, 3> corner{flat[t[0]], flat[t[1]], flat[t[2]]};
        for_each_row_under(corner, columns.count, rows.count, [&](std::size_t row, const CellSpan& cells) {
            const auto begin = is_covered.begin() + static_cast<std::ptrdiff_t>(row * columns.count);
            std::fill(begin + static_cast<std::ptrdiff_t>(cells.first), begin + static_cast<std::ptrdiff_t>(cells.end),
                      char{1});
        });
    }
    return static_cast<double>(std::count(is_covered.begin(), is_covered.end(), 1)) * columns.step * rows.step;
}

}  // namespace qchopper
