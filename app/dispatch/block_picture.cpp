// The parts of the path that are done are milled, and the surface of what is left is drawn. The cost is that of
// mill_stock and of the drawing.

#include "app/dispatch/block_picture.h"

#include <algorithm>
#include <optional>
#include <span>
#include <vector>

#include "app/jobs/job_scene.h"
#include "base/error.h"
#include "cam/job/read_job.h"
#include "segment/picture/picture.h"
#include "sim/program/parsed_program.h"
#include "sim/replay/scene.h"
#include "sim/replay/stages/coarser_stock.h"
#include "sim/replay/stages/stock_surface.h"
#include "sim/replay/stages/tool_way.h"
#include "sim/replay/walk/machine_walk.h"

namespace qchopper {
namespace {

constexpr double stock_cell = 1;            // mm
constexpr std::size_t triangles = 200'000;  // of the surface that is drawn, about

// The parts of the path that end by then.
void keep_until(double run_s, const CellMachine& machine, ToolPath& path) {
    const std::vector<PartDone> done = tool_way(path, machine).done;
    const auto later = std::ranges::upper_bound(done, run_s, {}, &PartDone::seconds);
    path.order.resize(static_cast<std::size_t>(later - done.begin() - (later == done.begin() ? 0 : 1)));
}

TriangleMesh surface_after(const ProofInput& input, double run_s, const Context& context) {
    const ParsedProgram program = program_read_back(input);
    const ReplayScene scene = scene_of(input);
    check_scene(scene);
    FindingLog log;
    ToolPath path = walk_machine(program, scene, log, context);
    keep_until(run_s, *input.cell.machine, path);
    std::vector<Vec3> tool_axes;
    for (const SceneOrientation& orientation : scene.orientations) tool_axes.push_back(orientation.tool_axis);
    StockModel stock_model(scene.block, tool_axes, stock_cell);
    if (const std::optional<StockRecord> before = stock_before(input)) {
        stock_model.start_from(before->cell < stock_cell ? coarser(*before, stock_cell) : *before);
    }
    mill_stock(stock_model, path, scene, true, log, context);
    return stock_surface(stock_model, surface_spacing(scene.block, triangles, stock_cell), context);
}

}  // namespace

Bytes block_picture(const Bytes& job_file, const std::string& name, const Cell& cell, double run_s,
                    const Context& context) {
    const ReadJob job = parse_job(job_file, name);
    if (!job.program) {
        throw InputError(InputFault::use, name + " holds no robot program: how it carves its block is not known");
    }
    if (job.program->dialect != cell.machine->program.dialect) {
        throw InputError(InputFault::use, "the program of " + name + " is in another dialect than the cell file says");
    }
    const JobContents contents(job, name);
    const TriangleMesh surface = surface_after(contents.input(cell), run_s, context);
    const ColouredMesh coloured{&surface, bone_colour, {}};
    return render_png(std::span(&coloured, 1), {}, context);
}

}  // namespace qchopper
