// What must stay, seen along one direction, and how deep the tip of a tool may go over it.
//
// mm. Maps of one direction of a setup (segment/raster/height_field.h) that share their frame: z along the tool
// axis. Conservative: a tool whose tip is nowhere below the CL surface cuts into no point of the target between the
// centres of cells either, but for cell^2 / (8 * radius) where a path runs from one centre to the next.

#pragma once

#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "cam/cell/cutting_tool.h"
#include "cam/setup/setup.h"
#include "segment/mesh/polygon.h"
#include "segment/mesh/triangle_mesh.h"
#include "segment/raster/field_tiles.h"
#include "segment/raster/height_field.h"

namespace qchopper {

struct PieceHeightFieldOptions {
    double cell = 0.25;
    // Height, in setup coordinates, of the plane below which no tip may go: the foam under it stays.
    double floor_z = 0;
    double border = 0;  // how far the map goes beyond the projection of the block, at least
};

// The highest point of the piece or of the floor over the whole of each cell, not only over its middle. It covers the
// projection of the block, and every cell has a height; along a direction on whose side the floor is steeper than the
// block is high, the floor ends at the block's highest and lowest point. Seen from above, its rows lie along the sides
// of the block. Maps along one direction with the same border have the same frame, whatever their cells
// (tests/cam/stock/cl_surface_test.cpp). Preconditions: the mesh is that of the piece, direction is one of
// setup.access.orientations. Throws InputError (use) if a value is not finite, the cell not above zero or the border
// below it, and as height_field() does. O(triangles + cells covered).
HeightField piece_height_field(const Setup& setup, const TriangleMesh& mesh, std::size_t orientation,
                               const PieceHeightFieldOptions& options);

// The point of a map in setup coordinates, and back.
Vec3 field_to_setup(const Setup& setup, const HeightField& map, Vec3 point);
Vec3 setup_to_field(const Setup& setup, const HeightField& map, Vec3 point);

// How far above its tip a tool is at a distance from its axis: 0 at the axis, infinite beyond its radius (ISO 14649-111
// gives the shapes; ball, flat, bull, cone). Precondition: r >= 0.
double tool_profile(const CuttingTool& tool, double r);

struct DilationOptions {
    double allowance = 0;  // that stays on the target
    // A cell is taken without a border so wide, as far as it is wide enough. A map that is the highest over each cell
    // holds smooth ground above itself already; an edge or a peak at the border of a cell is cut into by up to
    // sqrt(2) * border.
    double border = 0;
};

// The least height at which the tip may stand over cells of a map: dilation of the map by the tool, each cell taken as
// its point nearest to the tool axis. Cells beside the map count as `nothing`.
class ToolDilation {
 public:
    // The map must outlive it. Throws InputError (use) if an option is negative or not finite. O(cells).
    ToolDilation(const HeightField& target, const CuttingTool& tool, const DilationOptions& options = {});

    // The tip heights of the cells [first, end) of a row, in `tip`. O(cells * (radius / cell)^2) at most; terms that
    // cannot be the largest are left out.
    void fill(std::size_t row, std::size_t first, std::size_t end, float* tip) const;

    // Heights of which the exact one is asked for: one below `low` counts as `low`, and any from `high` on will do.
    struct Bounds {
        double low = -std::numeric_limits<double>::infinity();
        double high = std::numeric_limits<double>::infinity();
    };

    // The least height of the tip over any point of the map; over the centre of a cell that of fill().
    // O((radius / cell)^2) at most; rows whose highest cell could not raise it are left out.
    double height(double x, double y) const { return height(x, y, Bounds()); }
    double height(double x, double y, const Bounds& asked) const;

    // Per place the greatest height at it and those before, from `low` on. Places are near to each other: O((radius /
    // cell)^2 + places * cells that may raise a tip in the box around them above `low`).
    void heights_along(std::span<const Point2> places, const Bounds& asked, std::span<float> heights) const;

    const HeightField& target() const { return *target_; }

    // At least the height of the tip over each tile of 16 x 16 cells (FieldTiles), in a map of these. O(cells).
    HeightField bounds() const;

    // What remains where the tip stands over the centre of every cell: fill() then gives its height at the centres of
    // cells, and map and result are both the negative of heights.
    static ToolDilation of_negative_cl_surface(const HeightField& negative_cl_surface, const CuttingTool& tool);

 private:
    ToolDilation() = default;
    void take(const HeightField& target);
    void fill_chunk(std::size_t row, std::size_t first, std::size_t count, float* tip, float* pair) const;
    float highest(std::size_t row, std::size_t first, std::size_t end) const;

    const HeightField* target_ = nullptr;
    CuttingTool tool_;
    double allowance_ = 0;
    double inner_ = 0;                      // half the side of a cell without its border
    std::vector<std::vector<float>> drop_;  // by rows and columns from the axis: tip height less surface height
    std::vector<float> block_top_;          // highest cell of each block of a row
    std::size_t blocks_ = 0;                // per row
};

// If the CL surface of a ball rises by more than this (mm) from the centre of a cell to that of the next, there is an
// edge between them, and it is not linear.
double edge_rise(double radius, double cell);

// Whether over the centre of a cell a CL surface is what the tool alone asks for: neither holder nor foam has raised
// it since. O((radius / cell)^2).
bool is_of_tool(const HeightField& tip, const ToolDilation& tool, std::size_t cell);

// The least height at which the tip may stand over each cell so that the tool, up to its flute and shank with its whole
// diameter, stays at least `allowance` away from the target. On several threads; the result does not depend on them.
HeightField cl_surface(const HeightField& target, const CuttingTool& tool, const DilationOptions& options = {});

// The same in tiles of the target's cells. In all others a bound: the highest of the target within two tiles of the
// tool, from which on the tip may stand there too.
HeightField cl_surface(const ToolDilation& tool, const FieldTiles& tiles);

// The surface that remains where the tip has stood at its least height over the centre of every cell (erosion of the
// CL surface by the tool): nothing that the tool reaches from this direction can be lower. Cells beside the map are
// not visited. Cost as of cl_surface.
HeightField remaining_surface(const HeightField& tip, const CuttingTool& tool);

// The same in tiles; infinite in all others.
HeightField remaining_surface(const HeightField& tip, const CuttingTool& tool, const FieldTiles& tiles);

}  // namespace qchopper
