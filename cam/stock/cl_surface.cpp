// Drop-cutter on a height field: dilation by the tool (K. Suresh and D. C. H. Yang, "Constant scallop-height machining
// of free-form surfaces", 1994, for the offset; J. Serra, "Image analysis and mathematical morphology", 1982, for the
// dilation). The tool is round, so the two rows at one distance from its axis share their terms: the larger of the two
// is taken first, and of two columns likewise. A chunk of a row is done at a time; rows and columns whose highest cell
// could not raise the lowest of the chunk are left out, which changes no result.
// O(cells * (radius / cell)^2 / 4) at most.

#include "cam/stock/cl_surface.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/error.h"
#include "base/parallel.h"
#include "segment/raster/disc_dilation.h"

namespace qchopper {
namespace {

constexpr std::size_t chunk = 64;        // cells of a row
constexpr std::size_t block = 32;        // cells of a row of which the highest is known
constexpr std::size_t rows_at_once = 8;  // of a map
constexpr double above_tool = 1e-3;      // mm, by which a tip that is not raised may seem to lie above its tool's

// A tool of any of the shapes, and the points within a distance of it.
struct RoundProfile {
    double radius = 0;
    double corner = 0;      // radius of the tip or of the rounded edge
    double half_angle = 0;  // of a cone; 0: the edge ends in the shank

