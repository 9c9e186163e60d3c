// The lowest and the highest foam within a distance of each cell (disc_dilation.h).

#include "cam/stock/roughing_limit.h"

#include <algorithm>
#include <cassert>

#include "segment/raster/disc_dilation.h"

namespace qchopper {
namespace {

constexpr double more_cells = 6;  // than the radius: where the tool comes down beside the foam
constexpr float closed = 1e6F;    // mm, of a tip

}  // namespace

void stay_near_stock(HeightField& tip, HeightField lowest, const CuttingTool& tool, double level) {
    assert(lowest.height.size() == tip.height.size());
    for (float& z : lowest.height) z = z == HeightField::nothing ? z : -z;
    const HeightField negative = dilate_by_disc(lowest, 0.5 * tool.diameter + more_cells * tip.cell);
    for (std::size_t i = 0; i < tip.height.size(); ++i) {
        if (negative.height[i] == HeightField::nothing) continue;
        tip.height[i] = std::max(tip.height[i], -negative.height[i] - static_cast<float>(level));
    }
}

void close_beside_stock(HeightField& tip, const HeightField& stock, double beside) {
    const HeightField near = dilate_by_disc(stock, beside);
    for (std::size_t i = 0; i < tip.height.size(); ++i) {
        if (near.height[i] == HeightField::nothing) tip.height[i] = closed;
    }
}

}  // namespace qchopper
