// Triangles are drawn row by row at the centres of cells; several threads raise a cell to the highest of them, whatever
// their order. After the drop-cutter on a height field: tip heights by dilation with the tool's shape, the surface that
// is left by erosion (K. Suresh and D. C. H. Yang, "Constant scallop-height machining of free-form surfaces", 1994, for
// the offset; J. Serra, "Image analysis and mathematical morphology", 1982, for the closing).
// O(triangles + cells covered); the closing O(cells * (radius / cell)^2). Cell centres are opposed to cell centres: the
// CL surfaces of cam/stock/cl_surface.h take each cell at its point nearest to the axis, for tools of any shape.

#include "segment/raster/height_field.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "base/box.h"
#include "base/error.h"
#include "base/parallel.h"
#include "segment/mesh/footprint.h"
#include "segment/raster/cells_under.h"
#include "segment/raster/shared_value.h"

namespace qchopper {
namespace {

constexpr double steep = 0.0523;  // sine of 3 degrees
constexpr std::size_t triangles_at_once = 4096;

// A triangle in the coordinates of a map, in cells across and mm along the direction.
struct MapTriangle {
    std::array<Vec3, 3> corner;
    double low_z = 0;
    double high_z = 0;
    double slope_x = 0;  // of z, mm per cell; not finite for a triangle seen from its edge
    double slope_y = 0;

    MapTriangle(const TriangleMesh& mesh, std::size_t triangle, const HeightField& map) {
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3 p = apply(map.piece_in_field, mesh.points[mesh.triangles[triangle][k]]);
            corner[k] = {p.x / map.cell, p.y / map.cell, p.z};
        }
        low_z = std::min({corner[0].z, corner[1].z, corner[2].z});
        high_z = std::max({corner[0].z, corner[1].z, corner[2].z});
        const Vec3 n = cross(corner[1] - corner[0], corner[2] - corner[0]);
        slope_x = -n.x / n.z;
        slope_y = -n.y / n.z;
    }

    // On its plane, but not beyond its corners.
    float height(double x, double y) const {
        const double z = corner[0].z + slope_x * (x - corner[0].x) + slope_y * (y - corner[0].y);
        return static_cast<float>(std::isfinite(z) ? std::clamp(z, low_z, high_z) : high_z);
    }

    // Calls visit(column, row, height) for every cell of the map whose middle lies in the triangle.
    template <class Visit>
    void for_each_cell(const HeightField& map, const Visit& visit) const {
        for_each_row_under(corner, map.columns, map.rows, [&](std::size_t row, const CellSpan& covered) {
            const double y = static_cast<double>(row) + 0.5;
            for (std::size_t column = covered.first; column < covered.end; ++column) {
                visit(column, row, height(static_cast<double>(column) + 0.5, y));
            }
        });
    }
};

// Rows of a ball-ended tool, in cells around its axis: how much lower than its surface the tip is.
struct BallRow {
    std::ptrdiff_t row;
    std::vector<float> drop;  // mm, not positive; an odd number of them, the middle one on the axis
};

std::vector<BallRow> ball_rows(double radius, double cell) {
    std::vector<BallRow> rows;
    const auto reach = static_cast<std::ptrdiff_t>(radius / cell);
    for (std::ptrdiff_t row = -reach; row <= reach; ++row) {
        BallRow part{row, {}};
        for (std::ptrdiff_t column = -reach; column <= reach; ++column) {
            const double square = cell * cell * static_cast<double>(row * row + column * column);
            if (square > radius * radius) continue;
            part.drop.push_back(static_cast<float>(std::sqrt(radius * radius - square) - radius));
        }
        rows.push_back(part);
    }
    return rows;
}

constexpr std::size_t rows_at_once = 64;

}  // namespace

HeightField height_field(const TriangleMesh& mesh, Vec3 direction, double cell) {
    assert(is_consistent(mesh) && !mesh.triangles.empty() && cell > 0);
    assert(std::abs(norm(direction) - 1) < 1e-9);
    HeightField map;
    map.cell = cell;
    const auto [e1, e2] = frame_under(direction);
    map.piece_in_field.row = {e1, e2, direction};
    Box box{rotate(map.piece_in_field, mesh.points.front()), rotate(map.piece_in_field, mesh.points.front())};
    for (const Vec3& p : mesh.points) extend(box, rotate(map.piece_in_field, p));
    const Vec3 size = box.size();
    if ((size.x / cell + 1) * (size.y / cell + 1) > static_cast<double>(max_field_cells)) {
        throw InputError(InputFault::use, "a height map of the piece would have too many cells", "use larger cells");
    }
    map.columns = static_cast<std::size_t>(size.x / cell) + 1;
    map.rows = static_cast<std::size_t>(size.y / cell) + 1;
    map.piece_in_field.shift = {-box.min.x, -box.min.y, -box.centre().z};
    map.height.assign(map.columns * map.rows, HeightField::nothing);
    parallel_ranges(0, mesh.triangles.size(), triangles_at_once, [&](std::size_t first, std::size_t end) {
        for (std::size_t t = first; t < end; ++t) {
            MapTriangle(mesh, t, map).for_each_cell(map, [&](std::size_t column, std::size_t row, float z) {
                raise_shared(map.height[row * map.columns + column], z);
            });
        }
    });
    return map;
}

bool is_steep(const TriangleMesh& mesh, std::size_t triangle, Vec3 direction) {
    return std::abs(dot(normalized(area_vector(mesh, triangle)), direction)) < steep;
}

