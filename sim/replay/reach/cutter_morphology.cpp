// Stretches of a row at a time, by taps that can change them. Taps are the points of the underside of the tool at the
// centres of cells; those under which the first of all heights could not be the first in a stretch are passed over.
// O(cells * taps) at most; O(cells * radius / cell) for the dilation by a flat end.

#include "sim/replay/reach/cutter_morphology.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <utility>

#include "base/parallel.h"

namespace qchopper {
namespace {

// Points of the underside of a tool: a few beside each other in a row of cells.
struct Taps {
    std::int32_t dx = 0;  // of the first, in cells from the axis
    std::int32_t dy = 0;
    std::vector<float> height;  // above the tip
    float lowest = 0;           // of them
};

constexpr std::int32_t columns_at_once = CellBlocks::wide;
constexpr std::int32_t taps_at_once = 16;

// The lowest first: they decide most cells.
std::vector<Taps> taps_of(const Cutter& cutter, double cell) {
    std::vector<Taps> taps;
    const auto most = static_cast<std::int32_t>(std::floor(cutter.radius / cell));
    for (std::int32_t dy = -most; dy <= most; ++dy) {
        for (std::int32_t dx = -most; dx <= most; ++dx) {
            const double r = cell * std::sqrt(static_cast<double>(dx) * dx + static_cast<double>(dy) * dy);
            if (r > cutter.radius) continue;
            const auto height = static_cast<float>(profile_height(cutter, r));
            const bool goes_on = !taps.empty() && taps.back().dy == dy && taps.back().height.size() < taps_at_once;
            if (!goes_on) taps.push_back({dx, dy, {}, height});
            taps.back().height.push_back(height);
            taps.back().lowest = std::min(taps.back().lowest, height);
        }
    }
    std::stable_sort(taps.begin(), taps.end(), [](const Taps& a, const Taps& b) { return a.lowest < b.lowest; });
    return taps;
}

struct Dilation {
    static constexpr float none = no_surface;
    static float first(float a, float b) { return std::max(a, b); }
    static float last(float a, float b) { return std::min(a, b); }
    static float shifted(float height, float tap) { return height - tap; }
};

struct Erosion {
    static constexpr float none = -no_surface;
    static float first(float a, float b) { return std::min(a, b); }
    static float last(float a, float b) { return std::max(a, b); }
    static float shifted(float height, float tap) { return height + tap; }
};

// For each cell of a map the first, by the order of `Morphology`, of the shifted heights about it. Taps are passed over
// where the first of all heights under them, shifted least, is behind what all cells of the stretch have.
template <class Morphology>
class Morph {
 public:
    Morph(const SurfaceMap& map, std::vector<Taps> taps)
        : map_(map), taps_(std::move(taps)), blocks_((map.columns + taps_at_once - 1) / taps_at_once) {
        first_.assign(static_cast<std::size_t>(blocks_) * map.rows, Morphology::none);
        for (std::int32_t j = 0; j < map.rows; ++j) {
            for (std::int32_t i = 0; i < map.columns; ++i) {
                float& own = first_[static_cast<std::size_t>(j) * blocks_ + i / taps_at_once];
                own = Morphology::first(own, row(j)[i]);
            }
        }
    }

    std::vector<float> result(const CellBlocks& asked) const {
        std::vector<float> result(map_.height.size(), Morphology::none);
        parallel_for(0, static_cast<std::size_t>(map_.rows), [&](std::size_t j) {
            for (std::int32_t c = 0; c < map_.columns; c += columns_at_once) {
                if (!asked.has(c, static_cast<std::int32_t>(j))) continue;
                const std::int32_t count = std::min(columns_at_once, map_.columns - c);
                const Stretch found = stretch(static_cast<std::int32_t>(j), c, count);
                std::copy_n(found.begin(), count, result.begin() + static_cast<std::ptrdiff_t>(j) * map_.columns + c);
            }
        });
        return result;
    }

 private:
    using Stretch = std::array<float, columns_at_once>;

    const float* row(std::int32_t j) const {
        return map_.height.data() + static_cast<std::ptrdiff_t>(j) * map_.columns;
    }

