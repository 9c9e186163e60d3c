// The lowest and the highest foam within a distance of each cell (disc_max.h).

#include "cam/stock/roughing_limit.h"

#include <algorithm>
#include <cassert>

#include "segment/raster/disc_max.h"

namespace qchopper {
namespace {

constexpr double more_cells = 6;  // than the radius: where the tool comes down beside the foam
constexpr float closed = 1e6F;    // mm, of a tip

}  // namespace

void raise_to_foam(HeightMap& tip, HeightMap lowest, const CarvingTool& tool, double level) {
    assert(lowest.height.size() == tip.height.size());
    for (float& z : lowest.height) z = z == HeightMap::nothing ? z : -z;
    const HeightMap negative = disc_max(lowest, 0.5 * tool.diameter + more_cells * tip.cell);
    for (std::size_t i = 0; i < tip.height.size(); ++i) {
        if (negative.height[i] == HeightMap::nothing) continue;
        tip.height[i] = std::max(tip.height[i], -negative.height[i] - static_cast<float>(level));
    }
}

void close_beside_foam(HeightMap& tip, const HeightMap& foam, double beside) {
    const HeightMap near = disc_max(foam, beside);
    for (std::size_t i = 0; i < tip.height.size(); ++i) {
        if (near.height[i] == HeightMap::nothing) tip.height[i] = closed;
    }
}

}  // namespace qchopper