std::vector<float> reached_share(const TriangleMesh& mesh, const HeightField& map) {
    const Vec3 direction = map.tool_axis();
    const double extent = static_cast<double>(std::max(map.columns, map.rows)) * map.cell;
    const auto rounding = static_cast<float>(1e-5 * extent);
    std::vector<float> share(mesh.triangles.size(), 0);
    parallel_ranges(0, share.size(), triangles_at_once, [&](std::size_t first, std::size_t end) {
        for (std::size_t t = first; t < end; ++t) {
            if (dot(normalized(area_vector(mesh, t)), direction) < steep) continue;
            const MapTriangle triangle(mesh, t, map);
            std::size_t covered = 0;
            std::size_t reached = 0;
            triangle.for_each_cell(map, [&](std::size_t column, std::size_t row, float z) {
                ++covered;
                if (z >= map.at(column, row) - rounding) ++reached;
            });
            if (covered > 0) {
                share[t] = static_cast<float>(reached) / static_cast<float>(covered);
                continue;
            }
            // Smaller than a cell: its plane is compared at the centre of the cell, as far as the plane may rise within
            // half a cell.
            const Vec3 middle = (1.0 / 3) * (triangle.corner[0] + triangle.corner[1] + triangle.corner[2]);
            const auto column = std::min(static_cast<std::size_t>(std::max(0.0, middle.x)), map.columns - 1);
            const auto row = std::min(static_cast<std::size_t>(std::max(0.0, middle.y)), map.rows - 1);
            const double rise = 0.5 * (std::abs(triangle.slope_x) + std::abs(triangle.slope_y));
            share[t] = middle.z + rise + rounding >= map.at(column, row) ? 1 : 0;
        }
    });
    return share;
}

HeightField closed_by_ball(const HeightField& map, double radius) {
    assert(radius >= 0);
    const std::vector<BallRow> ball = ball_rows(radius, map.cell);
    // The tip may stand beside the map, so the tip heights have a border as wide as the tool. They are held for some
    // rows of the map at a time; the cells under the tool have as much beside the map again.
    const std::size_t border = ball.size() / 2;
    const std::size_t columns = map.columns + 2 * border;
    HeightField closed = map;
    parallel_ranges(0, map.rows, rows_at_once, [&](std::size_t first, std::size_t end) {
        const std::size_t tip_rows = end - first + 2 * border;
        std::vector<float> tip(columns * tip_rows, HeightField::nothing);
        std::vector<float> under(map.columns + 4 * border, HeightField::nothing);
        for (std::size_t from = first > 2 * border ? first - 2 * border : 0;
             from < std::min(map.rows, end + 2 * border); ++from) {
            std::copy_n(&map.height[from * map.columns], map.columns, &under[2 * border]);
            for (const BallRow& part : ball) {
                const std::ptrdiff_t row =
                    static_cast<std::ptrdiff_t>(from + border) - static_cast<std::ptrdiff_t>(first) - part.row;
                if (row < 0 || row >= static_cast<std::ptrdiff_t>(tip_rows)) continue;
                float* own = &tip[static_cast<std::size_t>(row) * columns];
                for (std::size_t i = 0; i < part.drop.size(); ++i) {
                    const float* at = &under[border + i - part.drop.size() / 2];
                    const float drop = part.drop[i];
                    for (std::size_t c = 0; c < columns; ++c) own[c] = std::max(own[c], at[c] + drop);
                }
            }
        }
        std::vector<float> lowest(map.columns);
        for (std::size_t row = first; row < end; ++row) {
            std::fill(lowest.begin(), lowest.end(), std::numeric_limits<float>::infinity());
            for (const BallRow& part : ball) {
                const auto from =
                    static_cast<std::size_t>(static_cast<std::ptrdiff_t>(row - first + border) + part.row);
                for (std::size_t i = 0; i < part.drop.size(); ++i) {
                    const float* at = &tip[from * columns + border + i - part.drop.size() / 2];
                    const float drop = part.drop[i];
                    for (std::size_t c = 0; c < map.columns; ++c) lowest[c] = std::min(lowest[c], at[c] - drop);
                }
            }
            float* own = &closed.height[row * map.columns];
            for (std::size_t c = 0; c < map.columns; ++c) own[c] = std::max(own[c], lowest[c]);
        }
    });
    return closed;
}

HeightField coarser(const HeightField& map, double factor) {
    assert(factor >= 1);
    const auto count = [&](std::size_t cells) {
        return static_cast<std::size_t>((static_cast<double>(cells) - 0.5) / factor) + 1;
    };
    HeightField coarse;
    coarse.piece_in_field = map.piece_in_field;
    coarse.cell = map.cell * factor;
    coarse.columns = count(map.columns);
    coarse.rows = count(map.rows);
    coarse.height.assign(coarse.columns * coarse.rows, HeightField::nothing);
    std::vector<std::size_t> column_of(map.columns);
    for (std::size_t c = 0; c < map.columns; ++c) column_of[c] = count(c + 1) - 1;
    for (std::size_t row = 0; row < map.rows; ++row) {
        float* under = &coarse.height[(count(row + 1) - 1) * coarse.columns];
        const float* own = &map.height[row * map.columns];
        for (std::size_t c = 0; c < map.columns; ++c) under[column_of[c]] = std::max(under[column_of[c]], own[c]);
    }
    return coarse;
}

void raise_to_coarser(HeightField& map, const HeightField& coarse, double factor) {
    const auto index = [factor](std::size_t cell, std::size_t count) {
        return std::min(static_cast<std::size_t>((static_cast<double>(cell) + 0.5) / factor), count - 1);
    };
    for (std::size_t row = 0; row < map.rows; ++row) {
        const float* under = &coarse.height[index(row, coarse.rows) * coarse.columns];
        float* own = &map.height[row * map.columns];
        for (std::size_t c = 0; c < map.columns; ++c) own[c] = std::max(own[c], under[index(c, coarse.columns)]);
    }
}

}  // namespace qchopper
