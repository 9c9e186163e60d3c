// One line per column of the grid along the upright axis (solid_lines.h): centres in its spans are inside. Voxels that
// are thick are those of blocks of 3 x 3 x 3, an opening by a cube. O(triangles + crossings + voxels log voxels).

#include "segment/structure/voxels.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "base/error.h"
#include "segment/mesh/plane_frame.h"
#include "segment/raster/solid_lines.h"

namespace qchopper {
namespace {

// The lines through the centres of voxels, in voxels from the corner.
struct CentreLines {
    std::size_t columns = 0;
    std::size_t rows = 0;
    CellSpan columns_within(double low, double high) const { return centres_within(low, high, columns); }
    CellSpan rows_within(double low, double high) const { return centres_within(low, high, rows); }
    Point2 at(std::size_t column, std::size_t row) const {
        return {static_cast<double>(column) + 0.5, static_cast<double>(row) + 0.5};
    }
};

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
    const SolidLines map = solid_lines(local, mesh.triangles, CentreLines{grid.count[0], grid.count[1]});
    std::vector<std::uint32_t> voxels;
    const std::uint32_t layer = grid.count[0] * grid.count[1];
    for (std::uint32_t line = 0; line < layer; ++line) {
        for (const SolidSpan& d : map.at(line)) {
            const CellSpan inside = centres_within(d.low, std::nextafter(d.high, d.low), grid.count[2]);
            for (std::size_t k = inside.first; k < inside.end; ++k) {
                voxels.push_back(static_cast<std::uint32_t>(k) * layer + line);
            }
        }
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
