// A line is followed through the cells of a map from border to border (J. Amanatides, A. Woo: A Fast Voxel Traversal
// Algorithm for Ray Tracing, 1987) of tiles that do not exist, else of cells; in a cell the height of the line is
// linear, so that where it leaves the removed part is solved, not sampled. O(cells along the line).

#include "sim/replay/stock/dexel_map.h"

#include <algorithm>
#include <cmath>

#include "sim/replay/stock/tool_axis_frame.h"

namespace qchopper {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double border = 1;  // cells around the projection of the block

void subtract(std::vector<Dexel>& intervals, double low, double high) {
    if (!(low < high)) return;
    for (std::size_t k = 0; k < intervals.size(); ++k) {
        Dexel& own = intervals[k];
        if (own.high <= low || own.low >= high) continue;
        const Dexel above{high, own.high};
        own.high = low;
        const bool has_below = own.low < own.high;
        if (above.low < above.high && has_below) {
            intervals.insert(intervals.begin() + static_cast<std::ptrdiff_t>(k) + 1, above);
            return;
        }
        if (above.low < above.high) {
            own = above;
        } else if (!has_below) {
            intervals.erase(intervals.begin() + static_cast<std::ptrdiff_t>(k));
            --k;
        }
    }
}

}  // namespace

void DexelTile::measure_most() {
    if (lowered_squares == 0) return;
    constexpr std::size_t per_row = side / square;
    for (std::size_t in = 0; in < max_of_square.size(); ++in) {
        if ((lowered_squares >> in & 1) == 0) continue;
        const float* row = &cut[in / per_row * square * side + in % per_row * square];
        float most = -std::numeric_limits<float>::infinity();
        for (std::int32_t j = 0; j < square; ++j, row += side) {
            for (std::int32_t i = 0; i < square; ++i) most = row[i] > most ? row[i] : most;
        }
        max_of_square[in] = most;
    }
    lowered_squares = 0;
    max_cut = *std::max_element(max_of_square.begin(), max_of_square.end());
}

// In lanes, which compilers turn into vectors.
float DexelTile::highest_in(std::size_t first) const {
    std::array<float, square> highest;
    highest.fill(-std::numeric_limits<float>::infinity());
    for (std::int32_t j = 0; j < top_square; ++j) {
        for (std::int32_t i = 0; i < top_square; i += square) {
            const std::size_t begin = first + static_cast<std::size_t>(j) * side + static_cast<std::size_t>(i);
            for (std::size_t k = 0; k < highest.size(); ++k) {
                const float own = low[begin + k] < high[begin + k] ? high[begin + k] : highest[k];
                highest[k] = own > highest[k] ? own : highest[k];
            }
        }
    }
    return *std::max_element(highest.begin(), highest.end());
}

DexelMap::DexelMap(const Box& block_box, Vec3 tool_axis, double cell)
    : frame_in_block(tool_axis_frame(tool_axis)), block(block_box), cell_(cell) {
    Box bounds;
    for (int corner = 0; corner < 8; ++corner) {
        const Vec3 p{(corner & 1) != 0 ? block.max.x : block.min.x, (corner & 2) != 0 ? block.max.y : block.min.y,
                     (corner & 4) != 0 ? block.max.z : block.min.z};
        const Vec3 q = apply_inverse(frame_in_block, p);
        if (corner == 0) bounds = {q, q};
        extend(bounds, q);
    }
    top = bounds.max.z;
    bottom = bounds.min.z;
    // Middles of cells lie on multiples of the cell plus a half, whatever the block is.
    x_min_ = (std::floor(bounds.min.x / cell) - border) * cell;
    y_min_ = (std::floor(bounds.min.y / cell) - border) * cell;
    const auto tiles = [&](double min, double max) {
        return static_cast<std::int32_t>(std::ceil((max - min) / cell + border)) / DexelTile::side + 1;
    };
    tiles_x_ = tiles(x_min_, bounds.max.x);
    tiles_y_ = tiles(y_min_, bounds.max.y);
    tiles_.resize(static_cast<std::size_t>(tiles_x_) * static_cast<std::size_t>(tiles_y_));
}

