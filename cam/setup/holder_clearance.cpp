// Each step of holder and spindle is a disc under which the highest surface is found (segment/raster/disc_dilation.h).
// What is far from the axis is met on wider cells. O(steps x cells x rows of the disc) of the cells that a step is met
// on, and up to four further maps of them.

#include "cam/setup/holder_clearance.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "base/parallel.h"
#include "cam/cell/machine_bodies.h"
#include "cam/setup/placement/machine_reachability.h"
#include "segment/raster/disc_dilation.h"

namespace qchopper {
namespace {

constexpr double rounding = 1e-3;  // mm, of heights in single precision

// The cells of a map, with nothing in them.
HeightField without_heights(const HeightField& map) {
    HeightField empty{map.piece_in_field, map.cell, map.columns, map.rows, {}};
    empty.height.assign(map.height.size(), HeightField::nothing);
    return empty;
}

struct MapHeights {
    double lowest = std::numeric_limits<double>::infinity();
    double highest = -std::numeric_limits<double>::infinity();
};

MapHeights heights_of(const HeightField& map) {
    MapHeights heights;
    for (const float height : map.height) {
        if (height == HeightField::nothing) continue;
        heights.lowest = std::min(heights.lowest, static_cast<double>(height));
        heights.highest = std::max(heights.highest, static_cast<double>(height));
    }
    return heights;
}

double narrowest(const ToolBody& body) {
    const auto is_narrower = [](const HolderStep& a, const HolderStep& b) { return a.diameter < b.diameter; };
    return std::min_element(body.steps.begin(), body.steps.end(), is_narrower)->diameter;
}

// Where the tip may stand so that no step comes below z = 0 of the setup.
class FloorLimit {
 public:
    FloorLimit(const HeightField& map, const ToolBody& tool, const Pose& piece_in_setup) : cell_(map.cell) {
        const Pose map_in_setup = piece_in_setup * inverse(map.piece_in_field);
        upright_ = map_in_setup.row[2];
        shift_ = map_in_setup.shift.z;
        min_z_ = min_tip_z(tool, std::hypot(upright_.x, upright_.y), upright_.z);
    }

    // At the centre of a cell.
    float height(std::size_t column, std::size_t row) const {
        const double z = shift_ + cell_ * (upright_.x * (static_cast<double>(column) + 0.5) +
                                           upright_.y * (static_cast<double>(row) + 0.5));
        if (upright_.z > 1e-6) return static_cast<float>((min_z_ - z) / upright_.z);
        return z < min_z_ ? std::numeric_limits<float>::max() : std::numeric_limits<float>::lowest();
    }

