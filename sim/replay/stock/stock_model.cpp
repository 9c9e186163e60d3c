// Cells under the swept tool, square by square of 8 x 8; the height at a cell is that of cutter.h. Passed over are
// squares that are lower than the tool comes over them, and those behind a move that goes on where the last one ended.
// Volumes are sums over cells in a fixed order. O(cells under the tool that are higher), and for a line that of all
// maps (dexel_map.h).

#include "sim/replay/stock/stock_model.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/error.h"
#include "base/process.h"
#include "sim/replay/stock/dexel_columns.h"
#include "sim/replay/stock/dexel_map.h"

namespace qchopper {
namespace {

constexpr double contact_mm = 0.01;
constexpr std::int32_t side = DexelTile::side;
constexpr std::int32_t square = DexelTile::top_square;

// The cell of a tile in column i and row j.
std::size_t cell_of(std::int32_t i, std::int32_t j) {
    return static_cast<std::size_t>(j) * side + static_cast<std::size_t>(i);
}

}  // namespace

StockModel::StockModel(const Box& block, const std::vector<Vec3>& tool_axes, double cell)
    : block_(block), tool_axes_(tool_axes), cell_(cell) {
    assert(cell > 0);
    for (const Vec3 tool_axis : tool_axes) maps_.push_back(std::make_unique<DexelMap>(block, tool_axis, cell));
    for (std::size_t d = 0; d < maps_.size(); ++d) columns_.push_back(std::make_unique<DexelColumns>(maps_, d));
}

StockModel::~StockModel() = default;

const Pose& StockModel::frame_in_block(std::size_t orientation) const {
    return maps_[orientation]->frame_in_block;
}

namespace {

// How many of the numbers lie in an interval of a length at most. O(n log n).
std::size_t max_within(std::vector<double>& numbers, double length) {
    std::sort(numbers.begin(), numbers.end());
    std::size_t most = 0;
    std::size_t first = 0;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        while (numbers[i] - numbers[first] > length) ++first;
        most = std::max(most, i + 1 - first);
    }
    return most;
}

// Calls work(tile, tx, ty) for the tiles of a range.
template <class Work>
void for_tiles(DexelColumns& columns, const CellRange& cells, const Work& work) {
    columns.begin();
    for (std::int32_t ty = cells.y_begin / side; ty * side < cells.y_end; ++ty) {
        for (std::int32_t tx = cells.x_begin / side; tx * side < cells.x_end; ++tx) work(columns.tile(tx, ty), tx, ty);
    }
}

// A cutter that goes straight over the cells of a map.
class SweepOverMap {
 public:
    using Row = DexelTile::Lanes;

    // From a place of the map's frame.
    SweepOverMap(const Cutter& cutter, Vec3 from, Vec3 move, const DexelMap& map)
        : swept_(cutter, move),
          map_(map),
          from_(from),
          move_(move),
          length_(std::sqrt(move.x * move.x + move.y * move.y)),
          touches_before_(swept_.touches_before()) {
        if (length_ < 1e-9) length_ = 0;
        if (length_ > 0) unit_x_ = move.x / length_, unit_y_ = move.y / length_;
    }
    // Below this it does not come.
    double least() const { return from_.z + std::min(0.0, move_.z); }
    CellRange cells() const {
        const double r = swept_.cutter().radius;
        return map_.range(std::min(from_.x, from_.x + move_.x) - r, std::max(from_.x, from_.x + move_.x) + r,
                          std::min(from_.y, from_.y + move_.y) - r, std::max(from_.y, from_.y + move_.y) + r);
    }
    // Below this it does not come in the square that begins with a cell: the profile at the square's distance from the
    // axis, which is at least that of its middle less half a diagonal. Infinite where it does not come at all; also
    // where it comes no lower than it stands where the move begins, if that `is_begun`: what is there is removed
    // already.
    double least_in_square(std::int32_t x, std::int32_t y, bool is_begun) const {
        constexpr double infinite = std::numeric_limits<double>::infinity();
        const double half = 0.5 * (DexelTile::square - 1) * map_.cell();
        const double from_middle = std::numbers::sqrt2 * half;
        const double to_x = x_of(x) + half;
        const double to_y = y_of(y) + half;
        const double along = to_x * unit_x_ + to_y * unit_y_;
        if (is_begun && length_ > 0 && along + from_middle < -touches_before_) return infinite;
        const double place = std::clamp(along, 0.0, length_);
        const double off_x = to_x - place * unit_x_;
        const double off_y = to_y - place * unit_y_;
        const double aside = std::sqrt(off_x * off_x + off_y * off_y) - from_middle;
        if (aside > swept_.cutter().radius) return infinite;
        return aside > 0 ? least() + profile_height(swept_.cutter(), aside) : least();
    }
    // The cells of a row that it reaches.
    CellRange reach_of_row(std::int32_t y) const {
        double x_min = 0;
        double x_max = 0;
        swept_.reach_of_row(y_of(y), x_min, x_max);
        return map_.range(from_.x + x_min, from_.x + x_max, 0, 0);
    }
    double x_of(std::int32_t x) const { return map_.centre_x(x) - from_.x; }
    double y_of(std::int32_t y) const { return map_.centre_y(y) - from_.y; }
    // The heights of its surface over the cells from one on, in a row, and whether it comes below one of theirs.
    bool is_below(std::int32_t x, std::int32_t y, const float* heights, Row& z) const {
        static_assert(SweptCutter::at_once == DexelTile::square);
        SweptCutter::Row at;
        SweptCutter::Row over;
        for (std::int32_t k = 0; k < DexelTile::square; ++k) at[static_cast<std::size_t>(k)] = x_of(x + k);
        swept_.heights(at, y_of(y), over);
        Row own;
        std::copy_n(heights, own.size(), own.begin());
        Row single;
        const double from_z = from_.z;
        for (std::size_t k = 0; k < single.size(); ++k) single[k] = static_cast<float>(over[k] + from_z);
        std::int32_t below = 0;
        for (std::size_t k = 0; k < single.size(); ++k) below += single[k] < own[k] ? 1 : 0;
        z = single;
        return below > 0;
    }
    SweptCutter::Height height(std::int32_t x, std::int32_t y) const { return swept_.height(x_of(x), y_of(y)); }

