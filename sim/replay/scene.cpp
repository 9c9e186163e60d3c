// O(chunks).

#include "sim/replay/scene.h"

#include <algorithm>

#include "base/error.h"

namespace qchopper {
namespace {

void demand(bool holds, const char* what) {
    if (!holds) throw InputError(InputFault::use, std::string("the program cannot be replayed: ") + what);
}

}  // namespace

double ReplayScene::planned_length(const CuttingTool& tool) const {
    const auto planned = planned_lengths.find(tool.number);
    return planned != planned_lengths.end() ? planned->second : gauge_length(tool);
}

void check_scene(const ReplayScene& scene) {
    demand(scene.cell != nullptr && scene.cell->machine, "the cell file describes no machine");
    demand(!scene.orientations.empty(), "the job has no orientation");
    demand(!scene.chunks.empty(), "the job names no program");
    const auto has_tool = [&](std::uint16_t number) {
        return std::ranges::count(scene.cell->machine->tools, number, &CuttingTool::number) > 0;
    };
    for (const std::uint16_t number : scene.tools) {
        demand(has_tool(number), "a tool of the setup is not in the cell file");
    }
    for (const SceneChunk& chunk : scene.chunks) {
        demand(has_tool(chunk.tool), "a tool of the job is not in the cell file");
        demand(chunk.orientation < scene.orientations.size(), "an orientation of the job is not there");
    }
    const Vec3 size = scene.block.size();
    demand(size.x > 0 && size.y > 0 && size.z > 0, "the block has no size");
    demand(scene.target != nullptr && !scene.target->triangles.empty(), "the piece has no surface");
    demand(scene.is_unmilled.empty() || scene.is_unmilled.size() == scene.target->triangles.size(),
           "the base is not of the piece");
    const auto has_face = [](const SceneCap& cap) { return cap.face.value_or(0) < SceneCap::faces; };
    demand(std::ranges::all_of(scene.caps, has_face), "a cap is said to be a face that no block has");
}

}  // namespace qchopper
