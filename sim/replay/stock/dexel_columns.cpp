// Columns of intervals after T. Van Hook: Real-Time Shaded NC Milling Display, 1986. Subtraction from a part of a
// column is that of the whole, because removals are unions of intervals. Intervals that are empty in single precision
// are left out. O(intervals + cells of the other maps along the part).

#include "sim/replay/stock/dexel_columns.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace qchopper {
namespace {

constexpr std::int32_t side = DexelTile::side;
constexpr double rounding = 1e-3;  // mm, generous
constexpr float infinite = std::numeric_limits<float>::infinity();
// mm below what was asked for that is made known with it: a tool that comes deeper in short moves finds it done.
constexpr double known_below = 8;

struct BelowRange {
    std::vector<DexelTile::Below>::iterator begin;
    std::vector<DexelTile::Below>::iterator end;
};

std::size_t square_of(TileCell at) {
    return DexelTile::square_of_cut(static_cast<std::int32_t>(at.cell % side),
                                    static_cast<std::int32_t>(at.cell / side));
}

BelowRange below_of(std::vector<DexelTile::Below>& row, std::size_t cell) {
    const auto is_before = [](const DexelTile::Below& b, std::uint32_t c) { return b.cell < c; };
    const auto number = static_cast<std::uint32_t>(cell);
    return {std::lower_bound(row.begin(), row.end(), number, is_before),
            std::lower_bound(row.begin(), row.end(), number + 1, is_before)};
}

// The next interval below of a column becomes its highest.
void raise_next(DexelTile& tile, std::size_t cell) {
    std::vector<DexelTile::Below>& row = tile.below[cell / side];
    const BelowRange range = below_of(row, cell);
    if (range.begin == range.end) {
        tile.low[cell] = tile.high[cell] = 0;
        return;
    }
    const auto next = range.end - 1;
    tile.low[cell] = next->low;
    tile.high[cell] = next->high;
    row.erase(next);
}

float rounded_up(double z) {
    const auto nearest = static_cast<float>(z);
    return nearest < z ? std::nextafter(nearest, infinite) : nearest;
}

void add_part(std::vector<Dexel>& parts, double low, double high) {
    if (low < high) parts.push_back({low, high});
}

// Takes what lies between two heights from intervals.
void subtract(std::vector<Dexel>& intervals, const Dexel& part) {
    for (std::size_t k = intervals.size(); k-- > 0;) {
        const Dexel own = intervals[k];
        if (own.high <= part.low) return;
        if (own.low >= part.high) continue;
        const auto at = intervals.begin() + static_cast<std::ptrdiff_t>(k);
        if (own.low < part.low && part.high < own.high) {
            *at = {part.high, own.high};
            intervals.insert(at, {own.low, part.low});
        } else if (own.low < part.low) {
            at->high = part.low;
        } else if (part.high < own.high) {
            at->low = part.high;
        } else {
            intervals.erase(at);
        }
    }
}

// Appends intervals; the first continues the last one before if it begins where that ends.
void append(std::vector<Dexel>& column, const std::vector<Dexel>& parts) {
    for (const Dexel& part : parts) {
        if (!(static_cast<float>(part.low) < static_cast<float>(part.high))) continue;
        if (!column.empty() && column.back().high == part.low) {
            column.back().high = part.high;
        } else {
            column.push_back(part);
        }
    }
}

// What a map has removed from a box of another frame.
DexelMap::Removed removed_in(const DexelMap& map, const Pose& box_in_map, const Box& box) {
    const Vec3 middle = apply(box_in_map, 0.5 * (box.min + box.max));
    const Vec3 half = 0.5 * (box.max - box.min);
    const Vec3 x = rotate(box_in_map, {half.x, 0, 0});
    const Vec3 y = rotate(box_in_map, {0, half.y, 0});
    const Vec3 z = rotate(box_in_map, {0, 0, half.z});
    const double wide = std::abs(x.x) + std::abs(y.x) + std::abs(z.x) + rounding;
    const double deep = std::abs(x.y) + std::abs(y.y) + std::abs(z.y) + rounding;
    const double high = std::abs(x.z) + std::abs(y.z) + std::abs(z.z) + rounding;
    return map.removed_in({middle.z - high, middle.z + high},
                          {middle.x - wide, middle.x + wide, middle.y - deep, middle.y + deep});
}

}  // namespace