 private:
    SweptCutter swept_;
    const DexelMap& map_;
    Vec3 from_;
    Vec3 move_;
    double length_;  // across the axis
    double unit_x_ = 0;
    double unit_y_ = 0;
    double touches_before_;
};

// Calls work(x, y) for the first cell of each square of a tile that has one of the cells; all count from the tile's.
template <class Work>
void for_squares(const CellRange& cells, const Work& work) {
    constexpr std::int32_t size = DexelTile::square;
    for (std::int32_t y = std::max(0, cells.y_begin) / size * size; y < std::min(cells.y_end, side); y += size) {
        for (std::int32_t x = std::max(0, cells.x_begin) / size * size; x < std::min(cells.x_end, side); x += size) {
            work(x, y);
        }
    }
}

// Lowers the cells of some rows of a square to a sweep: lower_column(tile, cell, z) is called where foam may stand
// higher. `at` counts squares, `rows` cells of the tile from the first column of the square on.
template <class LowerColumn>
void lower_square(const SweepOverMap& sweep, DexelTile& tile, TileCell at, const CellRange& rows,
                  const LowerColumn& lower_column) {
    SweepOverMap::Row z;
    SweepOverMap::Row lowest;
    lowest.fill(std::numeric_limits<float>::infinity());
    std::array<std::int32_t, DexelTile::square> stands{};
    bool is_lowered = false;
    for (std::int32_t j = rows.y_begin; j < rows.y_end; ++j) {
        const std::size_t first = cell_of(rows.x_begin, j);
        if (!sweep.is_below(at.tx * side + rows.x_begin, at.ty * side + j, &tile.cut[first], z)) continue;
        is_lowered = true;
        if (tile.lower_cuts(first, z, stands, lowest) == 0) continue;
        for (std::size_t k = 0; k < z.size(); ++k) {
            if (stands[k] != 0) lower_column(tile, TileCell{at.tx, at.ty, first + k}, z[k]);
        }
    }
    if (is_lowered) tile.note_lowered(at.cell, lowest);
}

CellRange moved_by(const CellRange& cells, std::int32_t x, std::int32_t y) {
    return {cells.x_begin + x, cells.x_end + x, cells.y_begin + y, cells.y_end + y};
}

}  // namespace

DexelColumns& StockModel::columns_along(std::size_t orientation) {
    if (orientation != milled_) columns_[milled_]->leave();
    milled_ = orientation;
    return *columns_[orientation];
}

void StockModel::end_milling() {
    for (const std::unique_ptr<DexelColumns>& columns : columns_) columns->end();
    give_back_freed_memory();  // holes between tiles, too small for maps of all the target
}

