// Which axis of the stock lies along which of the block, and in which order it was cut, is found again by trying all.

#include "cam/setup/saw_cuts.h"

#include <algorithm>
#include <cmath>

namespace qchopper {
namespace {

constexpr double rounding = 1e-6;  // mm

double volume(Vec3 v) {
    return v.x * v.y * v.z;
}

// The block with the cuts that each axis takes from the stock as it stands; nothing if it is not cut from that.
std::optional<SawnSize> sawn_size(const AxisLengths& stock, Vec3 block, const FlushFaces& faces, double kerf) {
    SawnSize size{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double length = block[static_cast<int>(axis)];
        const double off = stock[axis] - length;
        const int at_faces = static_cast<int>(sawn_along(faces, axis));
        size[axis] = {length, std::max(at_faces, off > kerf ? 1 : 0)};
        const int cuts = size[axis].cuts;
        if (cuts > 0 ? off < cuts * kerf - rounding : std::abs(off) > rounding) return std::nullopt;
    }
    return size;
}

}  // namespace

std::size_t sawn_along(const FlushFaces& faces, std::size_t axis) {
    if (axis == 2) return faces[4] ? 1 : 0;
    return static_cast<std::size_t>(faces[2 * axis]) + static_cast<std::size_t>(faces[2 * axis + 1]);
}

std::vector<SawCuts> cuts_in(const AxisOrder& order, AxisLengths stock, const SawnSize& block, double kerf) {
    std::vector<SawCuts> cuts;
    for (const std::size_t axis : order) {
        if (block[axis].cuts == 0) continue;
        SawCuts cut{axis, stock[axis], block[axis].length, block[axis].cuts, std::nullopt};
        AxisLengths offcut = stock;
        offcut[axis] = stock[axis] - block[axis].length - block[axis].cuts * kerf;
        if (offcut[axis] > rounding) cut.offcut = Vec3{offcut[0], offcut[1], offcut[2]};
        cuts.push_back(cut);
        stock[axis] = block[axis].length;
    }
    return cuts;
}

std::vector<Vec3> offcuts_of(const std::vector<SawCuts>& cuts) {
    std::vector<Vec3> offcuts;
    for (const SawCuts& cut : cuts) {
        if (cut.offcut) offcuts.push_back(*cut.offcut);
    }
    const auto is_larger = [](Vec3 a, Vec3 b) { return volume(a) > volume(b); };
    std::stable_sort(offcuts.begin(), offcuts.end(), is_larger);
    return offcuts;
}

bool is_sawn_last(const AxisOrder& order, const FlushFaces& faces) {
    return std::is_sorted(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return sawn_along(faces, a) == 0 && sawn_along(faces, b) > 0;
    });
}

std::vector<SawCuts> saw_cuts(const Stock& stock, Vec3 block, const std::vector<Vec3>& offcuts, const FlushFaces& faces,
                              double parted) {
    const auto is_same = [](Vec3 a, Vec3 b) { return norm(a - b) <= rounding; };
    for (const AxisOrder& turn : axis_orders) {
        const AxisLengths listed{stock.size.x, stock.size.y, stock.size.z};
        const AxisLengths as_it_stands{listed[turn[0]], listed[turn[1]], listed[turn[2]]};
        std::optional<SawnSize> size = sawn_size(as_it_stands, block, faces, stock.kerf);
        for (const AxisOrder& order : axis_orders) {
            if (!size || !is_sawn_last(order, faces)) continue;
            const std::vector<Vec3> left = offcuts_of(cuts_in(order, as_it_stands, *size, stock.kerf));
            if (!std::equal(left.begin(), left.end(), offcuts.begin(), offcuts.end(), is_same)) continue;
            if (parted > 0) (*size)[2] = {(*size)[2].length - parted, (*size)[2].cuts + 1};
            return cuts_in(order, as_it_stands, *size, stock.kerf);
        }
    }
    return {};
}

}  // namespace qchopper