DexelColumns::DexelColumns(const std::vector<std::unique_ptr<DexelMap>>& maps, std::size_t orientation)
    : own_(maps[orientation].get()), slab_(2 * DexelTile::square * own_->cell()) {
    for (std::size_t other = 0; other < maps.size(); ++other) {
        if (other == orientation) continue;
        const Pose in_other = inverse(maps[other]->frame_in_block) * own_->frame_in_block;
        others_.push_back(
            {maps[other].get(), in_other, {{}, rotate(in_other, {0, 0, 1})}, static_cast<Maps>(1U << other % 16)});
    }
}

void DexelColumns::begin() {
    version_ = 1;
    for (const OtherMap& other : others_) version_ += other.map->version;
}

void DexelColumns::leave() {
    for (const std::unique_ptr<DexelTile>& tile : own_->tiles()) {
        if (!tile || tile->version == 0) continue;
        tile->known_from = std::vector<float>();  // = {} would keep the memory
        tile->slabs = std::vector<DexelTile::Slab>();
        tile->version = DexelTile::nothing_known;
    }
}

void DexelColumns::end() {
    leave();
    for (const std::unique_ptr<DexelTile>& tile : own_->tiles()) {
        if (!tile) continue;
        tile->low = std::vector<float>();
        tile->high = std::vector<float>();
        for (std::vector<DexelTile::Below>& row : tile->below) row = std::vector<DexelTile::Below>();
        tile->version = 0;
    }
}

DexelTile& DexelColumns::tile(std::int32_t tx, std::int32_t ty) {
    DexelTile& tile = own_->made_tile(tx, ty);
    if (tile.version == version_) return tile;
    if (tile.version == 0) make(tile, tx, ty);
    tile.known_from.assign(DexelTile::cells, infinite);
    tile.slabs.assign(static_cast<std::size_t>((own_->top - own_->bottom) / slab_) + 1, {});
    tile.descents.fill({});
    tile.version = version_;
    return tile;
}

// The columns of the block.
void DexelColumns::make(DexelTile& tile, std::int32_t tx, std::int32_t ty) const {
    tile.low.assign(DexelTile::cells, 0);
    tile.high.assign(DexelTile::cells, 0);
    tile.top.fill(-infinite);
    for (std::size_t cell = 0; cell < DexelTile::cells; ++cell) {
        const auto x = static_cast<std::int32_t>(cell % side);
        const auto y = static_cast<std::int32_t>(cell / side);
        const Dexel whole =
            own_->block_on({own_->centre_x(tx * side + x), own_->centre_y(ty * side + y), 0}, {0, 0, 1});
        const double high = std::min<double>(whole.high, tile.cut[cell]);
        if (!(whole.low < high)) continue;
        tile.low[cell] = static_cast<float>(whole.low);
        tile.high[cell] = static_cast<float>(high);
        float& top = tile.top[DexelTile::top_of_cell(cell)];
        top = std::max(top, tile.high[cell]);
    }
}

std::size_t DexelColumns::slab_of(double z, std::size_t count) const {
    return static_cast<std::size_t>(std::clamp((own_->top - z) / slab_, 0.0, static_cast<double>(count - 1)));
}

