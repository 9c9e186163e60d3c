// Tables of the values of a setup that several documents have (base/json_fields.h).
//
// What is read is what was written (tests/cam/job/job_file_test.cpp). docs/developer/formats/job-folder.md holds the
// grammar.

#pragma once

#include "base/enum_names.h"
#include "base/json_fields.h"
#include "cam/setup/block_placement.h"
#include "cam/setup/surface_access.h"
#include "cam/setup/workholding.h"

namespace qchopper {

constexpr auto names_of(AccessMethod) {
    return EnumNames<AccessMethod, 2>{{{AccessMethod::sampled, "sampled"}, {AccessMethod::mapped, "mapped"}}};
}

template <class V, Of<ToolOrientation> T>
void fields(V& v, T& orientation) {
    v("out", orientation.tool_axis, json_values::is_direction);
    v("tilt_deg", orientation.tilt_deg);
    v("gained_share", orientation.gained_share);
    v("depth_mm", orientation.depth_mm);
}

template <class V, Of<BlockPlacement> T>
void fields(V& v, T& placement) {
    v("x", placement.x);
    v("y", placement.y);
    v("turn_rad", placement.turn);
    v("table_angles_rad", placement.table_angles);
}

template <class V, Of<HoldingStand> T>
void fields(V& v, T& stand) {
    v("top", stand.top, json_values::not_negative);
    v("side", stand.side, json_values::not_negative);
    v("x", stand.x);
    v("y", stand.y);
}

template <class V, Of<Workholding> T>
void fields(V& v, T& check) {
    using json_values::not_negative;
    v("cutting_force_n", check.holding.cutting_force, not_negative);
    v("joint_strength", check.holding.strength, not_negative);
    v("max_slenderness", check.holding.max_slenderness, not_negative);
    v("foam_strength", check.foam_strength, not_negative);
    v("height", check.height, not_negative);
    v("base_mm2", check.base_mm2, not_negative);
    v("base_width", check.base_width, not_negative);
    v("joint_force_n", check.joint_force, not_negative);
    v("foam_force_n", check.foam_force, not_negative);
    v("narrowest_z", check.narrowest_z, not_negative);
    v("narrowest_mm2", check.narrowest_mm2, not_negative);
    v.derived(
        "passes", [&] { return check.passes(); }, "contradicts the forces and the slenderness");
    v("stand", check.stand);
}

}  // namespace qchopper
