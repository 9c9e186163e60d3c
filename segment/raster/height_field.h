// Height fields of a piece: its highest surface along one direction, and what a tool that comes from there reaches.
//
// mm. Heights are those of the surface at the centres of square cells, in single precision about the middle of the
// piece. A direction is that of the tool axis. Agrees with rays from the surface within half a percent of the
// area (tests/segment/raster/height_field_test.cpp). The result does not depend on the number of threads.

#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "base/pose.h"
#include "segment/mesh/triangle_mesh.h"

namespace qchopper {

struct HeightField {
    static constexpr float nothing = -std::numeric_limits<float>::infinity();

    Pose piece_in_field;  // z along the direction; x and y at 0 at the corner of the first cell
    double cell = 1;      // mm
    std::size_t columns = 0;
    std::size_t rows = 0;
    std::vector<float> height;  // row by row; `nothing` where no surface lies

    float at(std::size_t column, std::size_t row) const { return height[row * columns + column]; }
    // The index of the cell that holds a place, in mm or in cells; none beside the map or where it is not a number.
    std::optional<std::size_t> cell_under(double x, double y) const { return cell_holding(x / cell, y / cell); }
    std::optional<std::size_t> cell_holding(double column, double row) const {
        if (!(column >= 0 && row >= 0 && column < static_cast<double>(columns) && row < static_cast<double>(rows))) {
            return std::nullopt;
        }
        return static_cast<std::size_t>(row) * columns + static_cast<std::size_t>(column);
    }
    // Its height; `nothing` beside the map.
    float height_under(double x, double y) const {
        const std::optional<std::size_t> index = cell_under(x, y);
        return index ? height[*index] : nothing;
    }
    Vec3 tool_axis() const { return piece_in_field.row[2]; }
};

// Some of the cells of a map: one byte each, row by row as HeightField::height; 0: not in it.
using CellMask = std::vector<std::uint8_t>;

constexpr std::size_t max_field_cells = std::size_t{1} << 28;

// Preconditions: the mesh is consistent and has a triangle with area, the direction is a unit vector, cell > 0. Throws
// InputError (use) if the map would have more than max_field_cells cells. O(triangles + cells covered), 4 bytes a cell.
HeightField height_field(const TriangleMesh& mesh, Vec3 direction, double cell);

// Per triangle the share of its area that is reached, 0 for a steep one or one that is turned away. A triangle is
// examined at the centres of the cells that it covers, at least at its own middle. O(triangles + cells covered).
std::vector<float> reached_share(const TriangleMesh& mesh, const HeightField& map);

// Whether a triangle lies within 3 degrees of the direction, |n . d| < 0.0523.
bool is_steep(const TriangleMesh& mesh, std::size_t triangle, Vec3 direction);

// The closing of a map by a ball of a radius: the surface that a ball-ended tool leaves (dilation by the tool, then
// erosion). A wall is met where it is for radii of k + 1/2 cells, k whole; else up to half a cell beside. Cells beside
// the map count as `nothing`. O(cells * (radius / cell)^2): meant for radii of a few cells; 4 bytes a cell.
HeightField closed_by_ball(const HeightField& map, double radius);

// The same surface on cells `factor` times as wide, each as high as the highest of those whose centres lie in it.
// Precondition: factor >= 1.
HeightField coarser(const HeightField& map, double factor);

// Raises each cell of a map to the cell of a coarser one that holds its centre. Precondition: the coarse map has the
// cells of coarser(map, factor).
void raise_to_coarser(HeightField& map, const HeightField& coarse, double factor);

}  // namespace qchopper