DexelColumns::Met DexelColumns::ask_slab(DexelTile& tile, TileCell at, std::size_t slab) {
    const std::size_t square = square_of(at);
    const std::uint64_t own_bit = std::uint64_t{1} << square;
    DexelTile::Slab& asked = tile.slabs[slab];
    if ((asked.known & own_bit) == 0) {
        asked.known |= own_bit;
        const Met met = met_in_slab(at, slab);
        asked.met[square] = met.maps;
        if (met.is_removed) asked.removed |= own_bit;
    }
    return {asked.met[square], (asked.removed & own_bit) != 0};
}

DexelColumns::Met DexelColumns::ask_slabs(DexelTile& tile, TileCell at, std::size_t first, std::size_t end) {
    Met all;
    met_.clear();
    for (std::size_t k = first; k < end; ++k) {
        met_.push_back(ask_slab(tile, at, k));
        all.maps |= met_.back().maps;
        all.is_removed |= met_.back().is_removed;
    }
    return all;
}

// The box about the part of a square of columns, in the frame of another map.
DexelColumns::Met DexelColumns::met_in_slab(TileCell at, std::size_t slab) const {
    constexpr std::int32_t size = DexelTile::square;
    const auto x = static_cast<std::int32_t>(at.cell % side);
    const auto y = static_cast<std::int32_t>(at.cell / side);
    const double x_min = own_->centre_x(at.tx * side + x / size * size);
    const double y_min = own_->centre_y(at.ty * side + y / size * size);
    const double wide = (size - 1) * own_->cell();
    const double top = top_of_slab(slab);
    const Box columns{{x_min, y_min, top - slab_}, {x_min + wide, y_min + wide, top}};
    Met met;
    for (const OtherMap& other : others_) {
        const DexelMap::Removed removed = removed_in(*other.map, other.own_in_other, columns);
        if (removed == DexelMap::Removed::all) return {0, true};
        if (removed == DexelMap::Removed::some) met.maps |= other.bit;
    }
    return met;
}

// The slabs at the ends go on to those of the part: heights beyond the map's, and rounding.
Dexel DexelColumns::part_in(std::size_t first, std::size_t begin, std::size_t end) const {
    constexpr double far = std::numeric_limits<double>::infinity();
    return {end == met_.size() ? -far : top_of_slab(first + end), begin == 0 ? far : top_of_slab(first + begin)};
}

void DexelColumns::subtract_removed(std::size_t first) {
    for (std::size_t k = 0; k < met_.size(); ++k) {
        if (!met_[k].is_removed) continue;
        const std::size_t begin = k;
        while (k < met_.size() && met_[k].is_removed) ++k;
        subtract(part_, part_in(first, begin, k));
    }
}

void DexelColumns::subtract_others(TileCell at, std::size_t first, Maps met) {
    const auto x = static_cast<std::int32_t>(at.cell % side);
    const auto y = static_cast<std::int32_t>(at.cell / side);
    const Vec3 foot{own_->centre_x(at.tx * side + x), own_->centre_y(at.ty * side + y), 0};
    for (const OtherMap& other : others_) {
        if (part_.empty()) return;
        if ((met & other.bit) == 0) continue;
        MapLine column = other.column;
        column.from = apply(other.own_in_other, foot);
        for (std::size_t k = 0; k < met_.size(); ++k) {
            if ((met_[k].maps & other.bit) == 0) continue;
            const std::size_t begin = k;
            while (k < met_.size() && (met_[k].maps & other.bit) != 0) ++k;
            other.map->remove_from(part_, column, part_in(first, begin, k));
        }
    }
}