CellRange DexelMap::range(double x_min, double x_max, double y_min, double y_max) const {
    const auto first = [&](double at, double begin, std::int32_t tiles) {
        const double i = std::ceil((at - begin) / cell_ - 0.5);
        return static_cast<std::int32_t>(std::clamp(i, 0.0, static_cast<double>(tiles) * DexelTile::side));
    };
    CellRange cells{first(x_min, x_min_, tiles_x_), first(x_max, x_min_, tiles_x_) + 1, first(y_min, y_min_, tiles_y_),
                    first(y_max, y_min_, tiles_y_) + 1};
    cells.x_end = std::min(cells.x_end, tiles_x_ * DexelTile::side);
    cells.y_end = std::min(cells.y_end, tiles_y_ * DexelTile::side);
    return cells;
}

DexelTile& DexelMap::made_tile(std::int32_t tx, std::int32_t ty) {
    std::unique_ptr<DexelTile>& tile = tiles_[index(tx, ty)];
    if (!tile) tile = std::make_unique<DexelTile>();
    return *tile;
}

float DexelMap::cut_at(double x, double y) const {
    const double i = std::floor((x - x_min_) / cell_);
    const double j = std::floor((y - y_min_) / cell_);
    constexpr auto side = DexelTile::side;
    if (!(i >= 0 && j >= 0 && i < double(tiles_x_) * side && j < double(tiles_y_) * side)) return infinite;
    const auto ci = static_cast<std::int32_t>(i);
    const auto cj = static_cast<std::int32_t>(j);
    const DexelTile* tile = this->tile(ci / side, cj / side);
    if (tile == nullptr) return std::numeric_limits<float>::infinity();
    return tile->cut[static_cast<std::size_t>(cj % side) * side + static_cast<std::size_t>(ci % side)];
}

Dexel DexelMap::block_on(Vec3 from, Vec3 along) const {
    const Vec3 p = apply(frame_in_block, from);
    const Vec3 d = rotate(frame_in_block, along);
    Dexel inside{-infinite, infinite};
    for (int axis = 0; axis < 3; ++axis) {
        if (std::abs(d[axis]) < 1e-12) {
            if (p[axis] < block.min[axis] || p[axis] > block.max[axis]) return {0, 0};
            continue;
        }
        const double a = (block.min[axis] - p[axis]) / d[axis];
        const double b = (block.max[axis] - p[axis]) / d[axis];
        inside.low = std::max(inside.low, std::min(a, b));
        inside.high = std::min(inside.high, std::max(a, b));
    }
    return inside.low < inside.high ? inside : Dexel{0, 0};
}

// Squares that the line passes below all that was cut there, or through air alone, are passed at once: tiles, then
// their squares, then cells; so are the gaps between intervals.
void DexelMap::remove_from(std::vector<Dexel>& intervals, Vec3 from, Vec3 along) const {
    constexpr auto side = DexelTile::side;
    const MapLine line{from, along, 1 / along.x, 1 / along.y, 1 / along.z};
    const double nudge = 1e-9 * cell_;
    const double per_cell = 1 / cell_;
    double t = intervals.empty() ? infinite : intervals.front().low;
    while (true) {
        const auto stock_model =
            std::find_if(intervals.begin(), intervals.end(), [&](const Dexel& i) { return i.high > t; });
        if (stock_model == intervals.end()) return;
        t = std::max(t, stock_model->low);
        const double end = stock_model->high;
        const double middle = t + nudge;
        const double i = std::floor((from.x + middle * along.x - x_min_) * per_cell);
        const double j = std::floor((from.y + middle * along.y - y_min_) * per_cell);
        if (!(i >= 0 && j >= 0 && i < double(tiles_x_) * side && j < double(tiles_y_) * side)) return;
        const auto ci = static_cast<std::int32_t>(i);
        const auto cj = static_cast<std::int32_t>(j);
        const DexelTile* here = tile(ci / side, cj / side);
        double next = leaves_square(line, ci, cj, side, middle, end);
        if (here != nullptr && here->min_cut < line.highest(t, next)) {
            if (here->max_cut < line.lowest(t, next)) {
                subtract(intervals, t, next);
            } else {
                next = remove_in_square(intervals, line, *here, {ci, cj}, t, end);
            }
        }
        t = next;
    }
}

