// The map of one direction of stock_model.h, and the columns of foam in it.

#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <vector>

#include "base/box.h"
#include "base/pose.h"
#include "sim/replay/stock/dexel.h"

namespace qchopper {

struct DexelTile {
    static constexpr std::int32_t side = 64;
    static constexpr std::size_t cells = static_cast<std::size_t>(side) * side;
    struct Below {
        std::uint32_t cell = 0;
        float low = 0;
        float high = 0;
    };
    std::vector<float> cut = std::vector<float>(cells, std::numeric_limits<float>::infinity());
    // The highest interval of each column; low >= high: none is left. Of a tile that no tool came to they are empty.
    std::vector<float> low, high;
    // Above this height a column is what is left of the foam; below, foam may stand in it that another direction took.
    std::vector<float> known_from;
    std::array<std::vector<Below>, side> below;  // further intervals, per row by cell, of each cell the highest last
    float min_cut = std::numeric_limits<float>::infinity();
    // The least of `cut` of each square of 8 x 8 cells: lines far below it pass the square at once.
    static constexpr std::int32_t square = 8;
    std::array<float, cells / (square * square)> min_of_square = filled_with_infinity();
    // The greatest of it, and of the tile, at most: lines above it pass the square through air. measure_most lowers it.
    std::array<float, cells / (square * square)> max_of_square = filled_with_infinity();
    float max_cut = std::numeric_limits<float>::infinity();
    std::uint64_t lowered_squares = 0;  // a bit per square: since measure_most
    // Of the other maps to which `known_from` refers; 0: there are no columns, nothing_known: and no `known_from`.
    std::uint64_t version = 0;
    static constexpr std::uint64_t nothing_known = std::numeric_limits<std::uint64_t>::max();
    // Of the columns of a square of 8 x 8 cells, slab by slab from the top of the map down, once it is known
    // (dexel_columns.h): whether one of the other maps has removed all of it, or else a bit for each of them that may
    // have removed something there.
    struct Slab {
        std::uint64_t known = 0;    // a bit per square
        std::uint64_t removed = 0;  // likewise
        std::array<std::uint16_t, cells / (square * square)> met{};
    };
    std::vector<Slab> slabs;
    // How far the columns of a square are known from their highest foam down, all at once: to before a slab.
    struct Descent {
        std::size_t slab = 0;
        bool is_begun = false;
        bool is_in_foam = false;  // slabs that no other map has removed anything from were passed
        bool is_ended = false;    // at a slab that does not tell
    };
    std::array<Descent, cells / (square * square)> descents;
    // Highest foam of each square of 16 x 16 cells; too high is allowed.
    static constexpr std::int32_t top_square = 16;
    std::array<float, cells / (top_square * top_square)> top{};
    static constexpr std::size_t top_of_cell(std::size_t cell) {
        return cell / side / top_square * (side / top_square) + cell % side / top_square;
    }

    // Lowers `cut` of a cell, and the least ones with it.
    void lower_cut(std::size_t cell, float height) {
        cut[cell] = height;
        min_cut = std::min(min_cut, height);
        const std::size_t in =
            square_of_cut(static_cast<std::int32_t>(cell) % side, static_cast<std::int32_t>(cell) / side);
        min_of_square[in] = std::min(min_of_square[in], height);
        lowered_squares |= std::uint64_t{1} << in;
    }
    // The lanes of a row of a square.
    using Lanes = std::array<float, square>;
    // The same of the cells of a row of a square, from its first one on, where that lowers them; in how many of their
    // columns foam stands higher, and in which. `least` is lowered to the least of them, which note_lowered() is to be
    // told. In lanes, which compilers turn into vectors.
    int lower_cuts(std::size_t first, const Lanes& heights, std::array<std::int32_t, square>& stands, Lanes& least) {
        Lanes own;
        Lanes bottom;
        Lanes above;
        std::copy_n(&cut[first], square, own.begin());
        std::copy_n(&low[first], square, bottom.begin());
        std::copy_n(&high[first], square, above.begin());
        Lanes lowest = least;
        std::array<std::int32_t, square> higher;
        for (std::size_t k = 0; k < own.size(); ++k) {
            const float z = heights[k];
            const float under = above[k] < own[k] ? above[k] : own[k];  // what is lowered now alone
            higher[k] = (z < under ? 1 : 0) & (bottom[k] < above[k] ? 1 : 0);
            own[k] = z < own[k] ? z : own[k];
            lowest[k] = own[k] < lowest[k] ? own[k] : lowest[k];
        }
        int standing = 0;
        for (const std::int32_t one : higher) standing += one;
        std::copy_n(own.begin(), square, &cut[first]);
        least = lowest;
        stands = higher;
        return standing;
    }
    void note_lowered(std::size_t in_square, const Lanes& least) {
        const float lowest = *std::min_element(least.begin(), least.end());
        min_cut = std::min(min_cut, lowest);
        min_of_square[in_square] = std::min(min_of_square[in_square], lowest);
        lowered_squares |= std::uint64_t{1} << in_square;
    }
    void measure_most();
    // Of the columns of a square of `size` x `size` cells, a multiple of 8, that begins with a cell.
    float highest_in(std::size_t first, std::int32_t size) const;
    static constexpr std::size_t square_of_cut(std::int32_t x, std::int32_t y) {
        return static_cast<std::size_t>(y / square) * (side / square) + static_cast<std::size_t>(x / square);
    }

