// Which cells the tip has to visit follows from where the tool touches: a ball over a CL surface touches its radius
// away from its middle, against the normal of the CL surface. At a crease, where it touches on both sides, the slopes
// to both sides are taken. O(cells).
//
// The floor is no surface of the piece. The region to be finished holds surface of the piece alone, and the floor is
// given beside it (FinishingOptions::floor): over it levels go up to one radius above it, around whatever the tool
// touches there. The lowest one passes the foot of each wall with the centre of the ball at z = 0 and so removes all
// foam above z = 0 within the tool's diameter of the wall; no rows go over the floor. With the floor in the region,
// every wall over it was milled from top to foot, also walls that stand only because the piece hides what is under
// them: 40 % of the passes and two thirds of the lines of the head of Igea at 1 m. Cost: such walls keep the allowance
// of roughing, which took up to 0.02 percentage points of what is within tolerance, and where the floor is nearer to
// the base than a radius the cleared strip is narrower.
// Tests: tests/cam/toolpath/finishing_test.cpp, TheFloorIsClearedWithoutTheWallBesideIt and
// TheStripUnderAnOverhangingEdgeIsCarved.

#include "cam/toolpath/finishing/finishing.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <deque>
#include <functional>
#include <iterator>
#include <limits>
#include <string>
#include <utility>

#include "base/error.h"
#include "base/parallel.h"
#include "base/units.h"
#include "cam/toolpath/finishing/raster_passes.h"
#include "cam/toolpath/finishing/scallop.h"
#include "cam/toolpath/finishing/waterline_passes.h"
#include "cam/toolpath/pass_stretches.h"
#include "segment/raster/square_dilation.h"

namespace qchopper {
namespace {

// Shares of a stepover. Half a stepover beyond its end a pass leaves a scallop as high as in the middle between two, so
// that passes need hardly overlap those of other regions.
constexpr double pass_overlap = 0.1;  // by which passes run on beyond their region
constexpr double row_margin = 0.25;   // beside the region, over which rows may run on
constexpr double short_pass = 0.75;   // length of a pass that is not worth a way there where longer ones are near

void check(const CuttingTool& tool, const FinishingOptions& options) {
    const auto refuse = [](const std::string& what) {
        throw InputError(InputFault::use, "finishing: " + what, "give another value");
    };
    if (!(options.scallop > 0) || !std::isfinite(options.scallop)) refuse("scallop is not a height above zero");
    if (!(options.path_tolerance > 0) || !std::isfinite(options.path_tolerance)) {
        refuse("path_tolerance is not a length above zero");
    }
    if (!(options.rounding >= 0) || !std::isfinite(options.rounding)) refuse("rounding is not a length from zero on");
    if (!(options.steep_deg > 0 && options.steep_deg < 90)) refuse("steep_deg is not between 0 and 90");
    if (tool.shape != ToolShape::ball) refuse("tool " + std::to_string(tool.number) + " is no ball");
    if (!(options.scallop <= 0.5 * tool.diameter)) refuse("scallop is above the radius of the tool");
}

// Slopes of the CL surface to both sides of a cell.
struct SideSlopes {
    std::array<double, 2> x{};
    std::array<double, 2> y{};

