// Sentences from the values.

#include "cam/setup/workholding.h"

#include <cmath>

#include "base/text.h"

namespace qchopper {
namespace {

std::string newtons(double force) {
    return fixed(force, force < 10 ? 1 : 0) + " N";
}

// The strength of tape or glue with which the joint would hold, rounded up to hundredths.
double needed_strength(const Workholding& check) {
    return std::ceil(100 * check.holding.strength * check.holding.cutting_force / check.joint_force - 1e-9) / 100;
}

std::string stand_words(const HoldingStand& stand) {
    return "leave a stand of uncut foam around its lowest " + fixed(stand.top, 0) + " mm, " + fixed(stand.side, 0) +
           " x " + fixed(stand.side, 0) + " mm about x = " + fixed(stand.x, 0) + ", y = " + fixed(stand.y, 0) +
           " of the setup, saw it off in the plane of the base (z = 0) and carve that part by hand";
}

}  // namespace

std::string workholding_problem(const Workholding& check) {
    std::string text;
    const auto add = [&](const std::string& problem) { text += (text.empty() ? "" : "; ") + problem; };
    const Holding& holding = check.holding;
    const std::string against = ", less than the cutting force of " + newtons(holding.cutting_force);
    if (!check.joint_holds()) {
        add("tape or glue of " + significant(holding.strength, 3) + " N/mm2 parts at " + newtons(check.joint_force) +
            against);
    }
    if (!check.foam_holds()) {
        add("foam of " + significant(check.foam_strength, 3) + " N/mm2 breaks at " + newtons(check.foam_force) +
            against + ", where " + fixed(check.narrowest_mm2 / 100, 1) + " cm2 stand " + fixed(check.narrowest_z, 0) +
            " mm above the base");
    }
    if (!check.is_stout()) {
        add("it is " + fixed(check.height, 0) + " mm high on a base " + fixed(check.base_width, 0) +
            " mm wide, more than " + significant(holding.max_slenderness, 3) + " times as high as wide");
    }
    return text;
}

std::string workholding_remedy(const Workholding& check) {
    if (check.passes()) return {};
    std::string text;
    if (check.foam_holds() && check.is_stout()) {
        const double strength = needed_strength(check);
        if (strength <= check.foam_strength) {
            text = "glue the block with at least " + significant(strength, 3) + " N/mm2, or ";
        }
    }
    if (check.stand) return text + stand_words(*check.stand);
    return text + "lay it on another base, or cut it across its height";
}

}  // namespace qchopper
