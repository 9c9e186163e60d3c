// The table of fields of MachineTime, which verdicts and reports write.
//
// Seconds, mm, mm3. No amount is negative.

#pragma once

#include "base/json_fields.h"
#include "cam/job/job_program.h"

namespace qchopper {

template <class V, Of<MachineTime> T>
void fields(V& v, T& time) {
    using json_values::not_negative;
    v("operation", time.operation);
    v("tool", time.tool);
    v("tool_mm3_per_s", time.tool_mm3_per_s, not_negative);
    v("cutting_s", time.cutting_s, not_negative);
    v("air_s", time.air_s, not_negative);
    v("link_s", time.link_s, not_negative);
    v("acceleration_s", time.acceleration_s, not_negative);
    v("joint_move_s", time.joint_move_s, not_negative);
    v("tool_change_s", time.tool_change_s, not_negative);
    v("cutting_mm", time.cutting_mm, not_negative);
    v("air_mm", time.air_mm, not_negative);
    v("link_mm", time.link_mm, not_negative);
    v("removed_mm3", time.removed_mm3, not_negative);
    v("lines", time.lines);
    v("stops", time.stops);
    v("short_lines", time.short_lines);
    v("tool_changes", time.tool_changes);
}

}  // namespace qchopper
