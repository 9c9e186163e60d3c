// Sums over lines, joint moves and tool changes.

#include "sim/replay/time_account.h"

#include <algorithm>
#include <cassert>

namespace qchopper {
namespace {

void add_line(MachineTime& row, const TipLine& line, const CuttingTool& tool, const LineTime& time, const LineCut& cut,
              double cycle_s) {
    const double length = norm(line.to - line.from);
    const double at_feed = length / line.feed;
    if (is_rapid(line, tool)) {
        row.link_s += at_feed;
        row.link_mm += length;
    } else if (cut.removes) {
        row.cutting_s += at_feed;
        row.cutting_mm += length;
    } else {
        row.air_s += at_feed;
        row.air_mm += length;
    }
    row.acceleration_s += std::max(0.0, time.seconds - at_feed);
    row.removed_mm3 += cut.removed_mm3;
    ++row.lines;
    if (time.end_speed == 0) ++row.stops;
    if (length < line.feed * cycle_s) ++row.short_lines;
}

}  // namespace

std::vector<MachineTime> account_of(const ToolPath& path, const PathTime& time, const MillingFigures& milling,
                                    const CellMachine& machine) {
    assert(time.lines.size() == path.lines.size() && milling.lines.size() == path.lines.size());
    const MotionLimits limits = motion_limits(machine);
    std::vector<MachineTime> account;
    for (const ToolUse& use : path.uses) {
        MachineTime& row = account.emplace_back();
        row.operation = use.operation;
        row.tool = machine.tools[use.tool].number;
        row.tool_mm3_per_s = machine.tools[use.tool].removal_mm3_per_s;
    }
    for (std::size_t i = 0; i < path.lines.size(); ++i) {
        const TipLine& line = path.lines[i];
        add_line(account[line.use], line, machine.tools[line.tool], time.lines[i], milling.lines[i], limits.cycle_s);
    }
    for (const JointSweep& sweep : path.sweeps) account[sweep.use].joint_move_s += sweep.seconds;
    for (const ToolChange& change : path.tool_changes) {
        account[change.use].tool_change_s += limits.tool_change_s;
        ++account[change.use].tool_changes;
    }
    return account;
}

}  // namespace qchopper
