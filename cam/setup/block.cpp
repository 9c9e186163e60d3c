// Every block of the list is tried, whole in two turns and sawn in six, O(stock). Which faces are flush follows for
// each from its length, because a block that is too short for the saw cuts may still hold the piece with foam around
// it.

#include "cam/setup/block.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <optional>
#include <tuple>

#include "cam/setup/saw_cuts.h"

namespace qchopper {
namespace {

// mm3 more in a block that needs no saw cut are worth the cut: to mill them takes a robot about an hour, at the rate
// measured over the programs of docs/measurements/performance.md.
constexpr double foam_for_a_saw_cut = 20e6;

constexpr double rounding = 1e-6;      // mm
constexpr double steps_per_mm = 10;    // 1 / flush_step, exact, so that a size in tenths is written with one digit
constexpr double above_the_table = 2;  // mm of foam that no tool cuts, under the deepest one

AxisLengths lengths(Vec3 v) {
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

void clear_along(FlushFaces& flush, std::size_t axis) {
    if (axis == 2) {
        flush[4] = false;
    } else {
        flush[2 * axis] = flush[2 * axis + 1] = false;
    }
}

// Along an axis with flush faces, in steps of flush_step: never less than the piece, because a cell refuses a block
// that is smaller than what it is to hold, if only by a hundredth. Along z the spoil layer is the room for that.
double sawn_length(double needed, std::size_t axis) {
    const double steps = needed / flush_step;
    return (axis == 2 ? std::round(steps) : std::ceil(steps - rounding)) / steps_per_mm;
}

// Along an axis without a flush face nothing is sawn off where the rest would be no wider than the saw cut.
SawnLength whole_mm(double needed, double stock, double kerf) {
    const double whole = std::ceil(needed - rounding);
    return stock - whole > kerf ? SawnLength{whole, 1} : SawnLength{stock, 0};
}

// Nothing sawn off is best, then the largest offcut.
bool leaves_more(const std::vector<Vec3>& offcuts, const std::vector<Vec3>& other) {
    if (offcuts.empty() || other.empty()) return offcuts.empty() && !other.empty();
    return volume(offcuts.front()) > volume(other.front());
}

// What is sought, for all stock.
struct Wanted {
    Vec3 piece;
    Margins margins;
    std::array<double, block_faces> caps_mm2{};
    FlushFaces flush() const {
        FlushFaces faces{};
        for (std::size_t f = 0; f < block_faces; ++f) faces[f] = caps_mm2[f] > 0;
        return faces;
    }
    double milled_mm2(const FlushFaces& flush) const {
        double area = 0;
        for (std::size_t f = 0; f < block_faces; ++f) area += flush[f] ? 0 : caps_mm2[f];
        return area;
    }
};

// The size to which a stock as it stands is sawn, and in `flush` the faces that are flush then; nothing if it does not
// hold the piece.
std::optional<SawnSize> sawn_to(const Wanted& wanted, const AxisLengths& stock, double kerf, FlushFaces& flush) {
    flush = wanted.flush();
    SawnSize size{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::size_t faces = sawn_along(flush, axis);
        const double needed = lengths(size_with_foam(wanted.piece, wanted.margins, flush))[axis];
        const double sawn = sawn_length(needed, axis);
        if (faces > 0 && sawn + static_cast<double>(faces) * kerf <= stock[axis] + rounding) {
            size[axis] = {sawn, static_cast<int>(faces)};
            continue;
        }
        clear_along(flush, axis);
        const double with_foam = lengths(size_with_foam(wanted.piece, wanted.margins, flush))[axis];
        if (with_foam - stock[axis] > rounding) return std::nullopt;
        size[axis] = whole_mm(with_foam, stock[axis], kerf);
    }
    return size;
}

// Nothing if no orientation of the stock holds the size. Of orientations that leave fewer caps to mill is that taken.
std::optional<FlushBlock> sawn(const Stock& stock, const Wanted& wanted) {
    std::optional<FlushBlock> best;
    for (const auto& turn : axis_orders) {
        const AxisLengths listed = lengths(stock.size);
        const AxisLengths as_it_stands{listed[turn[0]], listed[turn[1]], listed[turn[2]]};
        FlushFaces flush{};
        const std::optional<SawnSize> size = sawn_to(wanted, as_it_stands, stock.kerf, flush);
        if (!size) continue;
        const double milled = wanted.milled_mm2(flush);
        for (const auto& order : axis_orders) {
            if (!is_sawn_last(order, flush)) continue;
            std::vector<Vec3> offcuts = offcuts_of(cuts_in(order, as_it_stands, *size, stock.kerf));
            if (best && milled > wanted.milled_mm2(best->flush)) continue;
            if (best && milled == wanted.milled_mm2(best->flush) && !leaves_more(offcuts, best->block.offcuts))
                continue;
            const Vec3 sides{(*size)[0].length, (*size)[1].length, (*size)[2].length};
            best = FlushBlock{{0, false, true, sides, true, std::move(offcuts)}, flush};
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

std::array<double, block_faces> foam_at_faces(const Margins& margins, const FlushFaces& flush) {
    std::array<double, block_faces> foam{margins.sides, margins.sides, margins.sides, margins.sides, margins.top};
    for (std::size_t f = 0; f < block_faces; ++f) foam[f] = flush[f] ? 0 : foam[f];
    return foam;
}

Vec3 size_with_foam(Vec3 piece_size, const Margins& margins, const FlushFaces& flush) {
    const std::array<double, block_faces> foam = foam_at_faces(margins, flush);
    return piece_size + Vec3{foam[0] + foam[1], foam[2] + foam[3], foam[4] + margins.spoil};
}

FlushBlock choose_flush_block(const Cell& cell, Vec3 piece_size, const std::array<double, block_faces>& caps_mm2) {
    assert(!cell.stock.empty());
    const Wanted wanted{piece_size, margins_of(cell), caps_mm2};
    const Vec3 needed = size_with_foam(piece_size, wanted.margins, {});
    const double saw_cut = wanted.milled_mm2({}) > 0 ? 0 : foam_for_a_saw_cut;
    FlushBlock best;
    std::optional<std::tuple<double, double, bool>> least;
    const auto consider = [&](StockBlock block, const FlushFaces& flush, double lacks) {
        const bool needs_saw = !block.offcuts.empty();
        const double milled = foam_per_milled_cap * wanted.milled_mm2(flush);
        const std::tuple key(lacks, volume(block.size) + (needs_saw ? saw_cut : 0) + milled, needs_saw);
        if (least && !(key < *least)) return;
        least = key;
        block.holds = lacks == 0;
        best = {std::move(block), flush};
    };
    for (std::size_t i = 0; i < cell.stock.size(); ++i) {
        std::optional<FlushBlock> smaller = cell.stock[i].is_sawn ? sawn(cell.stock[i], wanted) : std::nullopt;
        if (!smaller || smaller->block.offcuts.empty()) {
            const Vec3 size = cell.stock[i].size;
            consider({i, false, false, size, true, {}}, {}, lack(needed, size));
            const Vec3 turned{size.y, size.x, size.z};
            consider({i, true, false, turned, true, {}}, {}, lack(needed, turned));
        }
        if (!smaller) continue;
        smaller->block.stock = i;
        consider(std::move(smaller->block), smaller->flush, 0);
    }
    return best;
}

StockBlock choose_block(const Cell& cell, Vec3 piece_size) {
    return choose_flush_block(cell, piece_size, {}).block;
}

}  // namespace qchopper
