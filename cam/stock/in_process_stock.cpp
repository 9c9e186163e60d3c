// A ray goes down through each cell in steps of a cell. Between two steps and within the cell every point of foam lies
// within less than a cell of a step, seen from any direction: so each step is compared with the highest of 3 x 3 cells
// of every other direction's map and one cell above it, and the answer is the step before. Along its own direction the
// map of that direction tells where the ray begins, exactly. Above the highest cell of a square of another direction's
// map all steps are over at once. O(cells * steps * directions) at most. Foam only gets less: the next time a ray
// begins at the step at which it has met foam, with the same result (tests/cam/stock/in_process_stock_test.cpp,
// RaysGoOnWhereTheyMetFoam).
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
#include <numeric>
#include <optional>

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
constexpr std::array<std::size_t, 2> squares{64, 16};        // cells of a map, each way, of which the highest is known
// Of Seen: the ray has met no foam at all; nothing is known of it. Longer rays are asked from below these on.
constexpr std::uint16_t no_foam = std::numeric_limits<std::uint16_t>::max();
constexpr std::uint16_t unknown = no_foam - 1;

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

namespace {

// What another direction removed, for rays that go a step at a time.
class RemovedByOther {
 public:
    // `ray_in_map`: from the map that is asked for, along whose z a step goes.
    RemovedByOther(const HeightField& down_to, const std::vector<HeightField>& tops, const Pose& ray_in_map,
                   double step)
        : down_to_(&down_to), tops_(&tops), ray_in_map_(ray_in_map), per_cell_(1 / down_to.cell) {
        const Vec3 along = rotate(ray_in_map, {0, 0, step});
        along_ = {along.x * per_cell_, along.y * per_cell_, along.z};
        inverse_ = {1 / std::abs(along_.x), 1 / std::abs(along_.y), 1 / std::abs(along_.z)};
    }

    // How many points of the ray from this one on are surely removed: 0 if this one is not.
    std::size_t removed_from(Vec3 on_ray) const {
        const Vec3 p = apply(ray_in_map_, on_ray);
        const double column = p.x * per_cell_;
        const double row = p.y * per_cell_;
        const std::optional<std::size_t> cell = down_to_->cell_holding(column, row);
        if (!cell || !(p.z > static_cast<double>(down_to_->height[*cell]))) return 0;
        for (std::size_t k = 0; k < squares.size(); ++k) {
            const std::size_t wide = squares[k];
            const std::size_t c = static_cast<std::size_t>(column) / wide;
            const std::size_t r = static_cast<std::size_t>(row) / wide;
            const double above = p.z - static_cast<double>((*tops_)[k].at(c, r)) - inside;
            if (!(above > 0)) continue;
            double steps = along_.z < 0 ? above * inverse_.z : infinite;
            steps = std::min(
                steps, steps_in(column, c * wide, std::min((c + 1) * wide, down_to_->columns), along_.x, inverse_.x));
            steps = std::min(steps,
                             steps_in(row, r * wide, std::min((r + 1) * wide, down_to_->rows), along_.y, inverse_.y));
            return 1 + static_cast<std::size_t>(std::clamp(steps, 0.0, max_steps));
        }
        return 1;
    }

 private:
    static constexpr double max_steps = 1e6;
    static constexpr double inside = 1e-6;  // so that rounding puts no point beside a square

    // How often a step may be added so that it stays between two cells. Without a step: always, as the smaller of a
    // number and of what is not one is the number.
    static double steps_in(double at, std::size_t low, std::size_t high, double step, double inverse) {
        return ((step > 0 ? static_cast<double>(high) - at : at - static_cast<double>(low)) - inside) * inverse;
    }

    const HeightField* down_to_;
    const std::vector<HeightField>* tops_;  // the highest of the squares of each size
    Pose ray_in_map_;
    double per_cell_;
    Vec3 along_;  // of a step; x and y in cells
    Vec3 inverse_;
};

}  // namespace

