// What stays on the target, and beside it.
//
// mm. Distances from points of the target, weighted by triangle area, to the nearest removed point: cells count at
// their centres, so that a distance is too large by at most 0.71 cells and never too small. A point is reachable if a
// closing of the target by tools of the cell along some direction of the setup comes within the scallop height + 0.75
// cells of it, whatever the program does: it asks only for what the setup allows (ReplayScene::tools). What keeps
// more foam than the tolerance, and no tool that the program uses along a direction reaches, is given up. The base is
// left out, other caps are in (tests/sim/replay/ball_test.cpp, tests/sim/replay/given_up_test.cpp).

#pragma once

#include <vector>

#include "base/context.h"
#include "sim/replay/finding.h"
#include "sim/replay/scene.h"
#include "sim/replay/stock/stock_model.h"

namespace qchopper {

struct LeftoverOptions {
    // Of the closing. With 0.5, a point as far from the closing as counts as reachable would keep up to 0.625 mm of
    // foam and a scallop on it, more than the tolerance allows to a program without any error.
    double reach_cell = 0.25;
    double sample_mm = 2;    // largest side of the part of a triangle that a point stands for
    double too_much = 0.5;   // mm above the scallop height
    double too_deep = 0.25;  // gouge of the tolerance
    double most = 30;        // farthest distance that is told from others
};

// Surface that a tool reaches along a direction, though the program does not use it there.
struct GivenUp {
    std::uint16_t tool = 0;       // CuttingTool::number
    std::size_t orientation = 0;  // index in ReplayScene::orientations
    double area_mm2 = 0;          // that keeps more foam than the tolerance, and counts for no other tool
};

struct LeftoverFigures {
    double area_mm2 = 0;       // of the target without its base
    double reachable_mm2 = 0;  // by tools that are allowed, what is given up included
    double within_mm2 = 0;     // of the reachable surface, within tolerance
    double largest = 0;        // on the reachable surface that is not given up
    double median = 0;         // of it, by area
    double percentile_99 = 0;
    std::vector<GivenUp> given_up;     // by the program: the largest first
    std::vector<GivenUp> not_allowed;  // with tools that the setup leaves out: beside the reachable surface
    double given_up_mm2() const { return sum_of(given_up); }
    double not_allowed_mm2() const { return sum_of(not_allowed); }
    static double sum_of(const std::vector<GivenUp>& surface);
    double largest_unreachable = 0;
    Vec3 at;                         // where the largest is
    std::vector<float> distance;     // per triangle, the mean of its points; 0 of the base
    std::vector<bool> is_reachable;  // per triangle: one of its points is
    std::vector<bool> is_given_up;   // likewise
};

// `gouge` is GougeFigures::depth. Throws Cancelled.
LeftoverFigures measure_leftover(const StockModel& stock_model, const ReplayScene& scene,
                                 const std::vector<float>& gouge, const LeftoverOptions& options,
                                 const Context& context);

}  // namespace qchopper
