// The volume of each line is known when the program has been milled once; then it is milled again, and stops at the
// stages. O(cells under the tool), twice, and O(moves) memory.

#include "sim/replay/stages/replay_stages.h"

#include <algorithm>
#include <cassert>
#include <optional>

#include "sim/replay/mill_stock.h"
#include "sim/replay/path_time.h"
#include "sim/replay/stages/coarser_stock.h"
#include "sim/replay/walk/machine_walk.h"

namespace qchopper {
namespace {

constexpr double step_of_sweep = 20;  // mm between points of the way in a joint move

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

// What is done when the first so many parts of a path are.
struct DoneAt {
    std::size_t points = 0;
    double seconds = 0;
    double removed_mm3 = 0;
};

class WayMaker {
 public:
    WayMaker(const ToolPath& path, const ReplayScene& scene, const MillingFigures& milling)
        : path_(path), machine_(*scene.cell->machine), milling_(milling) {}

    void make() {
        const MotionLimits limits = motion_limits(machine_);
        time_ = time_of(path_, limits);
        auto change = path_.tool_changes.begin();
        done_.push_back({});
        for (std::size_t part = 0; part < path_.order.size(); ++part) {
            for (; change != path_.tool_changes.end() && change->before <= part; ++change) {
                add_tool_change(path_.uses[change->use], limits.tool_change_s);
            }
            const std::size_t index = path_.order[part].index;
            if (path_.order[part].is_line) {
                add_line(index);
            } else {
                add_sweep(path_.sweeps[index]);
            }
            now_.points = way_.size();
            done_.push_back(now_);
        }
        end_at(time_.seconds);
    }
    std::vector<WayPoint>& way() { return way_; }
    const std::vector<DoneAt>& done() const { return done_; }
    double seconds() const { return time_.seconds; }

 private:
    void add_line(std::size_t index) {
        const TipLine& line = path_.lines[index];
        const CuttingTool& tool = machine_.tools[line.tool];
        const LineCut& cut = milling_.lines[index];
        orientation_ = line.orientation;
        WayKind kind = cut.removes ? WayKind::cut : WayKind::air;
        if (is_rapid(line, tool)) kind = WayKind::link;
        if (way_.empty()) way_.push_back({line.from, now_.seconds, line.place, tool.number, orientation_, kind});
        now_.seconds += time_.lines[index].seconds;
        now_.removed_mm3 += cut.removed_mm3;
        way_.push_back({line.to, now_.seconds, line.place, tool.number, orientation_, kind});
    }
    void add_sweep(const JointSweep& sweep) {
        if (sweep.is_checked_only || sweep.poses.empty()) return;
        const double begin = now_.seconds;
        now_.seconds += sweep.seconds;
        for (std::size_t i = 0; i < sweep.poses.size(); ++i) {
            const bool is_last = i + 1 == sweep.poses.size();
            if (!is_last && !way_.empty() && norm(sweep.poses[i].tip - way_.back().tip) < step_of_sweep) continue;
            const double share = static_cast<double>(i + 1) / static_cast<double>(sweep.poses.size());
            way_.push_back({sweep.poses[i].tip, is_last ? now_.seconds : begin + share * sweep.seconds, sweep.place,
                            machine_.tools[sweep.tool].number, orientation_, WayKind::joint_move});
        }
    }

    // The tip is where it was.
    void add_tool_change(const ToolUse& use, double seconds) {
        now_.seconds += seconds;
        if (way_.empty()) return;
        WayPoint point = way_.back();
        point.seconds = now_.seconds;
        point.tool = machine_.tools[use.tool].number;
        point.kind = WayKind::tool_change;
        way_.push_back(point);
    }
    // A sum in another order differs in its last digits.
    void end_at(double seconds) {
        for (WayPoint& point : way_) point.seconds = std::min(point.seconds, seconds);
        for (DoneAt& done : done_) done.seconds = std::min(done.seconds, seconds);
        if (!way_.empty()) way_.back().seconds = seconds;
        done_.back().seconds = seconds;
    }

    const ToolPath& path_;
    const CellMachine& machine_;
    const MillingFigures& milling_;
    PathTime time_;
    DoneAt now_;
    std::uint32_t orientation_ = 0;
    std::vector<WayPoint> way_;
    std::vector<DoneAt> done_;  // by the number of parts
};

// After how many parts the stages stand.
std::vector<std::size_t> stage_parts(const std::vector<DoneAt>& done, std::size_t stages) {
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
    WayMaker maker(path, scene, figures);
    maker.make();
    StagedReplay result;
    result.seconds = maker.seconds();
    result.removed_mm3 = figures.removed_mm3;
    const std::vector<std::size_t> parts = stage_parts(maker.done(), options.stages);
    milling.mill(path, true, context, [&](std::size_t done, const StockModel& stock_model) {
        if (result.stages.size() == parts.size() || parts[result.stages.size()] != done) return;
        const DoneAt& at = maker.done()[done];
        result.stages.push_back({at.points, at.seconds, at.removed_mm3});
        take(result.stages.back(), stock_model);
    });
    result.way = std::move(maker.way());
    return result;
}

}  // namespace qchopper
