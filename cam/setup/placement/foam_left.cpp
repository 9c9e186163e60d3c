// One map per orientation, lowered to the lowest of nine cells when it is taken. O(cells) each.

#include "cam/setup/placement/foam_left.h"

#include <algorithm>
#include <utility>

namespace qchopper {
namespace {

// Of each cell the lowest of it and those beside it, along rows and then along columns. A cell with nothing counts as
// one that the tool has not come to.
void lower_to_neighbours(HeightField& map) {
    for (float& height : map.height) {
        if (height == HeightField::nothing) height = std::numeric_limits<float>::infinity();
    }
    std::vector<float> before = map.height;
    for (std::size_t i = 0; i < before.size(); ++i) {
        const std::size_t column = i % map.columns;
        if (column > 0) map.height[i] = std::min(map.height[i], before[i - 1]);
        if (column + 1 < map.columns) map.height[i] = std::min(map.height[i], before[i + 1]);
    }
    before = map.height;
    for (std::size_t i = 0; i < before.size(); ++i) {
        if (i >= map.columns) map.height[i] = std::min(map.height[i], before[i - map.columns]);
        if (i + map.columns < before.size()) map.height[i] = std::min(map.height[i], before[i + map.columns]);
    }
}

}  // namespace

void FoamLeft::remove_above(HeightField cl, bool clears_beside) {
    lower_to_neighbours(cl);
    const Pose setup_in_field = cl.piece_in_field * setup_in_piece_;
    removed_.push_back({setup_in_field, std::move(cl), clears_beside});
}

bool FoamLeft::stands_at(Vec3 point) const {
    return std::none_of(removed_.begin(), removed_.end(), [&](const Removed& r) {
        const Vec3 p = apply(r.setup_in_field, point);
        const std::optional<std::size_t> cell = r.cl.cell_under(p.x, p.y);
        return cell ? static_cast<double>(r.cl.height[*cell]) <= p.z : r.clears_beside;
    });
}

}  // namespace qchopper
