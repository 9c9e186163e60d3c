// One line per column of the grid along the upright axis: its crossings with the triangles, by the half-open rule of
// line_crossing.h, are sorted, and centres between them are inside where the winding number is above 0. Only triangles
// whose box holds a line are asked.

#include "segment/structure/voxels.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "base/error.h"
#include "segment/mesh/line_crossing.h"
#include "segment/mesh/plane_frame.h"

namespace qchopper {
namespace {

struct GridCrossing {
    std::uint32_t column = 0;  // row * count[0] + column
    double at = 0;             // in voxels from the corner
    int depth_change = 0;
};

// Coordinates of a line upwards, negated across as in containment.cpp.
LineCoordinates of_line(Vec3 p) {
    return {-p.y, -p.x, p.z};
}

// The lines i + 1/2 that may lie in [low, high], as a half-open range of i.
std::array<std::uint32_t, 2> lines_within(double low, double high, std::uint32_t count) {
    const double most = count;
    const double first = std::clamp(std::ceil(low - 0.5), 0.0, most);
    const double end = std::clamp(std::floor(high - 0.5) + 1, 0.0, most);
    return {static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(std::max(first, end))};
}

void add_crossings(const std::array<Vec3, 3>& corner, const VoxelGrid& grid, std::vector<GridCrossing>& crossings) {
    const auto [low_x, high_x] = std::minmax({corner[0].x, corner[1].x, corner[2].x});
    const auto [low_y, high_y] = std::minmax({corner[0].y, corner[1].y, corner[2].y});
    const auto [first_x, end_x] = lines_within(low_x, high_x, grid.count[0]);
    const auto [first_y, end_y] = lines_within(low_y, high_y, grid.count[1]);
    if (first_x == end_x || first_y == end_y) return;
    const double upwards = cross(corner[1] - corner[0], corner[2] - corner[0]).z;
    if (upwards == 0) return;
    const std::array<LineCoordinates, 3> line{of_line(corner[0]), of_line(corner[1]), of_line(corner[2])};
    for (std::uint32_t y = first_y; y < end_y; ++y) {
        for (std::uint32_t x = first_x; x < end_x; ++x) {
            if (const auto at = line_crossing(line, -(y + 0.5), -(x + 0.5))) {
                crossings.push_back({y * grid.count[0] + x, *at, upwards > 0 ? -1 : 1});
            }
        }
    }
}

// Whether the cell at `at` moved by d, inside the grid, is filled.
struct Cells {
    VoxelPlace count;
    std::vector<std::uint8_t> filled;  // with one empty layer around

