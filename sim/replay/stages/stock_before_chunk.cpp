// The program is cut off before the chunk, followed and milled. O(poses * bodies^2) and O(cells under the tool) of the
// chunks before.

#include "sim/replay/stages/stock_before_chunk.h"

#include <algorithm>

#include "base/error.h"
#include "sim/replay/mill_stock.h"
#include "sim/replay/reach/reachable.h"
#include "sim/replay/walk/machine_walk.h"

namespace qchopper {
namespace {

// Its states and steps stay.
void cut_off(ParsedProgram& program, std::size_t chunk) {
    std::size_t begun = 0;
    const auto end =
        std::ranges::find_if(program.chunks, [&](const ProgramChunk& own) { return !own.is_main && begun++ == chunk; });
    if (end == program.chunks.end()) {
        throw InputError(InputFault::use, "the program has no chunk " + std::to_string(chunk + 1));
    }
    program.chunks.erase(end, program.chunks.end());
}

}  // namespace

StockRecord stock_before_chunk(ParsedProgram program, const ReplayScene& scene, std::size_t chunk,
                               const ReplayOptions& options, const Context& context) {
    check_scene(scene);
    std::vector<Vec3> tool_axes;
    for (const SceneOrientation& orientation : scene.orientations) tool_axes.push_back(orientation.tool_axis);
    StockModel stock_model(scene.block, tool_axes, options.cell);
    if (scene.before != nullptr) stock_model.start_from(*scene.before);
    cut_off(program, chunk);
    FindingLog log;
    if (chunk > 0) {
        const ToolPath path = walk_machine(program, scene, log, context);
        mill_stock(stock_model, path, scene, options.is_worst, log, context);
    }
    ReplayScene used = scene;
    used.chunks.resize(chunk);
    StockRecord stock = stock_model.record();
    stock.tools = used_tools(used);
    return stock;
}

}  // namespace qchopper
