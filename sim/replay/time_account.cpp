// Sums over lines, joint moves and tool changes.

#include "sim/replay/time_account.h"

#include <algorithm>
#include <cassert>

namespace qchopper {
namespace {

void add_line(TimeRow& row, const TipLine& line, const CuttingTool& tool, const LineTime& time, const LineCut& cut,
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

TimeRow TimeAccount::total() const {
    TimeRow sum;
    for (const TimeRow& row : rows) {
        sum.cutting_s += row.cutting_s;
        sum.air_s += row.air_s;
        sum.link_s += row.link_s;
        sum.acceleration_s += row.acceleration_s;
        sum.joint_move_s += row.joint_move_s;
        sum.tool_change_s += row.tool_change_s;
        sum.cutting_mm += row.cutting_mm;
        sum.air_mm += row.air_mm;
        sum.link_mm += row.link_mm;
        sum.removed_mm3 += row.removed_mm3;
        sum.lines += row.lines;
        sum.stops += row.stops;
        sum.short_lines += row.short_lines;
        sum.tool_changes += row.tool_changes;
    }
    return sum;
}

TimeAccount account_of(const ToolPath& path, const PathTime& time, const MillingFigures& milling,
                       const CellMachine& machine) {
    assert(time.lines.size() == path.lines.size() && milling.lines.size() == path.lines.size());
    const MotionLimits limits = motion_limits(machine);
    TimeAccount account;
    for (const ToolUse& use : path.uses) {
        TimeRow& row = account.rows.emplace_back();
        row.operation = use.operation;
        row.tool = machine.tools[use.tool].number;
        row.tool_mm3_per_s = machine.tools[use.tool].removal_mm3_per_s;
    }
    for (std::size_t i = 0; i < path.lines.size(); ++i) {
        const TipLine& line = path.lines[i];
        add_line(account.rows[line.use], line, machine.tools[line.tool], time.lines[i], milling.lines[i],
                 limits.cycle_s);
    }
    for (const JointSweep& sweep : path.sweeps) account.rows[sweep.use].joint_move_s += sweep.seconds;
    for (const std::uint32_t use : path.tool_changes) {
        account.rows[use].tool_change_s += limits.tool_change_s;
        ++account.rows[use].tool_changes;
    }
    return account;
}

}  // namespace qchopper