    double height(double r) const {
        if (r > radius) return std::numeric_limits<double>::infinity();
        if (half_angle > 0) {
            const double tangent = corner * std::cos(half_angle);
            if (r > tangent) return corner * (1 - std::sin(half_angle)) + (r - tangent) / std::tan(half_angle);
            return corner - std::sqrt(corner * corner - r * r);
        }
        const double over = r - (radius - corner);
        return over <= 0 ? 0 : corner - std::sqrt(std::max(0.0, corner * corner - over * over));
    }
};

RoundProfile profile_of(const CuttingTool& tool, double allowance) {
    const double radius = 0.5 * tool.diameter + allowance;
    switch (tool.shape) {
        case ToolShape::cone:
        case ToolShape::drill:
            return {radius, tool.corner_radius + allowance, 0.5 * tool.tip_angle};
        case ToolShape::bull:
            return {radius, tool.corner_radius + allowance, 0};
        case ToolShape::flat:
            return {radius, allowance, 0};
        case ToolShape::ball:
            break;
    }
    return {radius, radius, 0};
}

// The distance of the nearest point of a cell, without a border of it, from the middle of one that lies so many cells
// beside.
double nearest(std::size_t columns, std::size_t rows, double cell, double border) {
    const auto past = [&](std::size_t n) { return n == 0 ? 0 : cell * (static_cast<double>(n) - 0.5) + border; };
    return std::hypot(past(columns), past(rows));
}

void check(const DilationOptions& options) {
    const auto check_length = [](double length, const std::string& name) {
        if (length >= 0 && std::isfinite(length)) return;
        throw InputError(InputFault::use, name + " is not a length from zero on", "give another value");
    };
    check_length(options.allowance, "allowance");
    check_length(options.border, "border of a cell");
}

}  // namespace

double tool_profile(const CuttingTool& tool, double r) {
    assert(r >= 0);
    return profile_of(tool, 0).height(r);
}

ToolDilation::ToolDilation(const HeightField& target, const CuttingTool& tool, const DilationOptions& options) {
    check(options);
    const RoundProfile profile = profile_of(tool, options.allowance);
    const double border = std::min(options.border, 0.5 * target.cell);
    tool_ = tool;
    allowance_ = options.allowance;
    inner_ = 0.5 * target.cell - border;
    const auto distance = [&](std::size_t column, std::size_t row) {
        return nearest(column, row, target.cell, border);
    };
    for (std::size_t row = 0; distance(0, row) <= profile.radius; ++row) {
        std::vector<float> drops;
        for (std::size_t column = 0; distance(column, row) <= profile.radius; ++column) {
            const double above = profile.height(distance(column, row));
            drops.push_back(static_cast<float>(options.allowance - above));
        }
        drop_.push_back(drops);
    }
    take(target);
}

ToolDilation ToolDilation::of_negative_cl_surface(const HeightField& negative_cl_surface, const CuttingTool& tool) {
    ToolDilation dilation;
    dilation.tool_ = tool;
    const RoundProfile profile = profile_of(tool, 0);
    const auto distance = [&](std::size_t columns, std::size_t rows) {
        return negative_cl_surface.cell * std::hypot(static_cast<double>(columns), static_cast<double>(rows));
    };
    for (std::size_t row = 0; distance(0, row) <= profile.radius; ++row) {
        std::vector<float> drops;
        for (std::size_t column = 0; distance(column, row) <= profile.radius; ++column) {
            drops.push_back(static_cast<float>(-profile.height(distance(column, row))));
        }
        dilation.drop_.push_back(drops);
    }
    dilation.take(negative_cl_surface);
    return dilation;
}

HeightField ToolDilation::bounds() const {
    const HeightField tiles = coarser(*target_, FieldTiles::side);
    // From the middle of a tile to a cell of it, to what the tool touches there, and to the middle of its tile.
    const double reach = static_cast<double>(drop_.size()) * target_->cell + std::numbers::sqrt2 * tiles.cell;
    HeightField bounds = dilate_by_disc(tiles, reach);
    for (float& z : bounds.height) z += static_cast<float>(allowance_);
    return bounds;
}

void ToolDilation::take(const HeightField& target) {
    target_ = &target;
    blocks_ = (target.columns + block - 1) / block;
    block_top_.resize(blocks_ * target.rows);
    parallel_for(0, target.rows, [&](std::size_t row) {
        const float* own = &target.height[row * target.columns];
        for (std::size_t b = 0; b < blocks_; ++b) {
            block_top_[row * blocks_ + b] =
                *std::max_element(own + b * block, own + std::min(target.columns, (b + 1) * block));
        }
    });
}

float ToolDilation::highest(std::size_t row, std::size_t first, std::size_t end) const {
    const float* tops = &block_top_[row * blocks_];
    return *std::max_element(tops + first / block, tops + (end - 1) / block + 1);
}

namespace {

// Of the first `count`; of all of them in lanes, which compilers turn into vectors.
float lowest_of(const std::array<float, chunk>& heights, std::size_t count) {
    if (count < chunk) {
        return *std::min_element(heights.begin(), heights.begin() + static_cast<std::ptrdiff_t>(count));
    }
    std::array<float, 8> lanes{};
    static_assert(chunk % lanes.size() == 0);
    std::copy_n(heights.begin(), lanes.size(), lanes.begin());
    for (std::size_t i = lanes.size(); i < chunk; i += lanes.size()) {
        for (std::size_t k = 0; k < lanes.size(); ++k) lanes[k] = std::min(lanes[k], heights[i + k]);
    }
    return *std::min_element(lanes.begin(), lanes.end());
}

}  // namespace

void ToolDilation::fill_chunk(std::size_t row, std::size_t first, std::size_t count, float* tip, float* pair) const {
    const HeightField& map = *target_;
    std::array<float, chunk> own;
    own.fill(HeightField::nothing);
    for (std::size_t dy = 0; dy < drop_.size(); ++dy) {
        const std::vector<float>& drops = drop_[dy];
        const std::size_t reach = drops.size() - 1;
        // The cells from which the chunk is reached, and of those the ones in the map.
        const std::size_t from = first > reach ? first - reach : 0;
        const std::size_t end = std::min(map.columns, first + count + reach);
        const bool has_below = row >= dy;
        const bool has_above = row + dy < map.rows;
        if (!has_below && !has_above) break;
        float top = has_below ? highest(row - dy, from, end) : HeightField::nothing;
        if (has_above) top = std::max(top, highest(row + dy, from, end));
        const float lowest = lowest_of(own, count);
        if (top + drops[0] <= lowest) continue;
        std::fill_n(pair, chunk + 2 * reach, HeightField::nothing);
        float* in_map = pair + (from + reach - first);
        const float* below = &map.height[(has_below ? row - dy : row + dy) * map.columns];
        const float* above = &map.height[(has_above ? row + dy : row - dy) * map.columns];
        for (std::size_t c = from; c < end; ++c) in_map[c - from] = std::max(below[c], above[c]);
        for (std::size_t dx = 0; dx <= reach && top + drops[dx] > lowest; ++dx) {
            const float* left = pair + (reach - dx);
            const float* right = pair + (reach + dx);
            const float drop = drops[dx];
            for (std::size_t c = 0; c < chunk; ++c) own[c] = std::max(own[c], std::max(left[c], right[c]) + drop);
        }
    }
    std::copy_n(own.begin(), count, tip);
}

void ToolDilation::fill(std::size_t row, std::size_t first, std::size_t end, float* tip) const {
    assert(row < target_->rows && end <= target_->columns);
    std::vector<float> pair(chunk + 2 * drop_[0].size());
    for (std::size_t c = first; c < end; c += chunk) {
        fill_chunk(row, c, std::min(chunk, end - c), tip + (c - first), pair.data());
    }
}

namespace {

// The cells of a line of cells that lie within `past` of an interval.
CellSpan cells_near(double low, double high, double past, double cell, std::size_t count) {
    const auto first = static_cast<std::size_t>(std::max(0.0, std::floor((low - past) / cell)));
    const double end = std::max(0.0, std::floor((high + past) / cell) + 1);
    return {first, std::min(count, static_cast<std::size_t>(end))};
}

// How far a cell of that line, `inner` to both sides of its middle, lies beside an interval.
double beside(double low, double high, double cell, std::size_t index, double inner) {
    const double middle = cell * (static_cast<double>(index) + 0.5);
    return std::max({0.0, low - middle - inner, middle - high - inner});
}

}  // namespace

double ToolDilation::height(double x, double y, const Bounds& asked) const {
    const HeightField& map = *target_;
    const RoundProfile profile = profile_of(tool_, allowance_);
    const double past = profile.radius + inner_;
    double least = asked.low;
    const CellSpan columns = cells_near(x, x, past, map.cell, map.columns);
    const CellSpan rows = cells_near(y, y, past, map.cell, map.rows);
    if (columns.first >= columns.end || rows.first >= rows.end) return least;
    const auto take_row = [&](std::size_t row) {
        const double v = beside(y, y, map.cell, row, inner_);
        const double top = static_cast<double>(highest(row, columns.first, columns.end)) + allowance_;
        if (top - profile.height(v) <= least) return;
        const float* own = &map.height[row * map.columns];
        for (std::size_t column = columns.first; column < columns.end; ++column) {
            const double high = static_cast<double>(own[column]) + allowance_;
            if (high <= least) continue;
            const double u = beside(x, x, map.cell, column, inner_);
            least = std::max(least, high - profile.height(std::sqrt(u * u + v * v)));
        }
    };
    // From the middle outwards, so that more of the rows are too low.
    const std::size_t middle = std::clamp(static_cast<std::size_t>(std::max(0.0, y / map.cell)), rows.first, rows.end);
    for (std::size_t row = middle; row < rows.end && least < asked.high; ++row) take_row(row);
    for (std::size_t row = middle; row > rows.first && least < asked.high; --row) take_row(row - 1);
    return least;
}

void ToolDilation::heights_along(std::span<const Point2> places, const Bounds& asked, std::span<float> heights) const {
    assert(heights.size() == places.size());
    struct Raising {
        std::size_t column = 0;
        std::size_t row = 0;
        double high = 0;
    };
    const HeightField& map = *target_;
    const RoundProfile profile = profile_of(tool_, allowance_);
    const double past = profile.radius + inner_;
    Rectangle2 box;
    for (const Point2& place : places) box.include(place);
    const CellSpan columns = cells_near(box.min.x, box.max.x, past, map.cell, map.columns);
    const CellSpan rows = cells_near(box.min.y, box.max.y, past, map.cell, map.rows);
    std::vector<Raising> raising;
    for (std::size_t row = rows.first; row < rows.end && columns.first < columns.end; ++row) {
        const double v = beside(box.min.y, box.max.y, map.cell, row, inner_);
        const double top = static_cast<double>(highest(row, columns.first, columns.end)) + allowance_;
        if (top - profile.height(v) <= asked.low) continue;
        for (std::size_t column = columns.first; column < columns.end; ++column) {
            const double high = static_cast<double>(map.at(column, row)) + allowance_;
            if (high <= asked.low) continue;
            const double u = beside(box.min.x, box.max.x, map.cell, column, inner_);
            if (high - profile.height(std::sqrt(u * u + v * v)) > asked.low) raising.push_back({column, row, high});
        }
    }
    auto least = static_cast<float>(asked.low);
    for (std::size_t i = 0; i < places.size(); ++i) {
        if (static_cast<double>(least) < asked.high) {
            double height = static_cast<double>(least);
            for (const Raising& cell : raising) {
                const double u = beside(places[i].x, places[i].x, map.cell, cell.column, inner_);
                const double v = beside(places[i].y, places[i].y, map.cell, cell.row, inner_);
                height = std::max(height, cell.high - profile.height(std::sqrt(u * u + v * v)));
            }
            least = static_cast<float>(height);
        }
        heights[i] = least;
    }
}

namespace {

HeightField filled(const HeightField& map, const ToolDilation& dilation) {
    HeightField result = map;
    parallel_ranges(0, map.rows, rows_at_once, [&](std::size_t first, std::size_t end) {
        for (std::size_t row = first; row < end; ++row) {
            dilation.fill(row, 0, map.columns, &result.height[row * map.columns]);
        }
    });
    return result;
}

// In tiles; the rest stays.
void fill_tiles(HeightField& map, const ToolDilation& dilation, const FieldTiles& tiles) {
    parallel_ranges(0, map.rows, rows_at_once, [&](std::size_t first, std::size_t end) {
        for (std::size_t row = first; row < end; ++row) {
            for (const CellSpan& span : tiles.spans(row)) {
                dilation.fill(row, span.first, span.end, &map.height[row * map.columns + span.first]);
            }
        }
    });
}

}  // namespace

double edge_rise(double radius, double cell) {
    return std::sqrt(radius * cell);
}

bool is_of_tool(const HeightField& tip, const ToolDilation& tool, std::size_t cell) {
    const std::size_t row = cell / tip.columns;
    const std::size_t column = cell % tip.columns;
    const double x = tip.cell * (static_cast<double>(column) + 0.5);
    const double y = tip.cell * (static_cast<double>(row) + 0.5);
    const double least = static_cast<double>(tip.height[cell]) - above_tool;
    return tool.height(x, y, {least - above_tool, least}) >= least;
}

HeightField cl_surface(const HeightField& target, const CuttingTool& tool, const DilationOptions& options) {
    return filled(target, ToolDilation(target, tool, options));
}

HeightField cl_surface(const ToolDilation& tool, const FieldTiles& tiles) {
    const HeightField bounds = tool.bounds();
    HeightField tip = tool.target();
    parallel_for(0, tip.rows, [&](std::size_t row) {
        const float* bound = &bounds.height[row / FieldTiles::side * bounds.columns];
        float* own = &tip.height[row * tip.columns];
        for (std::size_t column = 0; column < tip.columns; ++column) own[column] = bound[column / FieldTiles::side];
    });
    fill_tiles(tip, tool, tiles);
    return tip;
}

HeightField remaining_surface(const HeightField& tip, const CuttingTool& tool, const FieldTiles& tiles) {
    HeightField negative = tip;
    for (float& z : negative.height) z = -z;
    HeightField remaining = tip;
    std::fill(remaining.height.begin(), remaining.height.end(), HeightField::nothing);
    fill_tiles(remaining, ToolDilation::of_negative_cl_surface(negative, tool), tiles);
    for (float& z : remaining.height) z = -z;
    return remaining;
}

HeightField remaining_surface(const HeightField& tip, const CuttingTool& tool) {
    HeightField negative = tip;
    for (float& z : negative.height) z = -z;
    HeightField remaining = filled(negative, ToolDilation::of_negative_cl_surface(negative, tool));
    for (float& z : remaining.height) z = -z;
    return remaining;
}

}  // namespace qchopper
