// A ray goes down through each cell in steps of a cell. Between two steps and within the cell every point of foam lies
// within less than a cell of a step, seen from any direction: so each step is compared with the highest of 3 x 3 cells
// of every other direction's map and one cell above it, and the answer is the step before. Along its own direction the
// map of that direction tells where the ray begins, exactly. Above the highest cell of a square of another direction's
// map all steps are over at once. O(cells * steps * directions) at most.
//
// A tool that moves along a line comes lowest over a cell where the derivative of its height vanishes: on a level line
// where it is nearest, and a ball of radius R on a slope m beside that, by m * sqrt((R^2 - d^2) / (1 + m^2)) for a cell
// d off the line. With the radius less what lies beside a cell that is not exactly the lowest place, but it is one
// where the tool has been. Other tools on slopes are taken at places a cell apart. O(cells passed).

#include "cam/stock/in_process_stock.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

#include "base/box.h"
#include "base/parallel.h"
#include "cam/stock/cl_surface.h"
#include "segment/raster/cells_under.h"
#include "segment/raster/disc_dilation.h"

namespace qchopper {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr std::size_t sweep_rings = 1024;                    // of equal area under the tool
constexpr double half_diagonal = 0.5 * std::numbers::sqrt2;  // of a cell
constexpr std::size_t cells_at_once = 64;                    // of a row
constexpr double min_way = 1e-6;                             // mm across; a shorter line goes straight down
constexpr double min_sine = 1e-9;                            // of the angle of a line and a row
constexpr double square = 16;                                // cells of a map of which the highest is known

// Where a line enters and leaves a box: from the higher parameter to the lower.
struct Span {
    double high = infinite;
    double low = -infinite;
    bool is_empty() const { return !(high > low); }
};

Span span_in(const Box& box, Vec3 point, Vec3 along) {
    Span span;
    for (int i = 0; i < 3; ++i) {
        if (std::abs(along[i]) < 1e-12) {
            if (point[i] < box.min[i] || point[i] > box.max[i]) return {0, 0};
            continue;
        }
        const double a = (box.min[i] - point[i]) / along[i];
        const double b = (box.max[i] - point[i]) / along[i];
        span.high = std::min(span.high, std::max(a, b));
        span.low = std::max(span.low, std::min(a, b));
    }
    return span;
}

// Where a tool on a line comes lowest over cells of a row, in single precision and without branches, so that several
// are computed at once. Coordinates are relative to the beginning of the line.
struct LowestPlaces {
    std::array<float, cells_at_once> rise;         // of the tip there
    std::array<std::int32_t, cells_at_once> ring;  // of the tool, over the cell; sweep_rings: it is not over the cell

    LowestPlaces(Vec3 along, double end, double slope, double cell, double outer)
        : along_x_(static_cast<float>(along.x)),
          along_y_(static_cast<float>(along.y)),
          end_(static_cast<float>(end)),
          slope_(static_cast<float>(slope)),
          lag_(static_cast<float>(-slope / std::sqrt(1 + slope * slope))),
          cell_(static_cast<float>(cell)),
          square_(static_cast<float>(outer * outer)),
          rings_per_square_(static_cast<float>(static_cast<double>(sweep_rings) / (outer * outer))) {}

    // Of cells from a place on.
    void find(float first_x, float y, std::size_t count) {
        // Rounding must not find a place nearer than it is.
        constexpr float rounding = 0.05F;  // rings
        constexpr auto most = static_cast<float>(sweep_rings);
        // Values that the arrays do not share memory with: else the compiler computes one cell after the other.
        const float along_x = along_x_;
        const float along_y = along_y_;
        const float end = end_;
        const float slope = slope_;
        const float cell = cell_;
        const float rings_per_square = rings_per_square_;
        const auto cells = static_cast<std::int32_t>(count);
        std::array<float, cells_at_once> lag{};
        if (slope != 0) {
            for (std::int32_t k = 0; k < cells; ++k) {
                const float across = y * along_x - (first_x + cell * static_cast<float>(k)) * along_y;
                lag[static_cast<std::size_t>(k)] = lag_ * std::sqrt(std::max(0.0F, square_ - across * across));
            }
        }
        for (std::int32_t k = 0; k < cells; ++k) {
            const auto i = static_cast<std::size_t>(k);
            const float x = first_x + cell * static_cast<float>(k);
            const float at = x * along_x + y * along_y;
            const float across = y * along_x - x * along_y;
            const float behind = at + lag[i];
            const float from_first = behind > 0 ? behind : 0;
            const float tip = from_first < end ? from_first : end;
            const float rings = (across * across + (at - tip) * (at - tip)) * rings_per_square + rounding;
            ring[i] = static_cast<std::int32_t>(rings < most ? rings : most);
            rise[i] = slope * tip;
        }
    }