    explicit Cells(const VoxelGrid& grid) : count(grid.count) {
        filled.assign(static_cast<std::size_t>(count[0] + 2) * (count[1] + 2) * (count[2] + 2), 0);
    }
    std::size_t cell(const VoxelPlace& at) const {
        return (static_cast<std::size_t>(at[2] + 1) * (count[1] + 2) + at[1] + 1) * (count[0] + 2) + at[0] + 1;
    }
    // The distances to the 27 cells of the block around one.
    std::array<std::ptrdiff_t, 27> block() const {
        std::array<std::ptrdiff_t, 27> steps{};
        const std::ptrdiff_t row = std::ptrdiff_t{count[0]} + 2;
        const std::ptrdiff_t layer = row * (std::ptrdiff_t{count[1]} + 2);
        for (int i = 0; i < 27; ++i)
            steps[static_cast<std::size_t>(i)] = i % 3 - 1 + (i / 3 % 3 - 1) * row + (i / 9 - 1) * layer;
        return steps;
    }
};

}  // namespace

Vec3 VoxelGrid::centre(std::uint32_t number) const {
    const VoxelPlace at = place(number);
    const Vec3 along = corner + size * Vec3{at[0] + 0.5, at[1] + 0.5, at[2] + 0.5};
    return along.x * axis[0] + along.y * axis[1] + along.z * axis[2];
}

VoxelGrid voxel_grid(const TriangleMesh& mesh, Vec3 up, double size) {
    assert(!mesh.points.empty() && norm(up) > 0 && size > 0);
    VoxelGrid grid;
    grid.axis[2] = normalized(up);
    const PlaneFrame frame = frame_across(grid.axis[2]);
    grid.axis[0] = frame.u;
    grid.axis[1] = frame.v;
    grid.size = size;
    std::array<double, 3> low{};
    std::array<double, 3> high{};
    for (std::size_t k = 0; k < 3; ++k) {
        low[k] = high[k] = dot(grid.axis[k], mesh.points.front());
        for (const Vec3 p : mesh.points) {
            low[k] = std::min(low[k], dot(grid.axis[k], p));
            high[k] = std::max(high[k], dot(grid.axis[k], p));
        }
    }
    grid.corner = {low[0], low[1], low[2]};
    double cells = 1;
    for (std::size_t k = 0; k < 3; ++k) {
        const double count = std::max(1.0, std::ceil((high[k] - low[k]) / size - 1e-6));
        cells *= count + 2;
        if (!(cells <= max_voxel_cells)) {
            throw InputError(InputFault::use, "voxels of this size make a grid of more than 250 million cells",
                             "pass larger voxels");
        }
        grid.count[k] = static_cast<std::uint32_t>(count);
    }
    return grid;
}

std::vector<std::uint32_t> voxels_inside(const TriangleMesh& mesh, const VoxelGrid& grid) {
    std::vector<Vec3> local;
    local.reserve(mesh.points.size());
    for (const Vec3 p : mesh.points) local.push_back(grid.local(p));
    std::vector<GridCrossing> crossings;
    for (const Triangle& t : mesh.triangles) add_crossings({local[t[0]], local[t[1]], local[t[2]]}, grid, crossings);
    std::sort(crossings.begin(), crossings.end(), [](const GridCrossing& a, const GridCrossing& b) {
        if (a.column != b.column) return a.column < b.column;
        return a.at != b.at ? a.at < b.at : a.depth_change < b.depth_change;
    });
    std::vector<std::uint32_t> voxels;
    int depth = 0;
    const std::uint32_t layer = grid.count[0] * grid.count[1];
    for (std::size_t i = 0; i + 1 < crossings.size(); ++i) {
        const GridCrossing& from = crossings[i];
        const GridCrossing& to = crossings[i + 1];
        depth = (i > 0 && crossings[i - 1].column == from.column ? depth : 0) + from.depth_change;
        if (depth <= 0 || to.column != from.column) continue;
        const auto [first, end] = lines_within(from.at, std::nextafter(to.at, from.at), grid.count[2]);
        for (std::uint32_t k = first; k < end; ++k) voxels.push_back(k * layer + from.column);
    }
    std::sort(voxels.begin(), voxels.end());
    voxels.erase(std::unique(voxels.begin(), voxels.end()), voxels.end());
    return voxels;
}

std::vector<VoxelNeighbours> voxel_neighbours(const VoxelGrid& grid, const std::vector<std::uint32_t>& voxels) {
    const auto position = [&](std::uint32_t number) {
        const auto at = std::lower_bound(voxels.begin(), voxels.end(), number);
        return at != voxels.end() && *at == number ? static_cast<std::uint32_t>(at - voxels.begin()) : no_voxel;
    };
    std::vector<VoxelNeighbours> neighbours(voxels.size());
    for (std::size_t i = 0; i < voxels.size(); ++i) {
        const VoxelPlace at = grid.place(voxels[i]);
        std::uint32_t step = 1;
        for (std::size_t k = 0; k < 3; ++k) {
            neighbours[i][2 * k] = at[k] > 0 ? position(voxels[i] - step) : no_voxel;
            neighbours[i][2 * k + 1] = at[k] + 1 < grid.count[k] ? position(voxels[i] + step) : no_voxel;
            step *= grid.count[k];
        }
    }
    return neighbours;
}

std::vector<std::uint8_t> thick_voxels(const VoxelGrid& grid, const std::vector<std::uint32_t>& voxels) {
    Cells cells(grid);
    Cells thick(grid);
    const auto block = cells.block();
    for (const std::uint32_t v : voxels) cells.filled[cells.cell(grid.place(v))] = 1;
    for (const std::uint32_t v : voxels) {
        const auto cell = static_cast<std::ptrdiff_t>(cells.cell(grid.place(v)));
        const auto is_filled = [&](std::ptrdiff_t d) { return cells.filled[static_cast<std::size_t>(cell + d)] != 0; };
        if (!std::all_of(block.begin(), block.end(), is_filled)) continue;
        for (const std::ptrdiff_t d : block) thick.filled[static_cast<std::size_t>(cell + d)] = 1;
    }
    std::vector<std::uint8_t> result;
    result.reserve(voxels.size());
    for (const std::uint32_t v : voxels) result.push_back(thick.filled[thick.cell(grid.place(v))]);
    return result;
}

}  // namespace qchopper