    SideSlopes(const HeightField& cl, std::size_t column, std::size_t row) {
        const auto z = [&](std::size_t c, std::size_t r) { return static_cast<double>(cl.at(c, r)); };
        const std::size_t west = column > 0 ? column - 1 : column;
        const std::size_t east = std::min(column + 1, cl.columns - 1);
        const std::size_t south = row > 0 ? row - 1 : row;
        const std::size_t north = std::min(row + 1, cl.rows - 1);
        const double own = z(column, row);
        x = {(own - z(west, row)) / cl.cell, (z(east, row) - own) / cl.cell};
        y = {(own - z(column, south)) / cl.cell, (z(column, north) - own) / cl.cell};
    }
    double mean_x() const { return 0.5 * (x[0] + x[1]); }
    double mean_y() const { return 0.5 * (y[0] + y[1]); }
};

// Whether the tool touches what belongs to the region.
bool touches(const HeightField& cl, const FinishingRegion& region, double radius, std::size_t column, std::size_t row) {
    const SideSlopes slopes(cl, column, row);
    const auto cell_at = [&](double x, std::size_t count) {
        return static_cast<std::size_t>(std::clamp(std::floor(x), 0.0, static_cast<double>(count - 1)));
    };
    for (const double x : slopes.x) {
        for (const double y : slopes.y) {
            const double upright = 1 / std::sqrt(1 + x * x + y * y);
            const double away = radius / cl.cell * upright;
            const std::size_t c = cell_at(static_cast<double>(column) + 0.5 + away * x, cl.columns);
            const std::size_t r = cell_at(static_cast<double>(row) + 0.5 + away * y, cl.rows);
            const double height = static_cast<double>(cl.at(column, row)) + radius * (1 - upright);
            // On a slope the point may be as much lower as it is off by a cell.
            const double rise = std::min(radius, cl.cell * std::hypot(x, y));
            if (height + rise + cl.cell >= static_cast<double>(region[r * cl.columns + c])) return true;
        }
    }
    return false;
}

struct FinishingMasks {
    CellMask flat;
    CellMask steep;
};

// The cells at which the tool touches the region, by how steep the CL surface is there.
FinishingMasks masks_of(const HeightField& cl, const FinishingRegion& region, const FieldTiles* tiles, double radius,
                        double min_slope) {
    FinishingMasks masks;
    masks.flat.assign(cl.height.size(), 0);
    masks.steep.assign(cl.height.size(), 0);
    const auto mark = [&](std::size_t column, std::size_t row) {
        if (!touches(cl, region, radius, column, row)) return;
        const SideSlopes slopes(cl, column, row);
        const bool is_steep = std::hypot(slopes.mean_x(), slopes.mean_y()) > min_slope;
        CellMask& mask = is_steep ? masks.steep : masks.flat;
        mask[row * cl.columns + column] = 1;
    };
    // What a tool touches lies at most its radius beside its tip.
    FieldTiles near(cl.columns, cl.rows);
    for (std::size_t i = 0; i < region.size(); ++i) {
        if (region[i] < not_finished) near.add(i);
    }
    near = near.grown(static_cast<std::size_t>(radius / cl.cell) + 2);
    if (tiles != nullptr) near = near.common(*tiles);
    parallel_for(0, cl.rows, [&](std::size_t row) {
        for (const CellSpan& span : near.spans(row)) {
            for (std::size_t column = span.first; column < span.end; ++column) mark(column, row);
        }
    });
    return masks;
}

// The cells of the floor over which the tip is less than its radius above it, and those beside them.
WaterlineFloor foot_of_walls(const HeightField& cl, const FinishingRegion& floor, double radius) {
    assert(floor.size() == cl.height.size());
    WaterlineFloor foot;
    foot.top = static_cast<double>(*std::min_element(floor.begin(), floor.end())) + radius;
    foot.cells.assign(floor.size(), 0);
    for (std::size_t i = 0; i < floor.size(); ++i) {
        if (floor[i] < not_finished && static_cast<double>(cl.height[i]) < foot.top) foot.cells[i] = 1;
    }
    foot.cells = dilate_by_square(foot.cells, cl.columns, cl.rows, 1);
    return foot;
}

// The cells that are at most so far from one of the mask, measured along the CL surface from cell to cell. A cell that
// has come nearer is asked for its neighbours until none comes nearer (R. Bellman, "On a routing problem", 1958).
class SurfaceGrowth {
 public:
    SurfaceGrowth(const CellMask& mask, const HeightField& cl, double by)
        : cl_(cl), by_(static_cast<float>(by)), distance_(mask.size(), std::numeric_limits<float>::infinity()) {
        for (std::size_t i = 0; i < mask.size(); ++i) {
            if (mask[i] != 0) distance_[i] = 0;
        }
        for (std::size_t i = 0; i < mask.size(); ++i) {
            if (mask[i] != 0) spread(i);
        }
        while (!nearer_.empty()) {
            const std::size_t cell = nearer_.front();
            nearer_.pop_front();
            spread(cell);
        }
    }
    CellMask mask() const {
        CellMask result(distance_.size());
        for (std::size_t i = 0; i < result.size(); ++i) result[i] = distance_[i] <= by_ ? 1 : 0;
        return result;
    }

 private:
    void spread(std::size_t cell) {
        const std::size_t column = cell % cl_.columns;
        if (column > 0) go(cell, cell - 1);
        if (column + 1 < cl_.columns) go(cell, cell + 1);
        if (cell >= cl_.columns) go(cell, cell - cl_.columns);
        if (cell + cl_.columns < distance_.size()) go(cell, cell + cl_.columns);
    }
    void go(std::size_t cell, std::size_t to) {
        if (distance_[to] <= distance_[cell]) return;
        const float far = distance_[cell] + std::hypot(static_cast<float>(cl_.cell), cl_.height[to] - cl_.height[cell]);
        if (far >= distance_[to] || far > by_) return;
        distance_[to] = far;
        nearer_.push_back(to);
    }

    const HeightField& cl_;
    float by_;
    std::vector<float> distance_;
    std::deque<std::size_t> nearer_;  // cells whose neighbours are still to be asked
};

// Cells that hang together, and how far apart their heights are.
class SteepRegions {
 public:
    SteepRegions(const HeightField& cl, FinishingMasks& masks) : cl_(cl), masks_(masks), rest_(masks.steep) {}

    // Patches lower than a height belong to the flat cells: rows go over them.
    void give_low_ones_to_flat(double height) {
        for (std::size_t i = 0; i < rest_.size(); ++i) {
            if (rest_[i] == 0 || collect(i) >= height) continue;
            for (const std::size_t cell : region_) {
                masks_.steep[cell] = 0;
                masks_.flat[cell] = 1;
            }
        }
    }