 private:
    float along_x_, along_y_, end_, slope_;
    float lag_;  // behind the nearest place, per half chord
    float cell_;
    float square_;  // of the outer radius
    float rings_per_square_;
};

// Whether a point of a map's frame lies above the map.
bool is_above(const HeightField& map, Vec3 p) {
    const std::optional<std::size_t> cell = map.cell_under(p.x, p.y);
    return cell && p.z > static_cast<double>(map.height[*cell]);
}

// What another direction removed, raised so that a sample speaks for all that is less than a cell away.
class Raised {
 public:
    // `ray_in_map`: from the map that is asked for.
    Raised(HeightField down_to, const Pose& ray_in_map)
        : down_to_(std::move(down_to)), ray_in_map_(ray_in_map), squares_(coarser(down_to_, square)) {}

    // How many points from this one on, `step` apart along the ray, are surely removed: 0 if this one is not.
    std::size_t removed_from(Vec3 on_ray, double step) const {
        const Vec3 p = apply(ray_in_map_, on_ray);
        if (!is_above(down_to_, p)) return 0;
        const double wide = squares_.cell;
        const double column = std::floor(p.x / wide);
        const double row = std::floor(p.y / wide);
        const float top = squares_.at(static_cast<std::size_t>(column), static_cast<std::size_t>(row));
        // A little inside, so that rounding puts no point beside the square.
        const Vec3 along = rotate(ray_in_map_, {0, 0, step});
        const double inside = 1e-6;
        double steps = steps_within(p.z, static_cast<double>(top) + inside, infinite, along.z);
        const double columns_end = std::min((column + 1) * wide, static_cast<double>(down_to_.columns) * down_to_.cell);
        const double rows_end = std::min((row + 1) * wide, static_cast<double>(down_to_.rows) * down_to_.cell);
        steps = std::min(steps, steps_within(p.x, column * wide + inside, columns_end - inside, along.x));
        steps = std::min(steps, steps_within(p.y, row * wide + inside, rows_end - inside, along.y));
        return 1 + static_cast<std::size_t>(std::clamp(steps, 0.0, max_steps));
    }

 private:
    static constexpr double max_steps = 1e6;

    // How often `step` may be added so that it stays between two values; negative if it is not there now.
    static double steps_within(double at, double low, double high, double step) {
        if (!(at > low && at < high)) return -1;
        if (step == 0) return infinite;
        return std::floor((step > 0 ? high - at : low - at) / step);
    }

    HeightField down_to_;
    Pose ray_in_map_;
    HeightField squares_;  // the highest of each
};

class Rays {
 public:
    // The block counts as larger by `more_cells`.
    Rays(const Setup& setup, const HeightField& frame, std::vector<Raised> others, double more_cells)
        : others_(std::move(others)) {
        const Pose map_in_setup = setup.piece_in_setup * inverse(frame.piece_in_field);
        setup_in_map_ = map_in_setup;
        tool_axis_ = rotate(map_in_setup, {0, 0, 1});
        const double across = std::hypot(tool_axis_.x, tool_axis_.y);
        box_ = setup.block_box();
        const Vec3 more = more_cells * frame.cell * Vec3{1, 1, across};
        box_.min = box_.min - more;
        box_.max = box_.max + more;
    }

    // The highest foam over a cell whose own direction removed all above `top`.
    float highest(double x, double y, double top, double step) const {
        const Span span = span_in(box_, apply(setup_in_map_, {x, y, 0}), tool_axis_);
        if (span.is_empty()) return HeightField::nothing;
        const double begin = std::min(span.high, top);
        const double z = first_left({x, y, begin}, -step, begin - span.low);
        return z == infinite ? HeightField::nothing : static_cast<float>(std::min(begin, z + step));
    }

