// Where a cell lies is asked of maps without content. O(cells).

#include "sim/replay/stages/coarser_stock.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>
#include <utility>

#include "sim/replay/stock/dexel_map.h"

namespace qchopper {
namespace {

constexpr std::int32_t side = DexelTile::side;

// The heights of a map of a record, by the place of a point.
class HeightsAt {
 public:
    HeightsAt(const StockMap& stock, const Box& block, double cell) : map_(block, stock.tool_axis, cell) {
        for (const StockTile& tile : stock.tiles) tiles_[{tile.tx, tile.ty}] = &tile;
    }
    std::int32_t at(double x, double y) const {
        const auto index = [&](double to_first) {
            return static_cast<std::int32_t>(std::floor(to_first / map_.cell() + 0.5));
        };
        const std::int32_t i = std::max(0, index(x - map_.centre_x(0)));
        const std::int32_t j = std::max(0, index(y - map_.centre_y(0)));
        const auto tile = tiles_.find({i / side, j / side});
        if (tile == tiles_.end()) return StockTile::not_cut;
        return tile->second->height[static_cast<std::size_t>(j % side) * side + static_cast<std::size_t>(i % side)];
    }
    std::int32_t largest_about(double x, double y) const {
        const double half = 0.5 * map_.cell();
        return std::max(std::max(at(x - half, y - half), at(x + half, y - half)),
                        std::max(at(x - half, y + half), at(x + half, y + half)));
    }

 private:
    DexelMap map_;
    std::map<std::pair<std::int32_t, std::int32_t>, const StockTile*> tiles_;
};

StockMap coarser_map(const StockMap& stock, const Box& block, double from_cell, double cell) {
    const HeightsAt heights(stock, block, from_cell);
    const DexelMap place(block, stock.tool_axis, cell);
    StockMap result{stock.tool_axis, {}};
    for (std::int32_t ty = 0; ty < place.tiles_y(); ++ty) {
        for (std::int32_t tx = 0; tx < place.tiles_x(); ++tx) {
            StockTile tile{tx, ty, {}};
            tile.height.reserve(DexelTile::cells);
            for (std::int32_t j = ty * side; j < (ty + 1) * side; ++j) {
                for (std::int32_t i = tx * side; i < (tx + 1) * side; ++i) {
                    tile.height.push_back(heights.largest_about(place.centre_x(i), place.centre_y(j)));
                }
            }
            const auto is_cut = [](std::int32_t height) { return height != StockTile::not_cut; };
            if (std::any_of(tile.height.begin(), tile.height.end(), is_cut)) result.tiles.push_back(std::move(tile));
        }
    }
    return result;
}

}  // namespace

StockRecord coarser(const StockRecord& stock, double cell) {
    assert(cell >= stock.cell);
    StockRecord result{stock.block, cell, stock.tools, {}};
    for (const StockMap& map : stock.maps) {
        result.maps.push_back(coarser_map(map, stock.block, stock.cell, cell));
    }
    return result;
}

}  // namespace qchopper
