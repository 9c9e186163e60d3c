// The highest surface under a disc is found row by row of the disc: each is a window of some width, and the largest
// value in a window is the larger of those in two windows of a power of two that cover it, which are doubled in place
// (H. Yuan and M. J. Atallah, "Data structures for range minimum queries in multidimensional arrays", 2010, have the
// same for rectangles). O(cells x rows of the disc), two further maps of the wider cells.

#include "cam/setup/holder_clearance.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

#include "base/parallel.h"

namespace qchopper {
namespace {

// Raises `limit` to the highest surface within a radius, less `drop`.
void dilate_to_disc(HeightField& limit, const HeightField& map, double radius, double drop) {
    const auto reach = static_cast<std::size_t>(radius / map.cell);
    // Rows of the disc by the largest power of two that fits into them.
    struct DiscRow {
        std::ptrdiff_t row;
        std::size_t half;  // cells on each side of the middle
    };
    std::vector<std::vector<DiscRow>> by_level(static_cast<std::size_t>(std::bit_width(2 * reach + 1)));
    for (std::ptrdiff_t row = -static_cast<std::ptrdiff_t>(reach); row <= static_cast<std::ptrdiff_t>(reach); ++row) {
        const double across = static_cast<double>(row) * map.cell;
        // The outermost row may lie beyond the radius by rounding.
        const double square = std::max(0.0, radius * radius - across * across);
        const auto half = static_cast<std::size_t>(std::sqrt(square) / map.cell);
        by_level[static_cast<std::size_t>(std::bit_width(2 * half + 1)) - 1].push_back({row, half});
    }
    // Highest surface in the 2^level cells from each one on; a border on both sides, so that windows may begin there.
    const std::size_t columns = map.columns + 2 * reach;
    std::vector<float> window(columns * map.rows, HeightField::nothing);
    for (std::size_t row = 0; row < map.rows; ++row) {
        std::copy_n(&map.height[row * map.columns], map.columns, &window[row * columns + reach]);
    }
    for (std::size_t level = 0; level < by_level.size(); ++level) {
        const std::size_t width = std::size_t{1} << level;
        parallel_for(0, map.rows, [&](std::size_t row) {
            float* own = &limit.height[row * map.columns];
            for (const DiscRow& part : by_level[level]) {
                const std::ptrdiff_t from = static_cast<std::ptrdiff_t>(row) + part.row;
                if (from < 0 || from >= static_cast<std::ptrdiff_t>(map.rows)) continue;
                const float* first = &window[static_cast<std::size_t>(from) * columns + reach - part.half];
                const float* last = first + (2 * part.half + 1 - width);
                for (std::size_t c = 0; c < map.columns; ++c) {
                    own[c] = std::max(own[c], std::max(first[c], last[c]) - static_cast<float>(drop));
                }
            }
        });
        parallel_for(0, map.rows, [&](std::size_t row) {
            float* own = &window[row * columns];
            for (std::size_t c = 0; c + width < columns; ++c) own[c] = std::max(own[c], own[c + width]);
        });
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