    // The lowest one.
    float lowest(double x, double y, double top, double step) const {
        const Span span = span_in(box_, apply(setup_in_map_, {x, y, 0}), tool_axis_);
        if (span.is_empty()) return HeightField::nothing;
        const double z = first_left({x, y, span.low}, step, std::min(span.high, top) - span.low);
        return z == infinite ? HeightField::nothing : static_cast<float>(std::max(span.low, z - step));
    }

 private:
    // The height of the first point of a ray, in steps, that is not removed; infinite if all are to a distance.
    double first_left(Vec3 from, double step, double far) const {
        std::size_t last = 0;  // what removed the step before is asked first
        for (std::size_t k = 0; static_cast<double>(k) * std::abs(step) < far;) {
            const double z = from.z + static_cast<double>(k) * step;
            const std::size_t removed = removed_from({from.x, from.y, z}, step, last);
            if (removed == 0) return z;
            k += removed;
        }
        return infinite;
    }

    std::size_t removed_from(Vec3 in_map, double step, std::size_t& last) const {
        for (std::size_t k = 0; k < others_.size(); ++k) {
            const std::size_t i = last + k < others_.size() ? last + k : last + k - others_.size();
            const std::size_t removed = others_[i].removed_from(in_map, step);
            if (removed == 0) continue;
            last = i;
            return removed;
        }
        return 0;
    }

    std::vector<Raised> others_;
    Pose setup_in_map_;  // takes map coordinates to those of the setup
    Vec3 tool_axis_;
    Box box_;
};

}  // namespace

ToolSweep::ToolSweep(const CuttingTool& tool, double cell, double slack, StockCells kind)
    : cell_(cell), above_(sweep_rings, 0) {
    const double beside = slack + (kind == StockCells::whole ? half_diagonal * cell : 0);
    outer_ = 0.5 * tool.diameter - beside;
    is_ball_ = tool.shape == ToolShape::ball;
    for (std::size_t i = 0; i < sweep_rings && outer_ > 0; ++i) {
        const double r = outer_ * std::sqrt(static_cast<double>(i + 1) / static_cast<double>(sweep_rings));
        above_[i] = static_cast<float>(tool_profile(tool, std::min(r + beside, 0.5 * tool.diameter)) + slack);
    }
}

double ToolSweep::move(HeightField& map, HeightField& other, Vec3 from, Vec3 to) const {
    assert(map.cell == cell_ && other.height.size() == map.height.size());
    if (!(outer_ > 0)) return 0;
    if (is_ball_ || from.z == to.z) return sweep(map, other, from, to);
    const double length = std::hypot(to.x - from.x, to.y - from.y);
    const auto parts = static_cast<std::size_t>(std::ceil(length / cell_)) + 1;
    double lowered = 0;
    for (std::size_t i = 0; i <= parts; ++i) {
        const Vec3 tip = from + (static_cast<double>(i) / static_cast<double>(parts)) * (to - from);
        lowered += sweep(map, other, tip, tip);
    }
    return lowered;
}