 private:
    static std::array<float, cells / (square * square)> filled_with_infinity() {
        std::array<float, cells / (square * square)> all;
        all.fill(std::numeric_limits<float>::infinity());
        return all;
    }
};

// Cells of a half-open range.
struct CellRange {
    std::int32_t x_begin = 0;
    std::int32_t x_end = 0;
    std::int32_t y_begin = 0;
    std::int32_t y_end = 0;
};

// Of points of a map's frame, closed.
struct MapRectangle {
    double x_min = 0;
    double x_max = 0;
    double y_min = 0;
    double y_max = 0;
};

// Distance from a point to the nearest of the points above the centres of square cells, at most `most`; the first cell
// has its corner at x_min, y_min, and height_at(i, j) says where they begin: infinite where there are none. Ring by
// ring about the point, as long as a nearer one can come.
template <class HeightAt>
double distance_to_cells(Vec3 point, double x_min, double y_min, double cell, double most, const HeightAt& height_at) {
    double best = most;
    const auto i0 = static_cast<std::int32_t>(std::floor((point.x - x_min) / cell));
    const auto j0 = static_cast<std::int32_t>(std::floor((point.y - y_min) / cell));
    const auto look = [&](std::int32_t i, std::int32_t j) {
        const double dx = x_min + (i + 0.5) * cell - point.x;
        const double dy = y_min + (j + 0.5) * cell - point.y;
        const double dz = std::max(0.0, height_at(i, j) - point.z);
        best = std::min(best, std::sqrt(dx * dx + dy * dy + dz * dz));
    };
    for (std::int32_t ring = 0; ring <= static_cast<std::int32_t>(best / cell + 1); ++ring) {
        for (std::int32_t k = -ring; k <= ring; ++k) {
            look(i0 + k, j0 - ring);
            if (ring > 0) look(i0 + k, j0 + ring);
            if (k > -ring && k < ring) look(i0 - ring, j0 + k), look(i0 + ring, j0 + k);
        }
    }
    return best;
}

// A line through a map, in its frame.
struct MapLine {
    Vec3 from;
    Vec3 along;
    double per_x = 0;  // 1 / along
    double per_y = 0;
    double per_z = 0;

    MapLine(Vec3 start, Vec3 unit)
        : from(start), along(unit), per_x(1 / unit.x), per_y(1 / unit.y), per_z(1 / unit.z) {}
    // Between two places of the line.
    double highest(double t, double next) const { return from.z + along.z * (along.z > 0 ? next : t); }
    double lowest(double t, double next) const { return from.z + along.z * (along.z > 0 ? t : next); }
};

class DexelMap {
 public:
    DexelMap(const Box& block, Vec3 tool_axis, double cell);

    CellRange range(double x_min, double x_max, double y_min, double y_max) const;
    double centre_x(std::int32_t i) const { return x_min_ + (i + 0.5) * cell_; }
    double centre_y(std::int32_t j) const { return y_min_ + (j + 0.5) * cell_; }
    const DexelTile* tile(std::int32_t tx, std::int32_t ty) const { return tiles_[index(tx, ty)].get(); }
    DexelTile& made_tile(std::int32_t tx, std::int32_t ty);
    const std::vector<std::unique_ptr<DexelTile>>& tiles() const { return tiles_; }  // row by row; null: not made
    double cell() const { return cell_; }
    std::int32_t tiles_x() const { return tiles_x_; }
    std::int32_t tiles_y() const { return tiles_y_; }
    // Height to which the cell of a point is cleared; infinite outside.
    float cut_at(double x, double y) const;
    // Takes from the intervals of a line, ascending and apart, what was removed along this direction between two
    // places of the line.
    void remove_from(std::vector<Dexel>& intervals, const MapLine& line, const Dexel& within) const;
    // What was removed between two heights in the squares of 8 x 8 cells that hold points of a rectangle: none and all
    // are certain. What lies beyond the map is left out.
    enum class Removed { none, some, all };
    Removed removed_in(const Dexel& heights, const MapRectangle& within) const;
    // Distance from a point of this frame to the nearest removed point of it, at most `most`.
    double distance_to_removed(Vec3 point, double most) const;
    // Where the line meets the block; empty if it does not.
    Dexel block_on(Vec3 from, Vec3 along) const;

    Pose frame_in_block;
    Box block;
    double top = 0;  // of the block in this frame
    double bottom = 0;
    std::uint64_t version = 1;  // grows with every change

 private:
    struct MapCell {
        std::int32_t i = 0;
        std::int32_t j = 0;
    };
    double remove_in_square(std::vector<Dexel>& intervals, std::size_t& interval, const MapLine& line,
                            const DexelTile& here, MapCell at, const Dexel& part) const;
    // From t on, where in a square of `step` cells, a power of 2, the line leaves it, but not beyond `end`.
    double leaves_square(const MapLine& line, std::int32_t ci, std::int32_t cj, std::int32_t step, double t,
                         double end) const {
        const double x0 = x_min_ + (ci & -step) * cell_;
        const double y0 = y_min_ + (cj & -step) * cell_;
        const double size = step * cell_;
        double next = end;
        if (line.along.x != 0) next = std::min(next, ((line.along.x > 0 ? x0 + size : x0) - line.from.x) * line.per_x);
        if (line.along.y != 0) next = std::min(next, ((line.along.y > 0 ? y0 + size : y0) - line.from.y) * line.per_y);
        return std::min(std::max(next, t), end);
    }
    std::size_t index(std::int32_t tx, std::int32_t ty) const { return static_cast<std::size_t>(ty) * tiles_x_ + tx; }

    double cell_;
    double x_min_ = 0;
    double y_min_ = 0;
    std::int32_t tiles_x_ = 0;
    std::int32_t tiles_y_ = 0;
    std::vector<std::unique_ptr<DexelTile>> tiles_;
};

}  // namespace qchopper