// Returns where the part of the line that was done ends: in the square, cell by cell, unless it is passed at once.
double DexelMap::remove_in_square(std::vector<Dexel>& intervals, const MapLine& line, const DexelTile& here, MapCell at,
                                  double t, double end) const {
    constexpr auto side = DexelTile::side;
    const double nudge = 1e-9 * cell_;
    const double per_cell = 1 / cell_;
    const std::size_t square = DexelTile::square_of_cut(at.i % side, at.j % side);
    const double left = leaves_square(line, at.i, at.j, DexelTile::square, t + nudge, end);
    if (here.min_of_square[square] >= line.highest(t, left)) return left;
    if (here.max_of_square[square] < line.lowest(t, left)) {
        subtract(intervals, t, left);
        return left;
    }
    MapCell cell = at;
    while (true) {
        const double next = leaves_square(line, cell.i, cell.j, 1, t + nudge, end);
        const double cut =
            here.cut[static_cast<std::size_t>(cell.j % side) * side + static_cast<std::size_t>(cell.i % side)];
        const double crossing = line.along.z != 0 ? (cut - line.from.z) * line.per_z : infinite;
        if (line.along.z > 0) subtract(intervals, std::max(t, crossing), next);
        if (line.along.z < 0) subtract(intervals, t, std::min(next, crossing));
        if (line.along.z == 0 && line.from.z > cut) subtract(intervals, t, next);
        if (next >= left) return next;
        t = next;
        const double i = (line.from.x + (t + nudge) * line.along.x - x_min_) * per_cell;
        const double j = (line.from.y + (t + nudge) * line.along.y - y_min_) * per_cell;
        if (!(i >= 0 && j >= 0)) return next;
        cell = {static_cast<std::int32_t>(i), static_cast<std::int32_t>(j)};
        const bool is_in = cell.i / DexelTile::square == at.i / DexelTile::square &&
                           cell.j / DexelTile::square == at.j / DexelTile::square;
        if (!is_in) return next;
    }
}

bool DexelMap::is_cut_below(double height, const MapRectangle& within) const {
    constexpr std::int32_t squares = DexelTile::side / DexelTile::square;  // of a tile, each way
    const auto square_of = [&](double at, double begin, std::int32_t tiles) {
        const double square = std::floor((at - begin) / cell_ / DexelTile::square);
        return static_cast<std::int32_t>(std::clamp(square, 0.0, static_cast<double>(tiles * squares - 1)));
    };
    const std::int32_t i_end = square_of(within.x_max, x_min_, tiles_x_);
    const std::int32_t j_end = square_of(within.y_max, y_min_, tiles_y_);
    for (std::int32_t j = square_of(within.y_min, y_min_, tiles_y_); j <= j_end; ++j) {
        for (std::int32_t i = square_of(within.x_min, x_min_, tiles_x_); i <= i_end; ++i) {
            const DexelTile* here = tile(i / squares, j / squares);
            if (here == nullptr) continue;
            const auto in_tile =
                static_cast<std::size_t>(j % squares) * squares + static_cast<std::size_t>(i % squares);
            if (static_cast<double>(here->min_of_square[in_tile]) < height) return true;
        }
    }
    return false;
}

double DexelMap::distance_to_removed(Vec3 point, double most) const {
    constexpr auto side = DexelTile::side;
    const bool is_within_few_squares = most <= DexelTile::square * cell_;
    const MapRectangle about{point.x - most, point.x + most, point.y - most, point.y + most};
    if (is_within_few_squares && !is_cut_below(point.z + most, about)) return most;
    return distance_to_cells(point, x_min_, y_min_, cell_, most, [&](std::int32_t i, std::int32_t j) {
        const bool is_in = i >= 0 && j >= 0 && i < tiles_x_ * side && j < tiles_y_ * side;
        const DexelTile* here = is_in ? tile(i / side, j / side) : nullptr;
        if (here == nullptr) return std::numeric_limits<float>::infinity();
        return here->cut[static_cast<std::size_t>(j % side) * side + static_cast<std::size_t>(i % side)];
    });
}

}  // namespace qchopper