double ToolSweep::sweep(HeightField& map, HeightField& other, Vec3 from, Vec3 to) const {
    const double length = std::hypot(to.x - from.x, to.y - from.y);
    const bool is_point = !(length > min_way);
    if (is_point) from = to = {to.x, to.y, std::min(from.z, to.z)};
    const Vec3 along = is_point ? Vec3{1, 0, 0} : Vec3{(to.x - from.x) / length, (to.y - from.y) / length, 0};
    const double end = is_point ? 0 : length;
    const double slope = is_point ? 0 : (to.z - from.z) / length;
    double lowered = 0;  // mm
    LowestPlaces places(along, end, slope, cell_, outer_);
    const auto base = static_cast<float>(from.z);
    const CellSpan rows =
        centres_within((std::min(from.y, to.y) - outer_) / cell_, (std::max(from.y, to.y) + outer_) / cell_, map.rows);
    for (std::size_t row = rows.first; row < rows.end; ++row) {
        const double y = cell_ * (static_cast<double>(row) + 0.5) - from.y;
        double low = std::min(from.x, to.x) - outer_;
        double high = std::max(from.x, to.x) + outer_;
        if (std::abs(along.y) > min_sine) {
            // The columns that are near to the line in this row.
            const double middle = from.x + y * along.x / along.y;
            low = std::max(low, middle - outer_ / std::abs(along.y));
            high = std::min(high, middle + outer_ / std::abs(along.y));
        }
        const CellSpan columns = centres_within(low / cell_, high / cell_, map.columns);
        float* own = map.height.data() + row * map.columns;
        float* others = other.height.data() + row * map.columns;
        for (std::size_t first = columns.first; first < columns.end; first += cells_at_once) {
            const std::size_t count = std::min(cells_at_once, columns.end - first);
            const double x = cell_ * (static_cast<double>(first) + 0.5) - from.x;
            places.find(static_cast<float>(x), static_cast<float>(y), count);
            for (std::size_t k = 0; k < count; ++k) {
                const auto ring = static_cast<std::size_t>(places.ring[k]);
                if (ring >= sweep_rings) continue;
                const float height = base + places.rise[k] + above_[ring];
                if (height < own[first + k]) {
                    lowered += static_cast<double>(own[first + k] - height);
                    own[first + k] = height;
                }
                others[first + k] = std::min(others[first + k], height);
            }
        }
    }
    return lowered * cell_ * cell_;
}

InProcessStock::InProcessStock(const Setup& setup, StockCells kind) : setup_(&setup), kind_(kind) {}

template <class Height>
HeightField InProcessStock::mapped(std::size_t orientation, const HeightField& frame, const Height& height_of) const {
    std::vector<Raised> others;
    const HeightField* own = nullptr;
    for (const Removed& removed : removed_) {
        if (removed.orientation == orientation) {
            own = &removed.down_to;
            continue;
        }
        assert(removed.down_to.cell == frame.cell);
        HeightField raised = removed.down_to;
        if (kind_ == StockCells::whole) {
            raised = dilate_by_disc(raised, std::numbers::sqrt2 * (frame.cell + 1e-6));
            for (float& height : raised.height) height += static_cast<float>(frame.cell);
        }
        others.emplace_back(std::move(raised), removed.down_to.piece_in_field * inverse(frame.piece_in_field));
    }
    assert(own == nullptr || own->height.size() == frame.height.size());
    const Rays rays(*setup_, frame, std::move(others), kind_ == StockCells::whole ? 1 : 0);
    HeightField result = frame;
    parallel_for(0, frame.rows, [&](std::size_t row) {
        for (std::size_t column = 0; column < frame.columns; ++column) {
            const double x = frame.cell * (static_cast<double>(column) + 0.5);
            const double y = frame.cell * (static_cast<double>(row) + 0.5);
            const double top = own != nullptr ? static_cast<double>(own->at(column, row)) : infinite;
            result.height[row * frame.columns + column] = height_of(rays, x, y, top);
        }
    });
    return result;
}

HeightField InProcessStock::highest(std::size_t orientation, const HeightField& frame) const {
    return mapped(orientation, frame, [&](const Rays& rays, double x, double y, double top) {
        return rays.highest(x, y, top, frame.cell);
    });
}

HeightField InProcessStock::lowest(std::size_t orientation, const HeightField& frame) const {
    return mapped(orientation, frame,
                  [&](const Rays& rays, double x, double y, double top) { return rays.lowest(x, y, top, frame.cell); });
}

void InProcessStock::remove_above(std::size_t orientation, const HeightField& map) {
    for (Removed& removed : removed_) {
        if (removed.orientation != orientation) continue;
        assert(removed.down_to.height.size() == map.height.size());
        for (std::size_t i = 0; i < map.height.size(); ++i) {
            removed.down_to.height[i] = std::min(removed.down_to.height[i], map.height[i]);
        }
        return;
    }
    removed_.push_back({orientation, map});
}

bool InProcessStock::may_be_stock(Vec3 point) const {
    const Box block = setup_->block_box();
    for (int i = 0; i < 3; ++i) {
        if (point[i] < block.min[i] || point[i] > block.max[i]) return false;
    }
    return std::none_of(removed_.begin(), removed_.end(), [&](const Removed& removed) {
        return is_above(removed.down_to, setup_to_field(*setup_, removed.down_to, point));
    });
}

}  // namespace qchopper
