// One pass over the parts of the path.

#include "sim/replay/stages/tool_way.h"

#include <algorithm>
#include <utility>

#include "sim/replay/path_time.h"

namespace qchopper {
namespace {

constexpr double step_of_sweep = 20;  // mm between points of the way in a joint move

class WayMaker {
 public:
    WayMaker(const ToolPath& path, const CellMachine& machine, std::span<const LineCut> cuts)
        : path_(path), machine_(machine), cuts_(cuts) {}

    ToolWay make() {
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
        return {std::move(way_), std::move(done_), time_.seconds};
    }

 private:
    void add_line(std::size_t index) {
        const TipLine& line = path_.lines[index];
        const CuttingTool& tool = machine_.tools[line.tool];
        const LineCut cut = cuts_.empty() ? LineCut{true, 0} : cuts_[index];
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
        for (PartDone& done : done_) done.seconds = std::min(done.seconds, seconds);
        if (!way_.empty()) way_.back().seconds = seconds;
        done_.back().seconds = seconds;
    }

    const ToolPath& path_;
    const CellMachine& machine_;
    std::span<const LineCut> cuts_;
    PathTime time_;
    PartDone now_;
    std::uint32_t orientation_ = 0;
    std::vector<WayPoint> way_;
    std::vector<PartDone> done_;  // by the number of parts
};

}  // namespace

ToolWay tool_way(const ToolPath& path, const CellMachine& machine, std::span<const LineCut> cuts) {
    return WayMaker(path, machine, cuts).make();
}

}  // namespace qchopper