    Stretch stretch(std::int32_t j, std::int32_t column, std::int32_t count) const {
        Stretch own;
        own.fill(-Morphology::none);  // beyond the map nothing is behind it
        std::fill_n(own.begin(), count, Morphology::none);
        float last = Morphology::none;
        for (const Taps& taps : taps_) {
            const std::int32_t from = j + taps.dy;
            if (from < 0 || from >= map_.rows) continue;
            const float reached =
                Morphology::shifted(first_in(from, column + taps.dx,
                                             column + taps.dx + count + static_cast<std::int32_t>(taps.height.size())),
                                    taps.lowest);
            if (Morphology::last(reached, last) == reached) continue;
            for (std::size_t k = 0; k < taps.height.size(); ++k) {
                const std::int32_t begin = column + taps.dx + static_cast<std::int32_t>(k);
                join(own, row(from), begin, count, taps.height[k]);
            }
            last = last_of(own);
        }
        return own;
    }

    // In lanes, which compilers turn into vectors.
    static float last_of(const Stretch& own) {
        std::array<float, 8> lanes{};
        std::copy_n(own.begin(), lanes.size(), lanes.begin());
        for (std::size_t i = lanes.size(); i < own.size(); i += lanes.size()) {
            for (std::size_t k = 0; k < lanes.size(); ++k) lanes[k] = Morphology::last(lanes[k], own[i + k]);
        }
        float last = lanes[0];
        for (const float lane : lanes) last = Morphology::last(last, lane);
        return last;
    }

    // Cells outside of the map are not asked.
    void join(Stretch& own, const float* heights, std::int32_t begin, std::int32_t count, float tap) const {
        const std::int32_t first = std::max(0, -begin);
        const std::int32_t end = std::min(count, map_.columns - begin);
        if (first == 0 && end == columns_at_once) {
            const float* from = heights + begin;
            for (std::size_t i = 0; i < columns_at_once; ++i) {
                own[i] = Morphology::first(own[i], Morphology::shifted(from[i], tap));
            }
            return;
        }
        for (std::int32_t i = first; i < end; ++i) {
            float& cell = own[static_cast<std::size_t>(i)];
            cell = Morphology::first(cell, Morphology::shifted(heights[begin + i], tap));
        }
    }

    // Of the columns from `begin` to before `end`, at least.
    float first_in(std::int32_t j, std::int32_t begin, std::int32_t end) const {
        float first = Morphology::none;
        const std::int32_t last_block = std::min(blocks_, (end + taps_at_once - 1) / taps_at_once);
        for (std::int32_t b = std::max(0, begin) / taps_at_once; b < last_block; ++b) {
            first = Morphology::first(first, first_[static_cast<std::size_t>(j) * blocks_ + b]);
        }
        return first;
    }

    const SurfaceMap& map_;
    std::vector<Taps> taps_;
    std::int32_t blocks_;       // of columns
    std::vector<float> first_;  // of the heights of a block, row by row
};

// Dilation by a flat end: the highest of a disc is that of the chords of its rows, and that of a chord is the higher
// one of two runs of cells, as long as a power of two, that cover it.
class FlatDilation {
 public:
    FlatDilation(const SurfaceMap& map, double radius)
        : map_(map), most_(static_cast<std::int32_t>(std::floor(radius / map.cell))), wide_(map.columns + 2 * most_) {
        for (std::int32_t dy = 0; dy <= most_; ++dy) {
            std::int32_t half = most_;
            while (map.cell * std::sqrt(static_cast<double>(half) * half + static_cast<double>(dy) * dy) > radius)
                --half;
            halves_.push_back(half);
        }
        std::vector<float> row(static_cast<std::size_t>(wide_) * map.rows, no_surface);
        for (std::int32_t j = 0; j < map.rows; ++j) {
            std::copy_n(map.height.begin() + static_cast<std::ptrdiff_t>(j) * map.columns, map.columns,
                        row.begin() + static_cast<std::ptrdiff_t>(j) * wide_ + most_);
        }
        runs_.push_back(std::move(row));
        // A run that goes on into the next row is not asked.
        for (std::size_t length = 1; 2 * length <= 2 * static_cast<std::size_t>(most_) + 1; length *= 2) {
            std::vector<float> longer = runs_.back();
            for (std::size_t i = 0; i + length < longer.size(); ++i) {
                longer[i] = std::max(longer[i], runs_.back()[i + length]);
            }
            runs_.push_back(std::move(longer));
        }
    }

