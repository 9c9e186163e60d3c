// The volume of each line is known when the program has been milled once; then it is milled again, and stops at the
// stages. O(cells under the tool), twice, and O(moves) memory.

#include "sim/replay/stages/replay_stages.h"

#include <algorithm>
#include <cassert>
#include <optional>

#include "sim/replay/mill_stock.h"
#include "sim/replay/stages/coarser_stock.h"
#include "sim/replay/walk/machine_walk.h"

namespace qchopper {
namespace {

// Of the program in the stock before.
class Milling {
 public:
    Milling(const ReplayScene& scene, const StageOptions& options) : scene_(scene), options_(options) {
        for (const SceneOrientation& orientation : scene.orientations) tool_axes_.push_back(orientation.tool_axis);
        if (scene.before != nullptr && scene.before->cell < options.cell) {
            coarse_before_ = coarser(*scene.before, options.cell);
        }
    }
    // `is_second`: of two, which report one progress.
    template <class OnPart>
    MillingFigures mill(const ToolPath& path, bool is_second, const Context& context, const OnPart& on_part) const {
        StockModel stock_model(scene_.block, tool_axes_, options_.cell);
        if (scene_.before != nullptr) stock_model.start_from(coarse_before_ ? *coarse_before_ : *scene_.before);
        Context half = context;
        half.on_progress = [&](const Progress& progress) {
            context.progress(progress.what, progress.done + (is_second ? progress.total : 0), 2 * progress.total);
        };
        on_part(0, stock_model);
        FindingLog log;
        return mill_stock(stock_model, path, scene_, options_.is_worst, log, half,
                          [&](std::size_t done) { on_part(done, stock_model); });
    }

 private:
    const ReplayScene& scene_;
    const StageOptions& options_;
    std::vector<Vec3> tool_axes_;
    std::optional<StockRecord> coarse_before_;
};

// After how many parts the stages stand.
std::vector<std::size_t> stage_parts(const std::vector<PartDone>& done, std::size_t stages) {
    const double all = done.back().removed_mm3;
    std::vector<std::size_t> parts{0};
    std::size_t at = 0;
    for (std::size_t stage = 1; stage < stages; ++stage) {
        const double share = all * static_cast<double>(stage) / static_cast<double>(stages);
        while (at + 1 < done.size() && done[at].removed_mm3 < share) ++at;
        const bool is_later = done[at].seconds > done[parts.back()].seconds && at + 1 < done.size();
        if (is_later && done[at].seconds < done.back().seconds) parts.push_back(at);
    }
    if (done.size() > 1) parts.push_back(done.size() - 1);
    return parts;
}

}  // namespace

StagedReplay replay_in_stages(const ParsedProgram& program, const ReplayScene& scene, const StageOptions& options,
                              const StageTaker& take, const Context& context) {
    check_scene(scene);
    FindingLog log;
    const ToolPath path = walk_machine(program, scene, log, context);
    const Milling milling(scene, options);
    const MillingFigures figures = milling.mill(path, false, context, [](std::size_t, const StockModel&) {});
    ToolWay way = tool_way(path, *scene.cell->machine, figures.lines);
    StagedReplay result;
    result.seconds = way.seconds;
    result.removed_mm3 = figures.removed_mm3;
    const std::vector<std::size_t> parts = stage_parts(way.done, options.stages);
    milling.mill(path, true, context, [&](std::size_t done, const StockModel& stock_model) {
        if (result.stages.size() == parts.size() || parts[result.stages.size()] != done) return;
        const PartDone& at = way.done[done];
        result.stages.push_back({at.points, at.seconds, at.removed_mm3});
        take(result.stages.back(), stock_model);
    });
    result.way = std::move(way.points);
    return result;
}

}  // namespace qchopper