// The rays of the cells of a map, in its coordinates.
class InProcessStock::Rays {
 public:
    // The block counts as larger by `more_cells`. `own`: down to where the direction itself has removed all; may be
    // null.
    Rays(const Setup& setup, const HeightField& frame, const HeightField* own, std::vector<RemovedByOther> others,
         double more_cells)
        : own_(own), others_(std::move(others)), cell_(frame.cell), columns_(frame.columns) {
        const Pose map_in_setup = setup.piece_in_setup * inverse(frame.piece_in_field);
        setup_in_map_ = map_in_setup;
        tool_axis_ = rotate(map_in_setup, {0, 0, 1});
        const double across = std::hypot(tool_axis_.x, tool_axis_.y);
        box_ = setup.block_box();
        const Vec3 more = more_cells * frame.cell * Vec3{1, 1, across};
        box_.min = box_.min - more;
        box_.max = box_.max + more;
    }

    // The highest foam over a cell. `steps`: as in Seen; `is_current`: whether it holds for what is removed now.
    float highest(std::size_t cell, std::uint16_t& steps, bool is_current) const {
        if (steps == no_foam) return HeightField::nothing;
        const Vec3 middle = middle_of(cell);
        const Span span = span_of(middle);
        if (span.is_empty()) return none(steps);
        const double begin = std::min(span.high, top_of(cell));
        const bool is_known = steps != unknown;
        const std::size_t first = is_known ? steps : 0;
        const std::optional<std::size_t> left =
            is_known && is_current ? first : first_left({middle.x, middle.y, begin}, -cell_, begin - span.low, first);
        if (!left) return none(steps);
        steps = static_cast<std::uint16_t>(std::min<std::size_t>(*left, unknown - 1));
        const double z = begin - static_cast<double>(*left) * cell_;
        return static_cast<float>(std::min(begin, z + cell_));
    }

    // The lowest one.
    float lowest(std::size_t cell) const {
        const Vec3 middle = middle_of(cell);
        const Span span = span_of(middle);
        if (span.is_empty()) return HeightField::nothing;
        const double far = std::min(span.high, top_of(cell)) - span.low;
        const std::optional<std::size_t> left = first_left({middle.x, middle.y, span.low}, cell_, far, 0);
        if (!left) return HeightField::nothing;
        const double z = span.low + static_cast<double>(*left) * cell_;
        return static_cast<float>(std::max(span.low, z - cell_));
    }

 private:
    static float none(std::uint16_t& steps) {
        steps = no_foam;
        return HeightField::nothing;
    }
    Vec3 middle_of(std::size_t cell) const {
        const std::size_t row = cell / columns_;
        return {cell_ * (static_cast<double>(cell % columns_) + 0.5), cell_ * (static_cast<double>(row) + 0.5), 0};
    }
    Span span_of(Vec3 middle) const { return span_in(box_, apply(setup_in_map_, middle), tool_axis_); }
    double top_of(std::size_t cell) const {
        return own_ != nullptr ? static_cast<double>(own_->height[cell]) : infinite;
    }

    // The first point of a ray, in steps from its beginning, that is not removed; none if all are to a distance. The
    // points before `first` are removed.
    std::optional<std::size_t> first_left(Vec3 from, double step, double far, std::size_t first) const {
        std::size_t last = 0;  // what removed the step before is asked first
        for (std::size_t k = first; static_cast<double>(k) * std::abs(step) < far;) {
            const double z = from.z + static_cast<double>(k) * step;
            const std::size_t removed = removed_from({from.x, from.y, z}, last);
            if (removed == 0) return k;
            k += removed;
        }
        return std::nullopt;
    }

    std::size_t removed_from(Vec3 in_map, std::size_t& last) const {
        for (std::size_t k = 0; k < others_.size(); ++k) {
            const std::size_t i = last + k < others_.size() ? last + k : last + k - others_.size();
            const std::size_t removed = others_[i].removed_from(in_map);
            if (removed == 0) continue;
            last = i;
            return removed;
        }
        return 0;
    }

    const HeightField* own_;
    std::vector<RemovedByOther> others_;
    double cell_;
    std::size_t columns_;
    Pose setup_in_map_;  // takes map coordinates to those of the setup
    Vec3 tool_axis_;
    Box box_;
};

InProcessStock::InProcessStock(const Setup& setup, StockCells kind)
    : setup_(&setup),
      kind_(kind),
      seen_(setup.access.orientations.size()),
      removals_(setup.access.orientations.size(), 0) {}

