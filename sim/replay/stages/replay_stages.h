// A program replayed to be looked at: where the tool is when, and the stock at a few moments.
//
// mm, seconds, setup coordinates. The stock is that of replay() with the same cells and the same corners; figures that
// are claimed of a program are those of replay(). The result does not depend on the number of threads
// (tests/sim/replay/stages/replay_stages_test.cpp).

#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "base/context.h"
#include "sim/program/parsed_program.h"
#include "sim/replay/scene.h"
#include "sim/replay/stages/tool_way.h"
#include "sim/replay/stock/stock_model.h"

namespace qchopper {

struct StageOptions {
    double cell = 1;          // of the foam
    bool is_worst = true;     // as in ReplayOptions
    std::size_t stages = 24;  // at equal removed volume, beside the first one
};

struct ReplayStage {
    std::size_t points = 0;  // of the way, which are passed
    double seconds = 0;
    double removed_mm3 = 0;  // of all that the program removes
};

struct StagedReplay {
    std::vector<WayPoint> way;
    std::vector<ReplayStage> stages;  // the first one before the program, the last one after it
    double seconds = 0;               // PathTime::seconds
    double removed_mm3 = 0;           // MillingFigures::removed_mm3
};

// Is given each stage with its stock, in their order.
using StageTaker = std::function<void(const ReplayStage& stage, const StockModel& stock_model)>;

// A stage stands after the line with which its share of the volume is removed; lines that remove the shares of several
// stages give one, so that there may be fewer. The stock before may have smaller cells (coarser_stock.h). Throws what
// replay() throws, and what `take` throws. It mills twice: the cost is twice that of mill_stock with such cells.
StagedReplay replay_in_stages(const ParsedProgram& program, const ReplayScene& scene, const StageOptions& options,
                              const StageTaker& take, const Context& context = {});

}  // namespace qchopper
