// Sums, a line per amount.

#include "cam/cell/machine_time.h"

namespace qchopper {

void add(MachineTime& sum, const MachineTime& row) {
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

MachineTime sum_of(const std::vector<MachineTime>& rows) {
    MachineTime sum;
    for (const MachineTime& row : rows) add(sum, row);
    return sum;
}

}  // namespace qchopper
