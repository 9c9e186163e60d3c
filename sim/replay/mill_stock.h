// Replays a tool path in the foam, part by part: what is removed, and which rule of the work it breaks.
//
// mm. In the order of execution, because what a move may do depends on the foam that is left. O(cells under the tool)
// (tests/sim/replay/replay_test.cpp).

#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "base/context.h"
#include "cam/cell/cutting_tool.h"
#include "sim/replay/finding.h"
#include "sim/replay/hole_check.h"
#include "sim/replay/scene.h"
#include "sim/replay/stock/stock_model.h"
#include "sim/replay/tool_path.h"

namespace qchopper {

// What a line does to the foam.
struct LineCut {
    bool removes = false;  // more than 0.01 mm of foam
    double removed_mm3 = 0;
};

struct MillingFigures {
    double removed_mm3 = 0;
    double feed_mm = 0;      // length of lines at the feed of cuts: not faster than the tool's window
    double air_mm = 0;       // of them, what removes nothing
    std::size_t cuts = 0;    // lines that remove foam
    std::size_t rapids = 0;  // lines above the tool's window, and joint moves
    HoleFigures holes;
    std::vector<LineCut> lines;  // of each line of the path
};

// Whether a line is faster than the window of its tool: it may remove nothing.
inline bool is_rapid(const TipLine& line, const CuttingTool& tool) {
    return line.feed > 1.001 * tool.feed_max_mm_per_s;
}

// Is told after each part of ToolPath::order how many are done: the stock is as they leave it.
using MillingObserver = std::function<void(std::size_t done)>;

// Is `is_worst` true, corners that may be rounded are: the foam outside of the parabola stays. Throws Cancelled.
MillingFigures mill_stock(StockModel& stock_model, const ToolPath& path, const ReplayScene& scene, bool is_worst,
                          FindingLog& log, const Context& context, const MillingObserver& on_part = {});

// The way of a line with the corner at its end: from where it leaves the corner before to where the next line takes
// over. `before` and `after` are its neighbours or nullptr.
std::vector<Vec3> rounded_way(const TipLine* before, const TipLine& line, const TipLine* after);

}  // namespace qchopper
