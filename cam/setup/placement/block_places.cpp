// Each place of a grid is scored on all poses by place_score.h, and the best place is that of place_block.h.
// O(places x poses x arm configurations).

#include "cam/setup/placement/block_places.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/parallel.h"
#include "base/units.h"
#include "cam/setup/block.h"
#include "cam/setup/placement/milling_poses.h"
#include "cam/setup/placement/place_block.h"
#include "cam/setup/placement/place_score.h"

namespace qchopper {
namespace {

constexpr double rounding = 1e-9;  // of relative margins

// A block with nothing in it.
Setup empty_setup(const Cell& cell, Vec3 block, double tilt) {
    Setup setup;
    const Margins margins = margins_of(cell);
    setup.spoil = std::min(margins.spoil, 0.5 * block.z);
    setup.block.size = block;
    setup.box = setup.milled_box();
    setup.access.orientations.push_back({{0, 0, 1}, 0, 0, 0});
    for (int i = 0; tilt > 0 && i < block_azimuths; ++i) {
        const double azimuth = 2 * std::numbers::pi * i / block_azimuths;
        const Vec3 tool_axis{std::sin(tilt) * std::cos(azimuth), std::sin(tilt) * std::sin(azimuth), std::cos(tilt)};
        setup.access.orientations.push_back({tool_axis, degrees(tilt), 0, 0});
    }
    return setup;
}

std::size_t places_along(double length, double step) {
    return 2 * static_cast<std::size_t>(std::floor(0.5 * length / step)) + 1;
}

}  // namespace

BlockPlaces block_places(const Cell& cell, Vec3 block, double tilt, double step, const Context& context) {
    assert(cell.machine && step > 0);
    const Setup setup = empty_setup(cell, block, tilt);
    PoseOptions options;
    options.block_only = true;
    const std::vector<OrientationPoses> poses = milling_poses(setup, {}, cell, options);
    BlockPlaces map{block, tilt, step, places_along(cell.table.size_x, step), places_along(cell.table.size_y, step),
                    {},    {}};
    map.places.resize(map.columns * map.rows);
    parallel_for(0, map.rows, [&](std::size_t row) {
        PlaceScorer scorer(setup, cell, poses);
        for (std::size_t column = 0; column < map.columns; ++column) {
            context.check_cancelled();
            BlockPlace& place = map.places[row * map.columns + column];
            place.x = step * (static_cast<double>(column) - 0.5 * static_cast<double>(map.columns - 1));
            place.y = step * (static_cast<double>(row) - 0.5 * static_cast<double>(map.rows - 1));
            const BlockPlacement placement{place.x, place.y, 0, {}};
            place.is_on_table = inside_table(cell, block, placement) >= -rounding;
            if (!place.is_on_table) continue;
            const double score = scorer.judged(placement, {true, 0}).score;
            if (score >= -rounding) place.margin = std::max(0.0, score);
        }
    });
    PlacementOptions search;
    search.has_other_base = false;
    map.best = place_block(setup, poses, cell, search, context);
    return map;
}

}  // namespace qchopper
