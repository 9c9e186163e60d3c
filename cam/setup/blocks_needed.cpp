// Every block in all orders in which it can stand, each shortened to what the cell holds where it can be sawn.

#include "cam/setup/blocks_needed.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "cam/setup/block.h"
#include "cam/setup/holder_clearance.h"
#include "cam/setup/stock_fit.h"
#include "segment/mesh/boxes_needed.h"

namespace qchopper {
namespace {

constexpr double rounding = 1e-6;  // mm, as in block.cpp and stock_fit.cpp

bool is_within(Vec3 a, Vec3 b) {
    return a.x <= b.x + rounding && a.y <= b.y + rounding && a.z <= b.z + rounding;
}

// The longest to which a length can be sawn: whole mm, and more than the saw cut is left over, as choose_block() does.
double sawn(double length, double most, double kerf) {
    if (length <= most + rounding) return length;
    return std::min(std::floor(most + rounding), std::ceil(length - kerf) - 1);
}

// As it may stand: a sawn block in every order of its axes, else with its height up.
std::vector<Vec3> standing(const Stock& stock, Vec3 most) {
    const Vec3 s = stock.size;
    if (!stock.is_sawn) return {s, {s.y, s.x, s.z}};
    std::vector<Vec3> all;
    std::array<double, 3> order{s.x, s.y, s.z};
    std::sort(order.begin(), order.end());
    do {
        all.push_back({sawn(order[0], most.x, stock.kerf), sawn(order[1], most.y, stock.kerf),
                       sawn(order[2], most.z, stock.kerf)});
    } while (std::next_permutation(order.begin(), order.end()));
    return all;
}

// Those of usable_blocks() that are no larger than `most`.
std::vector<Vec3> usable_blocks(const Cell& cell, Vec3 most) {
    const Margins margins = margins_of(cell);
    const Vec3 foam{2 * margins.sides, 2 * margins.sides, margins.top + margins.spoil};
    std::vector<Vec3> usable;
    for (const Stock& stock : cell.stock) {
        for (const Vec3 block : standing(stock, most)) {
            const Vec3 size = block - foam;
            const auto holds = [&](Vec3 other) { return boxes_needed(size, other) <= 1; };
            if (!is_within(block, most) || std::min({size.x, size.y, size.z}) <= 0) continue;
            if (std::any_of(usable.begin(), usable.end(), holds)) continue;
            std::erase_if(usable, [&](Vec3 other) { return boxes_needed(other, size) <= 1; });
            usable.push_back(size);
        }
    }
    return usable;
}

}  // namespace

std::vector<Vec3> usable_blocks(const Cell& cell) {
    return usable_blocks(cell, largest_block(cell));
}

double low_piece_height(const Cell& cell) {
    if (!cell.machine) return std::numeric_limits<double>::infinity();
    const Margins margins = margins_of(cell);
    return longest_tool(cell.machine->tools).stick_out - margins.top - margins.spoil;
}

std::vector<Vec3> low_usable_blocks(const Cell& cell) {
    Vec3 most = largest_block(cell);
    if (cell.machine) most.z = std::min(most.z, longest_tool(cell.machine->tools).stick_out);
    return usable_blocks(cell, most);
}

double blocks_needed(std::span<const Vec3> usable, Vec3 size) {
    double fewest = std::numeric_limits<double>::infinity();
    for (const Vec3 block : usable) fewest = std::min(fewest, boxes_needed(size, block));
    return fewest;
}

}  // namespace qchopper