CutResult StockModel::cut(std::size_t orientation, const Cutter& cutter, double flute, Vec3 from, Vec3 to) {
    DexelMap& map = *maps_[orientation];
    DexelColumns& columns = columns_along(orientation);
    const Vec3 a = apply_inverse(map.frame_in_block, from);
    const Vec3 move = apply_inverse(map.frame_in_block, to) - a;
    const SweepOverMap sweep(cutter, a, move, map);
    const SweepOverMap inner(inset_cutter(cutter, contact_mm), a, move, map);
    const bool is_begun =
        last_move_ && last_move_->orientation == orientation && last_move_->cutter == cutter && last_move_->to == from;
    last_move_ = {orientation, cutter, to};
    CutResult result;
    std::vector<double> deep;  // where along the move foam stands above the flute, of each cell
    double length = 0;
    const CellRange cells = sweep.cells();
    const double least = sweep.least();
    const auto lower_column = [&](DexelTile& tile, TileCell at, float z) {
        const std::size_t cell = at.cell;
        columns.know(tile, at, z);
        const ColumnRemoval removal = DexelColumns::lower(tile, cell, z);
        length += removal.length;
        if (removal.length <= contact_mm) return;
        const double most = removal.top - least;  // deeper it is not
        if (result.touches && most <= result.depth && most <= flute) return;
        const auto x = at.tx * side + static_cast<std::int32_t>(cell % side);
        const auto y = at.ty * side + static_cast<std::int32_t>(cell / side);
        if (!(a.z + contact_mm + inner.height(x, y).z < removal.top - contact_mm)) return;
        result.touches = true;
        const double depth = removal.top - (a.z + sweep.height(x, y).tip_z);
        result.depth = std::max(result.depth, depth);
        if (depth > flute) deep.push_back(move.x * sweep.x_of(x) + move.y * sweep.y_of(y));
    };
    for_tiles(columns, cells, [&](DexelTile& tile, std::int32_t tx, std::int32_t ty) {
        if (tile.max_cut <= least) return;
        const CellRange own = moved_by(cells, -tx * side, -ty * side);
        for_squares(own, [&](std::int32_t x, std::int32_t y) {
            const std::size_t in_square = DexelTile::square_of_cut(x, y);
            const float most = tile.max_of_square[in_square];
            if (most <= least || most <= sweep.least_in_square(tx * side + x, ty * side + y, is_begun)) return;
            const CellRange rows{x, x, std::max(y, own.y_begin), std::min(y + DexelTile::square, own.y_end)};
            lower_square(sweep, tile, {tx, ty, in_square}, rows, lower_column);
        });
        tile.measure_most();
    });
    if (length > 0) ++map.version;
    result.volume = length * cell_ * cell_;
    const double diameter = 2 * cutter.radius * std::hypot(move.x, move.y);  // as `deep` is measured
    result.deep_mm2 = static_cast<double>(max_within(deep, diameter)) * cell_ * cell_;
    return result;
}

double StockModel::disc_contact(std::size_t orientation, double radius, double above, Vec3 from, Vec3 to) {
    DexelMap& map = *maps_[orientation];
    DexelColumns& columns = columns_along(orientation);
    const Vec3 a = apply_inverse(map.frame_in_block, from) + Vec3{0, 0, above};
    const Vec3 move = apply_inverse(map.frame_in_block, to) + Vec3{0, 0, above} - a;
    const SweepOverMap disc({ToolShape::flat, radius, 0, 0, 1}, a, move, map);
    const double least = disc.least();
    if (least >= map.top) return 0;
    double worst = 0;
    const CellRange cells = disc.cells();
    for_tiles(columns, cells, [&](DexelTile& tile, std::int32_t tx, std::int32_t ty) {
        for (std::int32_t q = 0; q < square; ++q) {
            if (tile.top[static_cast<std::size_t>(q)] <= least + worst) continue;
            const std::int32_t x0 = q % 4 * square;
            const std::int32_t y0 = q / 4 * square;
            const std::int32_t y_end = std::min(cells.y_end - ty * side, y0 + square);
            for (std::int32_t j = std::max(y0, cells.y_begin - ty * side); j < y_end; ++j) {
                const CellRange row = moved_by(disc.reach_of_row(ty * side + j), -tx * side, 0);
                for (std::int32_t i = std::max(x0, row.x_begin); i < std::min(row.x_end, x0 + square); ++i) {
                    const auto cell = cell_of(i, j);
                    if (!(tile.low[cell] < tile.high[cell]) || tile.high[cell] <= least + worst) continue;
                    const double underside = a.z + disc.height(tx * side + i, ty * side + j).z;
                    if (!(tile.high[cell] - underside > worst)) continue;
                    columns.know(tile, {tx, ty, cell}, underside + worst);
                    if (tile.low[cell] < tile.high[cell]) worst = std::max(worst, tile.high[cell] - underside);
                }
            }
            // Nothing may have stood as high as was thought.
            tile.top[static_cast<std::size_t>(q)] = tile.highest_in(cell_of(x0, y0), square);
        }
    });
    return worst;
}