const InProcessStock::Removed* InProcessStock::removed_along(std::size_t orientation) const {
    const auto found = std::ranges::find(removed_, orientation, &Removed::orientation);
    return found != removed_.end() ? &*found : nullptr;
}

InProcessStock::Rays InProcessStock::rays_along(std::size_t orientation, const HeightField& frame, double step) {
    std::vector<RemovedByOther> others;
    for (Removed& removed : removed_) {
        if (removed.orientation == orientation) continue;
        assert(removed.down_to.cell == frame.cell);
        const bool is_whole = kind_ == StockCells::whole;
        if (removed.tops.empty()) {
            if (is_whole) {
                removed.raised = dilate_by_disc(removed.down_to, std::numbers::sqrt2 * (frame.cell + 1e-6));
                for (float& height : removed.raised.height) height += static_cast<float>(frame.cell);
            }
            for (const std::size_t wide : squares) {
                const HeightField& map = is_whole ? removed.raised : removed.down_to;
                removed.tops.push_back(coarser(map, static_cast<double>(wide)));
            }
        }
        others.emplace_back(is_whole ? removed.raised : removed.down_to, removed.tops,
                            removed.down_to.piece_in_field * inverse(frame.piece_in_field), step);
    }
    const Removed* own = removed_along(orientation);
    assert(own == nullptr || own->down_to.height.size() == frame.height.size());
    return {*setup_, frame, own != nullptr ? &own->down_to : nullptr, std::move(others),
            kind_ == StockCells::whole ? 1.0 : 0.0};
}

InProcessStock::Seen& InProcessStock::seen_along(std::size_t orientation, std::size_t cells) {
    Seen& seen = seen_[orientation];
    if (seen.steps.size() != cells) seen.steps.assign(cells, unknown);
    return seen;
}

HeightField InProcessStock::highest(std::size_t orientation, const HeightField& frame) {
    const Rays rays = rays_along(orientation, frame, -frame.cell);
    Seen& seen = seen_along(orientation, frame.height.size());
    const std::size_t by_others =
        std::accumulate(removals_.begin(), removals_.end(), std::size_t{0}) - removals_[orientation];
    const bool is_current = seen.removals == by_others;
    HeightField result = frame;
    parallel_for(0, frame.rows, [&](std::size_t row) {
        for (std::size_t i = row * frame.columns; i < (row + 1) * frame.columns; ++i) {
            result.height[i] = rays.highest(i, seen.steps[i], is_current);
        }
    });
    seen.removals = by_others;
    return result;
}

HeightField InProcessStock::lowest(std::size_t orientation, const HeightField& frame) {
    const Rays rays = rays_along(orientation, frame, frame.cell);
    HeightField result = frame;
    parallel_for(0, frame.rows, [&](std::size_t row) {
        for (std::size_t i = row * frame.columns; i < (row + 1) * frame.columns; ++i) {
            result.height[i] = rays.lowest(i);
        }
    });
    return result;
}

void InProcessStock::remove_above(std::size_t orientation, const HeightField& map) {
    Seen& seen = seen_along(orientation, map.height.size());
    ++removals_[orientation];
    auto found = std::ranges::find(removed_, orientation, &Removed::orientation);
    if (found == removed_.end()) {
        removed_.push_back({orientation, map, {}, {}});
        found = removed_.end() - 1;
        std::fill(found->down_to.height.begin(), found->down_to.height.end(), std::numeric_limits<float>::infinity());
    }
    found->raised = {};
    found->tops.clear();
    std::vector<float>& down_to = found->down_to.height;
    assert(down_to.size() == map.height.size());
    for (std::size_t i = 0; i < down_to.size(); ++i) {
        if (!(map.height[i] < down_to[i])) continue;
        down_to[i] = map.height[i];
        // Its ray begins elsewhere from now on.
        if (seen.steps[i] != no_foam) seen.steps[i] = unknown;
    }
}

std::vector<RemovedFoam> InProcessStock::removed(double factor) const {
    std::vector<RemovedFoam> all;
    all.reserve(removed_.size());
    for (const Removed& own : removed_) all.push_back({own.orientation, coarser(own.down_to, factor)});
    return all;
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
