// Triangles drawn into a grid of about 2^18 cells. O(triangles + cells drawn), one byte per cell.

#include "segment/raster/projected_area.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "segment/mesh/plane_frame.h"
#include "segment/mesh/polygon.h"

namespace qchopper {
namespace {

// The cells of a rectangle whose centres lie in some triangle.
class OccupancyGrid {
 public:
    OccupancyGrid(Point2 min, Point2 size)
        : OccupancyGrid(min, size, std::sqrt(size.x * size.y / static_cast<double>(1 << 18))) {}

    void add(std::array<Point2, 3> corner) {
        for (Point2& p : corner) p = {(p.x - min_.x) / columns_.step, (p.y - min_.y) / rows_.step};
        const auto [low, high] = std::minmax({corner[0].y, corner[1].y, corner[2].y});
        const std::size_t last = rows_.first_after(high);
        for (std::size_t row = rows_.first_after(low); row < last; ++row) add_row(corner, row);
    }

    double area() const {
        return static_cast<double>(std::count(covered_.begin(), covered_.end(), 1)) * columns_.step * rows_.step;
    }

 private:
    // Cells side by side along one axis.
    struct Cells {
        Cells(double size, double wanted_step)
            : count(static_cast<std::size_t>(std::clamp(std::ceil(size / wanted_step), 1.0, 4096.0))),
              step(size / static_cast<double>(count)) {}
        // The first cell whose middle is not before `at`, which is counted in cells.
        std::size_t first_after(double at) const {
            return static_cast<std::size_t>(std::clamp(std::ceil(at - 0.5), 0.0, static_cast<double>(count)));
        }
        std::size_t count;
        double step;  // mm
    };

    OccupancyGrid(Point2 min, Point2 size, double step)
        : min_(min), columns_(size.x, step), rows_(size.y, step), covered_(columns_.count * rows_.count, 0) {}

    void add_row(const std::array<Point2, 3>& corner, std::size_t row) {
        const double y = static_cast<double>(row) + 0.5;
        double from = std::numeric_limits<double>::infinity();
        double to = -from;
        for (int k = 0; k < 3; ++k) {
            const Point2 a = corner[k];
            const Point2 b = corner[(k + 1) % 3];
            if ((a.y <= y) == (b.y <= y)) continue;
            const double x = a.x + (b.x - a.x) * (y - a.y) / (b.y - a.y);
            from = std::min(from, x);
            to = std::max(to, x);
        }
        if (from > to) return;
        const auto begin = covered_.begin() + static_cast<std::ptrdiff_t>(row * columns_.count);
        std::fill(begin + static_cast<std::ptrdiff_t>(columns_.first_after(from)),
                  begin + static_cast<std::ptrdiff_t>(columns_.first_after(to)), char{1});
    }

    Point2 min_;
    Cells columns_;
    Cells rows_;
    std::vector<char> covered_;  // row by row
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
    OccupancyGrid grid(box.min, {box.max.x - box.min.x, box.max.y - box.min.y});
    for (const Triangle& t : mesh.triangles) grid.add({flat[t[0]], flat[t[1]], flat[t[2]]});
    return grid.area();
}

}  // namespace qchopper
