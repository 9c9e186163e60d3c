// One key per value.

#include "cam/job/workholding_json.h"

#include <limits>
#include <nlohmann/json.hpp>

#include "base/json.h"

namespace qchopper {

using namespace json_values;

namespace {

double not_negative(const Json& object, const char* key) {
    return real_within(object, key, 0, std::numeric_limits<double>::max());
}

}  // namespace

Json from_workholding(const Workholding& check) {
    Json stand;
    if (check.stand) {
        stand = {{"top", check.stand->top}, {"side", check.stand->side}, {"x", check.stand->x}, {"y", check.stand->y}};
    }
    return {{"cutting_force_n", check.holding.cutting_force},
            {"joint_strength", check.holding.strength},
            {"max_slenderness", check.holding.max_slenderness},
            {"foam_strength", check.foam_strength},
            {"height", check.height},
            {"base_mm2", check.base_mm2},
            {"base_width", check.base_width},
            {"joint_force_n", check.joint_force},
            {"foam_force_n", check.foam_force},
            {"narrowest_z", check.narrowest_z},
            {"narrowest_mm2", check.narrowest_mm2},
            {"passes", check.passes()},
            {"stand", stand}};
}

Workholding to_workholding(const Json& json) {
    Workholding check;
    check.holding = {not_negative(json, "cutting_force_n"), not_negative(json, "joint_strength"),
                     not_negative(json, "max_slenderness")};
    check.foam_strength = not_negative(json, "foam_strength");
    check.height = not_negative(json, "height");
    check.base_mm2 = not_negative(json, "base_mm2");
    check.base_width = not_negative(json, "base_width");
    check.joint_force = not_negative(json, "joint_force_n");
    check.foam_force = not_negative(json, "foam_force_n");
    check.narrowest_z = not_negative(json, "narrowest_z");
    check.narrowest_mm2 = not_negative(json, "narrowest_mm2");
    if (const Json& stand = member(json, "stand"); !stand.is_null()) {
        check.stand =
            HoldingStand{not_negative(stand, "top"), not_negative(stand, "side"), real(stand, "x"), real(stand, "y")};
    }
    if (truth(json, "passes") != check.passes()) throw wrong("passes", "contradicts the forces and the slenderness");
    return check;
}

}  // namespace qchopper