    std::vector<float> result(const CellBlocks& asked) const {
        std::vector<float> result(map_.height.size(), no_surface);
        parallel_for(0, static_cast<std::size_t>(map_.rows), [&](std::size_t j) {
            for (std::int32_t c = 0; c < map_.columns; c += CellBlocks::wide) {
                if (!asked.has(c, static_cast<std::int32_t>(j))) continue;
                float* own = result.data() + static_cast<std::ptrdiff_t>(j) * map_.columns + c;
                stretch(static_cast<std::int32_t>(j), c, std::min(CellBlocks::wide, map_.columns - c), own);
            }
        });
        return result;
    }

 private:
    void stretch(std::int32_t j, std::int32_t column, std::int32_t count, float* own) const {
        const std::int32_t last = std::min(map_.rows - 1, j + most_);
        for (std::int32_t from = std::max(0, j - most_); from <= last; ++from) {
            const std::int32_t half = halves_[static_cast<std::size_t>(std::abs(from - j))];
            const int power = std::bit_width(static_cast<std::uint32_t>(2 * half + 1)) - 1;
            const float* first = runs_[static_cast<std::size_t>(power)].data() +
                                 static_cast<std::ptrdiff_t>(from) * wide_ + column + most_ - half;
            const float* second = first + 2 * half + 1 - (std::ptrdiff_t{1} << power);
            for (std::int32_t i = 0; i < count; ++i) {
                const float highest = first[i] > second[i] ? first[i] : second[i];
                own[i] = own[i] > highest ? own[i] : highest;
            }
        }
    }

    const SurfaceMap& map_;
    std::int32_t most_;                     // cells from the axis to the rim
    std::int32_t wide_;                     // of a row with as many cells before and after it
    std::vector<std::int32_t> halves_;      // of the chord of each row from the axis: cells beside the middle
    std::vector<std::vector<float>> runs_;  // by the power of two that is their length: the highest from a cell on
};

}  // namespace

CellBlocks::CellBlocks(const SurfaceMap& map)
    : columns_((map.columns + wide - 1) / wide), rows_((map.rows + high - 1) / high) {
    is_in_.assign(static_cast<std::size_t>(columns_) * rows_, 0);
}

CellBlocks CellBlocks::all_of(const SurfaceMap& map) {
    CellBlocks all(map);
    std::fill(all.is_in_.begin(), all.is_in_.end(), std::uint8_t{1});
    return all;
}

void CellBlocks::add(CellRange cells) {
    const std::int32_t x_end = std::min(cells.x_end, columns_ * wide);
    const std::int32_t y_end = std::min(cells.y_end, rows_ * high);
    for (std::int32_t r = std::max(0, cells.y_begin) / high; r * high < y_end; ++r) {
        for (std::int32_t c = std::max(0, cells.x_begin) / wide; c * wide < x_end; ++c) {
            is_in_[static_cast<std::size_t>(r) * columns_ + c] = 1;
        }
    }
}

CellBlocks CellBlocks::grown(std::int32_t cells) const {
    CellBlocks all = *this;
    for (std::int32_t r = 0; r < rows_; ++r) {
        for (std::int32_t c = 0; c < columns_; ++c) {
            if (is_in_[static_cast<std::size_t>(r) * columns_ + c] == 0) continue;
            all.add({c * wide - cells, (c + 1) * wide + cells, r * high - cells, (r + 1) * high + cells});
        }
    }
    return all;
}

std::vector<float> dilated(const SurfaceMap& map, const Cutter& cutter, const CellBlocks& asked) {
    if (cutter.shape == ToolShape::flat) return FlatDilation(map, cutter.radius).result(asked);
    return Morph<Dilation>(map, taps_of(cutter, map.cell)).result(asked);
}

std::vector<float> eroded(const SurfaceMap& map, const Cutter& cutter, const CellBlocks& asked) {
    return Morph<Erosion>(map, taps_of(cutter, map.cell)).result(asked);
}

}  // namespace qchopper
