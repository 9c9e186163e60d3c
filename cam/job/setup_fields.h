// Tables of the values of a setup that several documents have (base/json_fields.h).
//
// What is read is what was written (tests/cam/job/job_file_test.cpp). docs/developer/formats/job-folder.md holds the
// grammar.

#pragma once

#include <algorithm>
#include <vector>

#include "base/enum_names.h"
#include "base/json_fields.h"
#include "base/units.h"
#include "cam/setup/block_placement.h"
#include "cam/setup/placement/stated_angle.h"
#include "cam/setup/setup.h"
#include "cam/setup/surface_access.h"
#include "cam/setup/workholding.h"

namespace qchopper {

constexpr auto names_of(AccessMethod) {
    return EnumNames<AccessMethod, 2>{{{AccessMethod::sampled, "sampled"}, {AccessMethod::mapped, "mapped"}}};
}

// What the piece lies on: the keys of the base, in the object of whatever has them.
template <class V, Of<Setup> T>
void base_fields(V& v, T& setup) {
    v("base_number", setup.base_number);
    v.check(setup.base_number >= 0, "base_number", "is not a whole number in bounds");
    v("base_cut", setup.base);
    v.check(setup.base.value_or(0) >= 0, "base_cut", "is no number of a cut");
    v("base_description", setup.base_description);
}

template <class V, Of<ToolOrientation> T>
void fields(V& v, T& orientation) {
    v("tool_axis", orientation.tool_axis, json_values::is_direction);
    v("tilt_deg", orientation.tilt_deg);
    v("gained_share", orientation.gained_share);
    v("depth_mm", orientation.depth_mm);
}

template <class V, Of<SurfaceAccess> T>
void fields(V& v, T& access) {
    using json_values::not_negative;
    v("method", access.method);
    v("arm_checked", access.is_arm_checked);
    v("orientations", access.orientations);
    v("further", access.further);
    v("area_mm2", access.area_mm2, not_negative);
    v("hidden_mm2", access.hidden_mm2, not_negative);
    v("steep_mm2", access.steep_mm2, not_negative);
    v("holder_mm2", access.holder_mm2, not_negative);
    v("too_narrow_mm2", access.too_narrow_mm2, not_negative);
    v("steep_counts", access.steep_counts);
    v("narrow_counts", access.narrow_counts);
    v.derived(
        "unreachable_share", [&] { return access.unreachable_share(); }, "is not that of the areas");
    v("all_directions_share", access.all_directions_share, not_negative);
    v("foam_mm3", access.foam_mm3, not_negative);
    v("foam_depth_mm", access.foam_depth_mm);
    v("rest_material_mm3", access.rest_material_mm3, not_negative);
    v.maybe("ignored_mm2", access.ignored_mm2, 0, not_negative);
    v.maybe("allowed_mm2", access.allowed_mm2, 0, not_negative);
}

template <class V, Of<BlockPlacement> T>
void fields(V& v, T& placement) {
    v("x_mm", placement.x);
    v("y_mm", placement.y);
    v.converted("turn_deg", placement.turn, stated_degrees, radians);
    const auto each = [](std::vector<double> angles, double (*convert)(double)) {
        std::transform(angles.begin(), angles.end(), angles.begin(), convert);
        return angles;
    };
    v.converted(
        "table_angles_deg", placement.table_angles, [&](const auto& list) { return each(list, stated_degrees); },
        [&](const auto& list) { return each(list, radians); });
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
    v("bending_strength", check.foam_strength, not_negative);
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