namespace {

// In units of 0.01 mm, up; what is off by rounding of such a height alone stays.
std::int32_t rounded_up(float height) {
    constexpr double per_mm = 100;
    constexpr double slack = 0.01;
    if (std::isinf(height)) return StockTile::not_cut;
    return static_cast<std::int32_t>(std::ceil(per_mm * height - slack));
}

StockMap stock_of(const DexelMap& map, Vec3 tool_axis) {
    StockMap stock{tool_axis, {}};
    for (std::int32_t ty = 0; ty < map.tiles_y(); ++ty) {
        for (std::int32_t tx = 0; tx < map.tiles_x(); ++tx) {
            const DexelTile* tile = map.tile(tx, ty);
            if (tile == nullptr || std::isinf(tile->min_cut)) continue;
            StockTile& cells = stock.tiles.emplace_back(StockTile{tx, ty, {}});
            cells.height.reserve(DexelTile::cells);
            for (const float height : tile->cut) cells.height.push_back(rounded_up(height));
        }
    }
    return stock;
}

bool is_equal(Vec3 a, Vec3 b) {
    return norm(a - b) <= 1e-6;
}

[[noreturn]] void refuse_stock(const char* why) {
    throw InputError(InputFault::mesh, std::string("the stock that the part before left is of ") + why,
                     "write the jobs of the piece again with qchopper prepare");
}

void lower(DexelMap& map, const StockMap& stock) {
    for (const StockTile& cells : stock.tiles) {
        if (cells.tx >= map.tiles_x() || cells.ty >= map.tiles_y()) refuse_stock("another block");
        DexelTile& tile = map.made_tile(cells.tx, cells.ty);
        for (std::size_t cell = 0; cell < DexelTile::cells; ++cell) {
            if (cells.height[cell] == StockTile::not_cut) continue;
            tile.lower_cut(cell, static_cast<float>(0.01 * cells.height[cell]));
        }
        tile.measure_most();
    }
    ++map.version;
}

}  // namespace

StockRecord StockModel::record() const {
    StockRecord stock{block_, cell_, {}, {}};
    for (std::size_t d = 0; d < maps_.size(); ++d) stock.maps.push_back(stock_of(*maps_[d], tool_axes_[d]));
    return stock;
}

void StockModel::start_from(const StockRecord& stock) {
    if (!is_equal(stock.block.min, block_.min) || !is_equal(stock.block.max, block_.max)) refuse_stock("another block");
    if (stock.cell != cell_) refuse_stock("other cells");
    if (stock.maps.size() != maps_.size()) refuse_stock("other orientations");
    for (std::size_t d = 0; d < maps_.size(); ++d) {
        if (!is_equal(stock.maps[d].tool_axis, tool_axes_[d])) refuse_stock("other orientations");
    }
    last_move_.reset();
    for (std::size_t d = 0; d < maps_.size(); ++d) lower(*maps_[d], stock.maps[d]);
}

bool StockModel::is_in_stock(Vec3 p) const {
    for (int axis = 0; axis < 3; ++axis) {
        if (p[axis] <= block_.min[axis] || p[axis] >= block_.max[axis]) return false;
    }
    for (const auto& map : maps_) {
        const Vec3 q = apply_inverse(map->frame_in_block, p);
        if (q.z > map->cut_at(q.x, q.y)) return false;
    }
    return true;
}

std::vector<Dexel> StockModel::on_line(Vec3 from, Vec3 along, double low, double high) const {
    const DexelMap& first = *maps_.front();
    const Dexel inside =
        first.block_on(apply_inverse(first.frame_in_block, from), rotate_inverse(first.frame_in_block, along));
    std::vector<Dexel> stock_model;
    if (std::max(low, inside.low) < std::min(high, inside.high)) {
        stock_model.push_back({std::max(low, inside.low), std::min(high, inside.high)});
    }
    for (const auto& map : maps_) {
        const MapLine line(apply_inverse(map->frame_in_block, from), rotate_inverse(map->frame_in_block, along));
        map->remove_from(stock_model, line, {low, high});
    }
    return stock_model;
}

double StockModel::distance_to_removed(Vec3 p, double most, std::size_t& nearest) const {
    double best = most;
    for (const double side_distance :
         {p.x - block_.min.x, block_.max.x - p.x, p.y - block_.min.y, block_.max.y - p.y, block_.max.z - p.z}) {
        best = std::min(best, std::max(0.0, side_distance));
    }
    const std::size_t first = nearest;
    for (std::size_t k = 0; k < maps_.size(); ++k) {
        const std::size_t i = (first + k) % maps_.size();
        const double own = maps_[i]->distance_to_removed(apply_inverse(maps_[i]->frame_in_block, p), best);
        if (own >= best) continue;
        best = own;
        nearest = i;
    }
    return best;
}

}  // namespace qchopper
