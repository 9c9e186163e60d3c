// Each step of holder and spindle is a disc under which the highest surface is found (segment/raster/disc_dilation.h).
// O(cells x rows of the disc) of the wider cells, three further maps of them.

#include "cam/setup/holder_clearance.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

#include "base/parallel.h"
#include "segment/raster/disc_dilation.h"

namespace qchopper {
namespace {

// Raises `limit` to the highest surface within a radius, less `drop`.
void dilate_to_disc(HeightField& limit, const HeightField& map, double radius, double drop) {
    const HeightField highest = dilate_by_disc(map, radius);
    const auto less = static_cast<float>(drop);
    for (std::size_t i = 0; i < limit.height.size(); ++i) {
        limit.height[i] = std::max(limit.height[i], highest.height[i] - less);
    }
}

// Where the tip may stand so that no step comes below z = 0 of the setup.
class FloorLimit {
 public:
    FloorLimit(const HeightField& map, const ToolBody& tool, const Pose& piece_in_setup) : cell_(map.cell) {
        const Pose map_in_setup = piece_in_setup * inverse(map.piece_in_field);
        upright_ = map_in_setup.row[2];
        shift_ = map_in_setup.shift.z;
        const double sine = std::hypot(upright_.x, upright_.y);
        double above = tool.stick_out;
        for (const HolderStep& step : tool.steps) {
            min_z_ = std::max(min_z_, 0.5 * step.diameter * sine - above * upright_.z);
            above += step.length;
        }
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
    double min_z_ = std::numeric_limits<double>::lowest();  // of the tip, in the setup
};

}  // namespace

const CuttingTool& longest_tool(std::span<const CuttingTool> tools) {
    assert(!tools.empty());
    return *std::max_element(tools.begin(), tools.end(), [](const CuttingTool& a, const CuttingTool& b) {
        return std::pair(!is_drill(a), a.stick_out) < std::pair(!is_drill(b), b.stick_out);
    });
}

ToolBody tool_body(const CuttingTool& tool, const Spindle& spindle) {
    ToolBody body{tool.stick_out, tool.holder};
    if (spindle.body_offset > 0) {
        const double diameter = tool.holder.empty() ? tool.diameter : tool.holder.back().diameter;
        body.steps.push_back({diameter, spindle.body_offset});
    }
    if (spindle.body_radius > 0) body.steps.push_back({2 * spindle.body_radius, spindle.body_length});
    return body;
}

bool raise_to_holder_clearance(HeightField& map, const ToolBody& tool, const Pose& piece_in_setup,
                               double cells_per_radius) {
    if (tool.steps.empty()) return false;
    const double narrowest =
        std::min_element(tool.steps.begin(), tool.steps.end(), [](const HolderStep& a, const HolderStep& b) {
            return a.diameter < b.diameter;
        })->diameter;
    const double wanted = std::floor(0.5 * narrowest / cells_per_radius / map.cell);
    const auto factor = static_cast<std::size_t>(std::max(2.0, wanted));
    const HeightField wide = coarser(map, static_cast<double>(factor));
    HeightField limit = wide;
    std::fill(limit.height.begin(), limit.height.end(), HeightField::nothing);
    double above = tool.stick_out;
    for (const HolderStep& step : tool.steps) {
        dilate_to_disc(limit, wide, 0.5 * step.diameter, above);
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

}  // namespace qchopper
