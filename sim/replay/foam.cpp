// Cells under the swept tool, row by row; the height at a cell is that of cutter.h. Volumes are sums over cells in a
// fixed order.

#include "sim/replay/foam.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "sim/replay/foam_map.h"

namespace qchopper {
namespace {

constexpr double contact_mm = 0.01;
constexpr std::int32_t side = FoamTile::side;
constexpr std::int32_t square = 16;  // cells of FoamTile::top

std::size_t square_of(std::size_t cell) {
    const std::size_t x = cell % side / square;
    const std::size_t y = cell / side / square;
    return y * (side / square) + x;
}

// The columns of a tile, made of the block and all maps.
void make_columns(const std::vector<std::unique_ptr<FoamMap>>& maps, std::size_t direction, std::int32_t tx,
                  std::int32_t ty, FoamTile& tile) {
    const FoamMap& own = *maps[direction];
    tile.low.assign(FoamTile::cells, 0);
    tile.high.assign(FoamTile::cells, 0);
    tile.below.clear();
    tile.top.fill(-std::numeric_limits<float>::infinity());
    std::vector<Interval> foam;
    for (std::size_t cell = 0; cell < FoamTile::cells; ++cell) {
        const Vec3 from{own.middle_x(tx * side + static_cast<std::int32_t>(cell % side)),
                        own.middle_y(ty * side + static_cast<std::int32_t>(cell / side)), 0};
        const Interval whole = own.block_on(from, {0, 0, 1});
        foam.clear();
        const double high = std::min<double>(whole.high, tile.cut[cell]);
        if (whole.low < high) foam.push_back({whole.low, high});
        const Vec3 in_block = apply(own.frame_in_block, from);
        const Vec3 along = rotate(own.frame_in_block, {0, 0, 1});
        for (std::size_t other = 0; other < maps.size() && !foam.empty(); ++other) {
            if (other == direction) continue;
            const Pose& frame = maps[other]->frame_in_block;
            maps[other]->remove_from(foam, apply_inverse(frame, in_block), rotate_inverse(frame, along));
        }
        if (foam.empty()) continue;
        for (std::size_t i = 0; i + 1 < foam.size(); ++i) {
            tile.below.push_back(
                {static_cast<std::uint32_t>(cell), static_cast<float>(foam[i].low), static_cast<float>(foam[i].high)});
        }
        tile.low[cell] = static_cast<float>(foam.back().low);
        tile.high[cell] = static_cast<float>(foam.back().high);
        float& top = tile.top[square_of(cell)];
        top = std::max(top, tile.high[cell]);
    }
}

// The next interval below of a column becomes its highest.
void raise_next(FoamTile& tile, std::size_t cell) {
    const auto is_before = [](const FoamTile::Below& b, std::uint32_t c) { return b.cell < c; };
    const auto number = static_cast<std::uint32_t>(cell);
    auto end = std::lower_bound(tile.below.begin(), tile.below.end(), number + 1, is_before);
    while (end != tile.below.begin() && (end - 1)->cell == number && (end - 1)->low >= (end - 1)->high) --end;
    if (end == tile.below.begin() || (end - 1)->cell != number) {
        tile.low[cell] = tile.high[cell] = 0;
        return;
    }
    FoamTile::Below& next = *(end - 1);
    tile.low[cell] = next.low;
    tile.high[cell] = next.high;
    next.low = next.high = 0;
}

struct Removal {
    double length = 0;
    double top = 0;  // of the highest foam
};

Removal lower_column(FoamTile& tile, std::size_t cell, double z) {
    Removal removal{0, tile.high[cell]};
    while (tile.low[cell] < tile.high[cell] && tile.high[cell] > z) {
        const double low = std::max<double>(tile.low[cell], z);
        removal.length += tile.high[cell] - low;
        tile.high[cell] = static_cast<float>(low);
        if (tile.high[cell] > tile.low[cell]) break;
        raise_next(tile, cell);
    }
    return removal;
}

}  // namespace

Pose direction_frame(Vec3 out) {
    if (std::hypot(out.x, out.y) < 1e-9 && out.z > 0) return {};
    const Vec3 beside = std::abs(out.x) < 0.9 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
    const Vec3 y = normalized(cross(out, beside));
    const Vec3 x = cross(y, out);
    return {{Vec3{x.x, y.x, out.x}, Vec3{x.y, y.y, out.y}, Vec3{x.z, y.z, out.z}}, {}};
}

Foam::Foam(const Box& block, const std::vector<Vec3>& outs, double cell) : block_(block), cell_(cell) {
    assert(cell > 0);
    for (const Vec3 out : outs) maps_.push_back(std::make_unique<FoamMap>(block, out, cell));
}

Foam::~Foam() = default;

const Pose& Foam::frame_in_block(std::size_t direction) const {
    return maps_[direction]->frame_in_block;
}

namespace {

// Calls work(tile, tx, ty) for the tiles of a range, with columns that are up to date.
template <class Work>
void for_tiles(const std::vector<std::unique_ptr<FoamMap>>& maps, std::size_t direction, const CellRange& cells,
               const Work& work) {
    FoamMap& map = *maps[direction];
    std::uint64_t version = 1;
    for (std::size_t other = 0; other < maps.size(); ++other) {
        if (other != direction) version += maps[other]->version;
    }
    for (std::int32_t ty = cells.y_begin / side; ty * side < cells.y_end; ++ty) {
        for (std::int32_t tx = cells.x_begin / side; tx * side < cells.x_end; ++tx) {
            FoamTile& tile = map.made_tile(tx, ty);
            if (tile.version != version) make_columns(maps, direction, tx, ty, tile);
            tile.version = version;
            work(tile, tx, ty);
        }
    }
}

}  // namespace

CutResult Foam::cut(std::size_t direction, const Cutter& cutter, Vec3 from, Vec3 to) {
    FoamMap& map = *maps_[direction];
    const Vec3 a = apply_inverse(map.frame_in_block, from);
    const Vec3 move = apply_inverse(map.frame_in_block, to) - a;
    const SweptCutter swept(cutter, move);
    const SweptCutter inner(inset_cutter(cutter, contact_mm), move);
    CutResult result;
    double length = 0;
    const double r = cutter.radius;
    const CellRange cells = map.range(std::min(a.x, a.x + move.x) - r, std::max(a.x, a.x + move.x) + r,
                                      std::min(a.y, a.y + move.y) - r, std::max(a.y, a.y + move.y) + r);
    for_tiles(maps_, direction, cells, [&](FoamTile& tile, std::int32_t tx, std::int32_t ty) {
        const std::int32_t y_end = std::min(cells.y_end - ty * side, side);
        for (std::int32_t j = std::max(0, cells.y_begin - ty * side); j < y_end; ++j) {
            const double y = map.middle_y(ty * side + j) - a.y;
            double x_min = 0;
            double x_max = 0;
            swept.reach_of_row(y, x_min, x_max);
            const CellRange row = map.range(x_min + a.x, x_max + a.x, 0, 0);
            const std::int32_t x_end = std::min(row.x_end - tx * side, side);
            for (std::int32_t i = std::max(0, row.x_begin - tx * side); i < x_end; ++i) {
                const double x = map.middle_x(tx * side + i) - a.x;
                const SweptCutter::Height at = swept.height(x, y);
                const double z = a.z + at.z;
                const auto cell = static_cast<std::size_t>(j * side + i);
                if (!(z < tile.cut[cell])) continue;
                tile.cut[cell] = static_cast<float>(z);
                tile.least_cut = std::min(tile.least_cut, static_cast<float>(z));
                if (!(tile.high[cell] > z && tile.low[cell] < tile.high[cell])) continue;
                const Removal removal = lower_column(tile, cell, z);
                length += removal.length;
                if (removal.length <= contact_mm) continue;
                const SweptCutter::Height inside = inner.height(x, y);
                if (!(a.z + contact_mm + inside.z < removal.top - contact_mm)) continue;
                result.touches = true;
                result.depth = std::max(result.depth, removal.top - (a.z + at.tip_z));
            }
        }
    });
    if (length > 0) ++map.version;
    result.volume = length * cell_ * cell_;
    return result;
}

double Foam::disc_contact(std::size_t direction, double radius, double above, Vec3 from, Vec3 to) {
    FoamMap& map = *maps_[direction];
    const Vec3 a = apply_inverse(map.frame_in_block, from) + Vec3{0, 0, above};
    const Vec3 move = apply_inverse(map.frame_in_block, to) + Vec3{0, 0, above} - a;
    const SweptCutter disc({ToolShape::flat, radius, 0, 0, 1}, move);
    const double least = a.z + std::min(0.0, move.z);
    if (least >= map.top) return 0;
    double worst = 0;
    const CellRange cells = map.range(std::min(a.x, a.x + move.x) - radius, std::max(a.x, a.x + move.x) + radius,
                                      std::min(a.y, a.y + move.y) - radius, std::max(a.y, a.y + move.y) + radius);
    for_tiles(maps_, direction, cells, [&](FoamTile& tile, std::int32_t tx, std::int32_t ty) {
        for (std::int32_t q = 0; q < square; ++q) {
            if (tile.top[static_cast<std::size_t>(q)] <= least + worst) continue;
            const std::int32_t x0 = q % 4 * square;
            const std::int32_t y0 = q / 4 * square;
            const std::int32_t x_end = std::min(cells.x_end - tx * side, x0 + square);
            const std::int32_t y_end = std::min(cells.y_end - ty * side, y0 + square);
            for (std::int32_t j = std::max(y0, cells.y_begin - ty * side); j < y_end; ++j) {
                for (std::int32_t i = std::max(x0, cells.x_begin - tx * side); i < x_end; ++i) {
                    const auto cell = static_cast<std::size_t>(j * side + i);
                    if (!(tile.low[cell] < tile.high[cell]) || tile.high[cell] <= least + worst) continue;
                    const SweptCutter::Height at =
                        disc.height(map.middle_x(tx * side + i) - a.x, map.middle_y(ty * side + j) - a.y);
                    worst = std::max(worst, tile.high[cell] - (a.z + at.z));
                }
            }
            // Nothing may have stood as high as was thought.
            float top = -std::numeric_limits<float>::infinity();
            for (std::int32_t j = y0; j < y0 + square; ++j) {
                for (std::int32_t i = x0; i < x0 + square; ++i) {
                    const auto cell = static_cast<std::size_t>(j * side + i);
                    if (tile.low[cell] < tile.high[cell]) top = std::max(top, tile.high[cell]);
                }
            }
            tile.top[static_cast<std::size_t>(q)] = top;
        }
    });
    return worst;
}

bool Foam::is_foam(Vec3 p) const {
    for (int axis = 0; axis < 3; ++axis) {
        if (p[axis] <= block_.min[axis] || p[axis] >= block_.max[axis]) return false;
    }
    for (const auto& map : maps_) {
        const Vec3 q = apply_inverse(map->frame_in_block, p);
        if (q.z > map->cut_at(q.x, q.y)) return false;
    }
    return true;
}

std::vector<Interval> Foam::on_line(Vec3 from, Vec3 along, double low, double high) const {
    const FoamMap& first = *maps_.front();
    const Interval inside =
        first.block_on(apply_inverse(first.frame_in_block, from), rotate_inverse(first.frame_in_block, along));
    std::vector<Interval> foam;
    if (std::max(low, inside.low) < std::min(high, inside.high)) {
        foam.push_back({std::max(low, inside.low), std::min(high, inside.high)});
    }
    for (const auto& map : maps_) {
        map->remove_from(foam, apply_inverse(map->frame_in_block, from), rotate_inverse(map->frame_in_block, along));
    }
    return foam;
}

double Foam::distance_to_removed(Vec3 p, double most) const {
    double best = most;
    for (const double side_distance :
         {p.x - block_.min.x, block_.max.x - p.x, p.y - block_.min.y, block_.max.y - p.y, block_.max.z - p.z}) {
        best = std::min(best, std::max(0.0, side_distance));
    }
    for (const auto& map : maps_) {
        best = std::min(best, map->distance_to_removed(apply_inverse(map->frame_in_block, p), best));
    }
    return best;
}

}  // namespace qchopper
