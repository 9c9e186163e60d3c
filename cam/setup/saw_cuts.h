// How a block is sawn from its stock: cuts one axis after the other, and what is left beside them.
//
// mm, along the axes of the block as it stands: 0 to 2 for x, y, z (tests/cam/setup/saw_cuts_test.cpp).

#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "cam/cell/cell.h"
#include "cam/setup/block_face.h"

namespace qchopper {

using AxisLengths = std::array<double, 3>;
using AxisOrder = std::array<std::size_t, 3>;

// All orders of three axes, those first that leave z alone.
constexpr std::array<AxisOrder, 6> axis_orders{{{0, 1, 2}, {1, 0, 2}, {0, 2, 1}, {2, 0, 1}, {1, 2, 0}, {2, 1, 0}}};

// How many faces of an axis are flush: z has one that can be, because the spoil layer lies under the piece.
std::size_t sawn_along(const FlushFaces& faces, std::size_t axis);

// A size along an axis, and how many saw cuts it takes from the stock.
struct SawnLength {
    double length = 0;
    int cuts = 0;
};
using SawnSize = std::array<SawnLength, 3>;

// Cuts with one setting of the saw, across one axis.
struct SawCuts {
    std::size_t axis = 0;
    double from = 0;             // length of the stock along it
    double length = 0;           // of the block
    int count = 1;               // 2 where both ends are glue faces: each is cut
    std::optional<Vec3> offcut;  // what is left beside it; nothing: no more than the cuts take
    bool operator==(const SawCuts&) const = default;
};

// Each through all that is left beside the block.
std::vector<SawCuts> cuts_in(const AxisOrder& order, AxisLengths stock, const SawnSize& block, double kerf);
// Largest first.
std::vector<Vec3> offcuts_of(const std::vector<SawCuts>& cuts);
// Whether axes with glue faces come after the others, so that no later cut spoils those.
bool is_sawn_last(const AxisOrder& order, const FlushFaces& faces);

// The cuts, in order, that make a block of a size (as it stands, spoil layer included) and leave these offcuts; glue
// faces last. `parted`: thickness of the layer under the piece that is sawn off too, of a piece that the saw alone
// makes; else 0. Empty where no such cuts of the stock do. O(36 orders).
std::vector<SawCuts> saw_cuts(const Stock& stock, Vec3 block, const std::vector<Vec3>& offcuts, const FlushFaces& faces,
                              double parted = 0);

}  // namespace qchopper