 private:
    double cell_;
    Vec3 upright_;  // z of the setup, in the map
    double shift_ = 0;
    double min_z_ = 0;  // of the tip, in the setup
};

}  // namespace

const CuttingTool& longest_tool(std::span<const CuttingTool> tools) {
    assert(!tools.empty());
    return *std::max_element(tools.begin(), tools.end(), [](const CuttingTool& a, const CuttingTool& b) {
        return std::pair(!is_drill(a), a.stick_out) < std::pair(!is_drill(b), b.stick_out);
    });
}

ToolBody tool_body(const CuttingTool& tool, const CellMachine& machine) {
    ToolBody body{tool.stick_out, {}};
    const std::vector<AxisBody> bodies = bodies_over_tip(tool, machine, rule_of(PoseCheck::arm_to_block).needed);
    double front = tool.stick_out;
    for (std::size_t i = 1; i < bodies.size(); ++i) {
        const double end = i + 1 < bodies.size() ? -bodies[i + 1].shape.from.z : -bodies[i].shape.to.z;
        body.steps.push_back({2 * bodies[i].shape.radius, end - front});
        front = end;
    }
    return body;
}

double min_tip_z(const ToolBody& tool, double sine, double cosine) {
    double least = std::numeric_limits<double>::lowest();
    double above = tool.stick_out;
    for (const HolderStep& step : tool.steps) {
        least = std::max(least, 0.5 * step.diameter * sine - above * cosine);
        above += step.length;
    }
    return least;
}

bool raise_to_holder_clearance(HeightField& map, const ToolBody& tool, const Pose& piece_in_setup,
                               double cells_per_radius) {
    if (tool.steps.empty()) return false;
    const double wanted = std::floor(0.5 * narrowest(tool) / cells_per_radius / map.cell);
    const auto factor = static_cast<std::size_t>(std::max(2.0, wanted));
    const HeightField wide = coarser(map, static_cast<double>(factor));
    HeightField limit = without_heights(wide);
    const MapHeights heights = heights_of(map);
    double above = tool.stick_out;
    for (const HolderStep& step : tool.steps) {
        // What begins higher above every tip than the map is high meets nothing.
        if (heights.highest - above > heights.lowest)
            raise_over_disc(limit, wide, 0.5 * step.diameter, above, heights.lowest);
        above += step.length;
    }
    const FloorLimit floor(map, tool, piece_in_setup);
    std::vector<std::uint8_t> is_row_raised(map.rows, 0);
    parallel_for(0, map.rows, [&](std::size_t row) {
        const float* under = &limit.height[row / factor * limit.columns];
        for (std::size_t column = 0; column < map.columns; ++column) {
            float& own = map.height[row * map.columns + column];
            const auto least = std::max(under[column / factor], floor.height(column, row));
            if (own == HeightField::nothing || !(least > own)) continue;
            own = least;
            is_row_raised[row] = 1;
        }
    });
    return std::find(is_row_raised.begin(), is_row_raised.end(), 1) != is_row_raised.end();
}

bool raise_to_holder(HeightField& tip, const HeightField& target, const ToolBody& body, const Pose& piece_in_setup) {
    assert(tip.columns == target.columns && tip.rows == target.rows);
    if (body.steps.empty()) return false;
    // Both the tip and the obstacle may lie anywhere in their cells, sqrt(2) of them farther apart or nearer. The cells
    // are wider for the wider steps: (48 + 1.725) / 48 = 1.036, and 1.036 * sqrt(2) < 1.725.
    constexpr double cells_per_radius = 48;
    const double wide = std::max(2 * target.cell, 0.5 * narrowest(body) / cells_per_radius);
    ToolBody grown = body;
    for (HolderStep& step : grown.steps) step.diameter += 2 * 1.725 * wide;
    HeightField limit = target;
    raise_to_holder_clearance(limit, grown, piece_in_setup, cells_per_radius);
    bool is_raised = false;
    for (std::size_t i = 0; i < tip.height.size(); ++i) {
        if (!(limit.height[i] > tip.height[i])) continue;
        tip.height[i] = limit.height[i];
        is_raised = true;
    }
    return is_raised;
}

HeightField holder_clearance_over(const HeightField& stock, const ToolBody& body, const HolderGap& gap, double lowest) {
    const float highest =
        stock.height.empty() ? HeightField::nothing : *std::max_element(stock.height.begin(), stock.height.end());
    HeightField limit = without_heights(stock);
    HeightField wide;  // made when it is needed
    HeightField wide_limit;
    double above = body.stick_out;
    for (const HolderStep& step : body.steps) {
        const double up = above - gap.clearance;
        above += step.length;
        if (static_cast<double>(highest - static_cast<float>(up)) < lowest) continue;
        const bool is_wide = gap.wide_cells > 1 && step.diameter > 80 * stock.cell;
        if (is_wide && wide.height.empty()) {
            wide = coarser(stock, gap.wide_cells);
            wide_limit = without_heights(wide);
        }
        const HeightField& map = is_wide ? wide : stock;
        // Foam may lie anywhere in its cell, and the tip in its own.
        const double radius = 0.5 * step.diameter + gap.clearance + std::numbers::sqrt2 * map.cell;
        raise_over_disc(is_wide ? wide_limit : limit, map, radius, up, lowest);
    }
    if (!wide.height.empty()) raise_to_coarser(limit, wide_limit, gap.wide_cells);
    return limit;
}

bool is_holder_limiting(double highest, const ToolBody& body, const HolderGap& gap, double lowest) {
    // The first step is the lowest.
    return !body.steps.empty() && highest - (body.stick_out - gap.clearance) >= lowest - rounding;
}

}  // namespace qchopper
