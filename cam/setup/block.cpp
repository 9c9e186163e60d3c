// Every block of the list is tried, whole in two turns and sawn in six, O(stock).

#include "cam/setup/block.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <optional>
#include <tuple>

namespace qchopper {
namespace {

// mm3 more in a block that needs no saw cut are worth the cut: to mill them takes a robot about an hour, at the rate
// measured over the programs of docs/measurements/performance.md.
constexpr double foam_for_a_saw_cut = 20e6;

constexpr double rounding = 1e-6;      // mm
constexpr double above_the_table = 2;  // mm of foam that no tool cuts, under the deepest one

using Lengths = std::array<double, 3>;

constexpr std::array<std::array<std::size_t, 3>, 6> orders{
    {{0, 1, 2}, {1, 0, 2}, {0, 2, 1}, {2, 0, 1}, {1, 2, 0}, {2, 1, 0}}};

Lengths lengths(Vec3 v) {
    return {v.x, v.y, v.z};
}

double volume(Vec3 v) {
    return v.x * v.y * v.z;
}

// What the block lacks along the worst axis; 0 if it holds the size.
double lack(Vec3 needed, Vec3 block) {
    const Vec3 missing = needed - block;
    const double most = std::max({missing.x, missing.y, missing.z});
    return most <= rounding ? 0 : most;
}

// Up to three cuts, each through all that is left beside the block, in the given order of the axes.
std::vector<Vec3> offcuts_of(Lengths stock, const Lengths& block, double kerf,
                             const std::array<std::size_t, 3>& order) {
    std::vector<Vec3> offcuts;
    for (const std::size_t axis : order) {
        if (stock[axis] == block[axis]) continue;
        Lengths offcut = stock;
        offcut[axis] = stock[axis] - block[axis] - kerf;
        offcuts.push_back({offcut[0], offcut[1], offcut[2]});
        stock[axis] = block[axis];
    }
    const auto is_larger = [](Vec3 a, Vec3 b) { return volume(a) > volume(b); };
    std::stable_sort(offcuts.begin(), offcuts.end(), is_larger);
    return offcuts;
}

// Nothing is sawn off where the rest would be no wider than the saw cut.
Lengths sawn_to(const Lengths& needed, const Lengths& stock, double kerf) {
    Lengths size{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double whole = std::ceil(needed[axis] - rounding);
        size[axis] = stock[axis] - whole > kerf ? whole : stock[axis];
    }
    return size;
}

// Nothing sawn off is best, then the largest offcut.
bool leaves_more(const std::vector<Vec3>& offcuts, const std::vector<Vec3>& other) {
    if (offcuts.empty() || other.empty()) return offcuts.empty() && !other.empty();
    return volume(offcuts.front()) > volume(other.front());
}

// Nothing if no orientation of the stock holds the size.
std::optional<StockBlock> sawn(const Stock& stock, Vec3 needed) {
    std::optional<StockBlock> best;
    for (const auto& turn : orders) {
        const Lengths listed = lengths(stock.size);
        const Lengths as_it_stands{listed[turn[0]], listed[turn[1]], listed[turn[2]]};
        if (lack(needed, {as_it_stands[0], as_it_stands[1], as_it_stands[2]}) > 0) continue;
        const Lengths size = sawn_to(lengths(needed), as_it_stands, stock.kerf);
        for (const auto& order : orders) {
            std::vector<Vec3> offcuts = offcuts_of(as_it_stands, size, stock.kerf, order);
            if (best && !leaves_more(offcuts, best->offcuts)) continue;
            best = StockBlock{0, false, true, {size[0], size[1], size[2]}, true, std::move(offcuts)};
        }
    }
    return best;
}

double depth_under_the_base(const CuttingTool& tool) {
    return tool.corner_radius;
}

}  // namespace

Margins margins_of(const Cell& cell) {
    Margins margins = cell.margins;
    if (!cell.machine) return margins;
    for (const CuttingTool& tool : cell.machine->tools) {
        margins.spoil = std::max(margins.spoil, depth_under_the_base(tool) + above_the_table);
    }
    return margins;
}

StockBlock choose_block(const Cell& cell, Vec3 piece_size) {
    assert(!cell.stock.empty());
    const Margins margins = margins_of(cell);
    const Vec3 needed = piece_size + Vec3{2 * margins.sides, 2 * margins.sides, margins.top + margins.spoil};
    StockBlock best;
    std::optional<std::tuple<double, double, bool>> least;
    const auto consider = [&](StockBlock block, double lacks) {
        const bool needs_saw = !block.offcuts.empty();
        const std::tuple key(lacks, volume(block.size) + (needs_saw ? foam_for_a_saw_cut : 0), needs_saw);
        if (least && !(key < *least)) return;
        least = key;
        block.holds = lacks == 0;
        best = std::move(block);
    };
    for (std::size_t i = 0; i < cell.stock.size(); ++i) {
        std::optional<StockBlock> smaller = cell.stock[i].is_sawn ? sawn(cell.stock[i], needed) : std::nullopt;
        if (!smaller || smaller->offcuts.empty()) {
            const Vec3 size = cell.stock[i].size;
            consider({i, false, false, size, true, {}}, lack(needed, size));
            const Vec3 turned{size.y, size.x, size.z};
            consider({i, true, false, turned, true, {}}, lack(needed, turned));
        }
        if (!smaller) continue;
        smaller->stock = i;
        consider(std::move(*smaller), 0);
    }
    return best;
}

}  // namespace qchopper
