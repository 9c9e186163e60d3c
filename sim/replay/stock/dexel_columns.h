// The foam on the centres of the cells of one direction, while that direction is milled: columns of intervals.
//
// mm, in the frame of the direction. Foam only ever becomes less, so that a column of earlier is never too short: it
// is kept, and what the other directions have taken from it since is subtracted only where a tool comes, and only from
// there up (DexelTile::known_from), of the directions that may have taken something from a square of columns there
// (DexelTile::Slab). O(cells of those maps along that part of the column)
// (tests/sim/replay/stock/stock_model_test.cpp).

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
    // A tile with columns, not yet known.
    DexelTile& tile(std::int32_t tx, std::int32_t ty);
    // Makes the column be what is left of the foam, from a height up.
    void know(DexelTile& tile, TileCell at, double from_up);
    // Removes what is above z. Precondition: the column is known from z up.
    static ColumnRemoval lower(DexelTile& tile, std::size_t cell, double z);

 private:
    struct OtherMap {
        const DexelMap* map = nullptr;
        Pose own_in_other;
        Vec3 along;             // of the columns
        std::uint16_t bit = 0;  // in DexelTile::Slab
    };
    void make(DexelTile& tile, std::int32_t tx, std::int32_t ty) const;
    using Maps = std::uint16_t;  // a bit for each of the other maps, as in DexelTile::Slab
    // Which of them may have removed something from a part of a column, and between which heights.
    struct Met {
        Maps maps = 0;
        double low = 0;
        double high = 0;
    };
    Met met_between(DexelTile& tile, TileCell at, double low, double high) const;
    Maps met_in_slab(TileCell at, std::size_t slab) const;
    void subtract_others(TileCell at, Maps met);
    void write(DexelTile& tile, std::size_t cell);

    DexelMap* own_;
    double slab_ = 0;  // mm
    std::vector<OtherMap> others_;
    std::uint64_t version_ = 0;
    // Of the column that is being made known, ascending: all of it, and the part to subtract from.
    std::vector<Dexel> column_;
    std::vector<Dexel> part_;
    std::vector<Dexel> upper_;
};

}  // namespace qchopper
