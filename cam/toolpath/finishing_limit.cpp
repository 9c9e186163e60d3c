// The highest foam under discs (disc_dilation.h), the holder's limit as for passes (holder_clearance.h). A cell of a CL
// surface takes the highest limit between the middles of its neighbours: cells of limits are not narrower, so that nine
// places tell.

#include "cam/toolpath/finishing_limit.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>
#include <utility>

#include "base/parallel.h"
#include "segment/raster/disc_dilation.h"

namespace qchopper {
namespace {

constexpr double clear_of_table = 2;        // mm, of all points of a tool
constexpr double rim_clear_of_table = 1.1;  // mm; the check tool_to_table of cam/setup asks for 1
constexpr double upright = 0.9999;          // cosine of the tilt of a direction from above
constexpr double min_clearance = 0.15;      // of holder and spindle
// With several directions more of it, because foam stands up to 0.71 cells beside where another direction says so
// (holder_clearance_over allows for the cell of this one).
constexpr double clearance_cells = 0.72;
constexpr double half_diagonal = 0.5 * std::numbers::sqrt2;  // of a cell

}  // namespace

double finishing_floor(const Setup& setup, Vec3 tool_axis, double radius) {
    const double lowest = clear_of_table - setup.spoil;
    if (tool_axis.z > upright) return std::max(-radius, lowest);
    const double rim = radius * (std::sqrt(std::max(0.0, 1 - tool_axis.z * tool_axis.z)) + tool_axis.z - 1);
    return std::max(lowest, rim_clear_of_table - setup.spoil + rim);
}

HolderGap finishing_gap(const Setup& setup, double stock_cell) {
    const bool is_alone = setup.access.orientations.size() == 1;
    return {min_clearance + (is_alone ? 0 : clearance_cells * stock_cell), 1};
}

HeightField limit_over_finished(HeightField piece, double foam_left, const ToolBody& body, const HolderGap& gap,
                                double lowest) {
    // The highest point of a cell may lie so much nearer than its middle, at which foam is known.
    const double nearer = half_diagonal * piece.cell;
    for (float& z : piece.height) z += static_cast<float>(foam_left + nearer);
    return holder_clearance_over(piece, body, {gap.clearance - nearer, gap.wide_cells}, lowest);
}

HeightField limit_over_stock(const HeightField& centre_stock, const CuttingTool& tool, const ToolBody& body,
                             const HolderGap& gap, double lowest) {
    HeightField limit = holder_clearance_over(centre_stock, body, gap, lowest);
    // The tip may lie anywhere in its cell.
    const double under = std::max(0.0, 0.5 * tool.diameter - flute_rim) + half_diagonal * centre_stock.cell;
    raise_over_disc(limit, centre_stock, under, tool.flute_length, lowest);
    return limit;
}

void raise_to_limit(HeightField& cl, const HeightField& limit, const FieldTiles& tiles) {
    assert(limit.cell >= cl.cell);
    constexpr std::array<double, 3> places{-0.5, 0.5, 1.5};  // from the middle of one neighbour to that of the other
    const auto raise = [&](std::size_t column, std::size_t row) {
        double least = cl.at(column, row);
        for (const double down : places) {
            for (const double along : places) {
                const float other = limit.height_under(cl.cell * (static_cast<double>(column) + along),
                                                       cl.cell * (static_cast<double>(row) + down));
                least = std::max(least, static_cast<double>(other));
            }
        }
        cl.height[row * cl.columns + column] = static_cast<float>(least);
    };
    parallel_for(0, cl.rows, [&](std::size_t row) {
        for (const CellSpan& span : tiles.spans(row)) {
            for (std::size_t column = span.first; column < span.end; ++column) raise(column, row);
        }
    });
}

}  // namespace qchopper
