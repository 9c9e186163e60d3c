// The foam on the centres of the cells of one direction, while that direction is milled: columns of intervals.
//
// mm, in the frame of the direction. Foam only ever becomes less, so that a column of earlier is never too short: it
// is kept, and what the other directions have taken from it since is subtracted only where a tool comes, and only from
// there up (DexelTile::known_from), of the directions that may have taken something from a square of columns there;
// what one of them has taken from all of the square goes at once, from all of its columns (DexelTile::Slab). O(cells of
// those maps along that part of the column) (tests/sim/replay/stock/stock_model_test.cpp).

#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "base/pose.h"
#include "sim/replay/stock/dexel.h"
#include "sim/replay/stock/dexel_map.h"

namespace qchopper {

// A cell of a tile; tile and cell count from 0, cells row by row.
struct TileCell {
    std::int32_t tx = 0;
    std::int32_t ty = 0;
    std::size_t cell = 0;
};

struct ColumnRemoval {
    double length = 0;
    double top = 0;  // of the highest foam
};

class DexelColumns {
 public:
    // The maps must not move while this lives.
    DexelColumns(const std::vector<std::unique_ptr<DexelMap>>& maps, std::size_t orientation);

    // To be called after other directions may have been milled: nothing is known of their removals then.
    void begin();
    // Gives back the memory of what is known of other directions: when another one is milled. O(tiles).
    void leave();
    // And that of the columns, which are made again if this direction is milled again. O(tiles).
    void end();
    // A tile with columns, not yet known.
    DexelTile& tile(std::int32_t tx, std::int32_t ty);
    // Makes the column be what is left of the foam, from a height up.
    void know(DexelTile& tile, TileCell at, double from_up) {
        if (from_up < tile.known_from[at.cell]) know_more(tile, at, from_up);
    }
    // Removes what is above z. Precondition: the column is known from z up.
    static ColumnRemoval lower(DexelTile& tile, std::size_t cell, float z) {
        const double top = tile.high[cell];
        if (!(tile.low[cell] < z)) return lower_through(tile, cell, z);
        if (!(z < top)) return {0, top};
        tile.high[cell] = z;
        return {top - z, top};
    }

 private:
    struct OtherMap {
        const DexelMap* map = nullptr;
        Pose own_in_other;
        MapLine column;         // through the origin
        std::uint16_t bit = 0;  // in DexelTile::Slab
    };
    void make(DexelTile& tile, std::int32_t tx, std::int32_t ty) const;
    using Maps = std::uint16_t;  // a bit for each of the other maps, as in DexelTile::Slab
    // Of a slab, what DexelTile::Slab says of a square.
    struct Met {
        Maps maps = 0;
        bool is_removed = false;
        bool operator==(const Met&) const = default;
    };
    static ColumnRemoval lower_through(DexelTile& tile, std::size_t cell, double z);
    void know_more(DexelTile& tile, TileCell at, double from_up);
    // Makes all columns of the square of a cell known from a height up, as far down as whole slabs can tell.
    void know_square(DexelTile& tile, TileCell at, double from_up);
    std::size_t slab_of(double z, std::size_t count) const;
    double top_of_slab(std::size_t slab) const { return own_->top - static_cast<double>(slab) * slab_; }
    // Of the square of a cell.
    Met ask_slab(DexelTile& tile, TileCell at, std::size_t slab);
    // Of the slabs from one to before another, into met_; of all of them together.
    Met ask_slabs(DexelTile& tile, TileCell at, std::size_t first, std::size_t end);
    Met met_in_slab(TileCell at, std::size_t slab) const;
    // Heights of slabs of met_, of which the first one is that slab of a tile, in the part to subtract from.
    Dexel part_in(std::size_t first, std::size_t begin, std::size_t end) const;
    void subtract_removed(std::size_t first);
    void subtract_others(TileCell at, std::size_t first, Maps met);
    void write(DexelTile& tile, std::size_t cell);

    DexelMap* own_;
    double slab_ = 0;  // mm
    std::vector<OtherMap> others_;
    std::uint64_t version_ = 0;
    // Of the slabs of the column that is being made known, from the top down.
    std::vector<Met> met_;
    // Of that column, ascending: all of it, and the part to subtract from.
    std::vector<Dexel> column_;
    std::vector<Dexel> part_;
    std::vector<Dexel> upper_;
};

}  // namespace qchopper