// Slabs that another map has removed, then slabs of which none has removed anything. What follows is asked cell by
// cell.
void DexelColumns::know_square(DexelTile& tile, TileCell at, double from_up) {
    constexpr std::size_t size = DexelTile::square;
    DexelTile::Descent& descent = tile.descents[square_of(at)];
    if (descent.is_ended) return;
    const std::size_t begin = at.cell / side / size * size * side + at.cell % side / size * size;
    if (!descent.is_begun) {
        descent = {slab_of(tile.highest_in(begin, size), tile.slabs.size()), true, false, false};
    }
    const std::size_t first = descent.slab;
    std::size_t removed = first;  // before it all is
    for (const std::size_t end = slab_of(from_up, tile.slabs.size()) + 1; descent.slab < end; ++descent.slab) {
        const Met met = ask_slab(tile, at, descent.slab);
        descent.is_in_foam |= met == Met{};
        descent.is_ended = descent.is_in_foam ? met != Met{} : !met.is_removed;
        if (descent.is_ended) break;
        if (met.is_removed) ++removed;
    }
    if (descent.slab == first) return;
    const auto cleared = static_cast<float>(top_of_slab(removed));
    const float known = rounded_up(top_of_slab(descent.slab));
    for (std::size_t j = 0; j < size; ++j) {
        for (std::size_t cell = begin + j * side; cell < begin + j * side + size; ++cell) {
            if (removed > first) lower(tile, cell, cleared);
            tile.known_from[cell] = std::min(tile.known_from[cell], known);
        }
    }
}

void DexelColumns::know_more(DexelTile& tile, TileCell at, double from_up) {
    const std::size_t cell = at.cell;
    know_square(tile, at, from_up - known_below);
    if (from_up >= tile.known_from[cell]) return;
    const float high = tile.known_from[cell];
    const auto low = static_cast<float>(from_up - known_below);
    tile.known_from[cell] = low;
    if (!(tile.low[cell] < tile.high[cell] && tile.high[cell] > low)) return;
    const std::size_t first = slab_of(std::min(high, tile.high[cell]), tile.slabs.size());
    const Met met = ask_slabs(tile, at, first, slab_of(low, tile.slabs.size()) + 1);
    if (met == Met{}) return;
    column_.clear();
    part_.clear();
    upper_.clear();
    const auto split = [&](float from, float to) {
        add_part(column_, from, std::min(to, low));
        add_part(part_, std::max(from, low), std::min(to, high));
        add_part(upper_, std::max(from, high), to);
    };
    const BelowRange below = below_of(tile.below[cell / side], cell);
    for (auto interval = below.begin; interval != below.end; ++interval) split(interval->low, interval->high);
    split(tile.low[cell], tile.high[cell]);
    if (met.is_removed) subtract_removed(first);
    if (met.maps != 0) subtract_others(at, first, met.maps);
    append(column_, part_);
    append(column_, upper_);
    write(tile, cell);
}

void DexelColumns::write(DexelTile& tile, std::size_t cell) {
    std::vector<DexelTile::Below>& row = tile.below[cell / side];
    const BelowRange old = below_of(row, cell);
    auto next = old.begin;
    for (std::size_t i = 0; i + 1 < column_.size(); ++i) {
        const DexelTile::Below interval{static_cast<std::uint32_t>(cell), static_cast<float>(column_[i].low),
                                        static_cast<float>(column_[i].high)};
        const auto end = below_of(row, cell).end;
        if (next != end) {
            *next++ = interval;
        } else {
            next = row.insert(next, interval) + 1;
        }
    }
    row.erase(next, below_of(row, cell).end);
    const Dexel top = column_.empty() ? Dexel{} : column_.back();
    tile.low[cell] = static_cast<float>(top.low);
    tile.high[cell] = static_cast<float>(top.high);
}

ColumnRemoval DexelColumns::lower_through(DexelTile& tile, std::size_t cell, double z) {
    ColumnRemoval removal{0, tile.high[cell]};
    while (tile.low[cell] < tile.high[cell] && tile.high[cell] > z) {
        const double low = std::max<double>(tile.low[cell], z);
        removal.length += tile.high[cell] - low;
        tile.high[cell] = static_cast<float>(low);
        if (tile.high[cell] > tile.low[cell]) break;
        raise_next(tile, cell);
    }
    return removal;
}

}  // namespace qchopper