 private:
    double collect(std::size_t first) {
        region_.assign(1, first);
        rest_[first] = 0;
        float low = cl_.height[first];
        float high = low;
        for (std::size_t k = 0; k < region_.size(); ++k) {
            const std::size_t cell = region_[k];
            low = std::min(low, cl_.height[cell]);
            high = std::max(high, cl_.height[cell]);
            const std::size_t column = cell % cl_.columns;
            if (column > 0) visit(cell - 1);
            if (column + 1 < cl_.columns) visit(cell + 1);
            if (cell >= cl_.columns) visit(cell - cl_.columns);
            if (cell + cl_.columns < cl_.height.size()) visit(cell + cl_.columns);
        }
        return static_cast<double>(high) - static_cast<double>(low);
    }
    void visit(std::size_t cell) {
        if (rest_[cell] == 0) return;
        rest_[cell] = 0;
        region_.push_back(cell);
    }

    const HeightField& cl_;
    FinishingMasks& masks_;
    CellMask rest_;  // cells that are of no patch yet
    std::vector<std::size_t> region_;
};

// Short open passes that have a longer one within a stepover or two: on a bumpy piece a sixth of all passes, for a
// fiftieth of their length.
void leave_out_short_ones(std::vector<Pass>& passes, const HeightField& cl, double stepover) {
    const auto is_short = [&](const Pass& pass) { return !pass.is_closed && length_of(pass) < short_pass * stepover; };
    const auto squares = [&](std::size_t cells) {
        return static_cast<std::size_t>(static_cast<double>(cells) * cl.cell / stepover) + 1;
    };
    const std::size_t columns = squares(cl.columns);
    const std::size_t rows = squares(cl.rows);
    CellMask near(columns * rows, 0);  // squares that longer passes come to
    const auto square_of = [&](Vec3 tip) {
        const auto at = [&](double x, std::size_t count) {
            return static_cast<std::size_t>(std::clamp(std::floor(x / stepover), 0.0, static_cast<double>(count - 1)));
        };
        return at(tip.y, rows) * columns + at(tip.x, columns);
    };
    for (const Pass& pass : passes) {
        if (is_short(pass)) continue;
        for (std::size_t i = 1; i < pass.points.size(); ++i) {
            const Vec3 from = pass.points[i - 1].tip;
            const Vec3 way = pass.points[i].tip - from;
            const double parts = std::ceil(2 * norm(way) / stepover) + 1;
            for (double k = 0; k <= parts; ++k) near[square_of(from + (k / parts) * way)] = 1;
        }
    }
    near = dilate_by_square(near, columns, rows, 1);
    std::erase_if(passes,
                  [&](const Pass& pass) { return is_short(pass) && near[square_of(pass.points.front().tip)] != 0; });
}

}  // namespace

double finishing_stepover(const CuttingTool& tool, const FinishingOptions& options) {
    check(tool, options);
    return chord_for_scallop(0.5 * tool.diameter, options.scallop);
}

double finishing_margin(const CuttingTool& tool, const FinishingOptions& options, double cell) {
    // From the surface to the tip that touches it, twice to what passes go beyond it, and the slopes there.
    return 0.5 * tool.diameter + 2 * finishing_stepover(tool, options) + 3 * cell;
}

std::vector<Pass> finishing_passes(const HeightField& cl, const CuttingTool& tool, const FinishingRegion& region,
                                   const FinishingOptions& options, const Context& context) {
    const double stepover = finishing_stepover(tool, options);
    assert(region.size() == cl.height.size());
    const double radius = 0.5 * tool.diameter;
    const auto report = [&](std::size_t done) {
        context.check_cancelled();
        context.progress("steps of finishing", done, 4);
    };
    report(0);
    const double min_slope = std::tan(radians(options.steep_deg));
    FinishingMasks masks = masks_of(cl, region, options.tiles, radius, min_slope);
    report(1);
    SteepRegions(cl, masks).give_low_ones_to_flat(0.5 * stepover);
    const double overlap = pass_overlap * stepover;
    const auto by = static_cast<std::size_t>(std::ceil(0.5 * stepover / cl.cell));
    const FinishingRegion wide_region = erode_by_square(region, cl.columns, cl.rows, by);
    report(2);
    const RasterOptions common{radius, options.scallop, options.path_tolerance, overlap, options.rounding};
    // With the cells at the foot of a wall: squares of waterlines() may begin at them.
    CellMask steep = SurfaceGrowth(dilate_by_square(masks.steep, cl.columns, cl.rows, 1), cl, overlap).mask();
    WaterlineFloor foot;
    if (options.floor != nullptr) {
        foot = foot_of_walls(cl, *options.floor, radius);
        std::transform(steep.begin(), steep.end(), foot.cells.begin(), steep.begin(), std::bit_or<>());
    }
    std::vector<Pass> passes = waterline_passes(cl, {std::move(masks.steep), std::move(steep)},
                                                {wide_region, foot, options.tool}, min_slope, common, context);
    report(3);
    const CellMask flat = SurfaceGrowth(masks.flat, cl, row_margin * stepover).mask();
    std::vector<Pass> rows = raster_passes(cl, {masks.flat, flat}, common, context);
    std::move(rows.begin(), rows.end(), std::back_inserter(passes));
    report(4);
    leave_out_short_ones(passes, cl, stepover);
    return passes;
}

}  // namespace qchopper
