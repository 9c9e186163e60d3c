// Two solid cylinders on one axis, moved to their common centre. O(steps of the holder).

#include "cam/program/program.h"

#include <algorithm>

#include "cam/cell/reach_map.h"

namespace qchopper {
namespace {

struct SolidCylinder {
    double mass = 0;
    double middle = 0;  // on the axis, from the nose towards the tip
    double length = 0;
    double radius = 0;
};

}  // namespace

LoadData load_data(const Spindle& spindle, const CuttingTool& tool) {
    double diameter = tool.diameter;
    for (const HolderStep& step : tool.holder) diameter = std::max(diameter, step.diameter);
    const double gauge = gauge_length(tool);
    const SolidCylinder parts[] = {
        {spindle.mass_kg, -(spindle.body_offset + 0.5 * spindle.body_length), spindle.body_length, spindle.body_radius},
        {tool.mass_kg, 0.5 * gauge, gauge, 0.5 * diameter}};
    LoadData load;
    double moment = 0;
    for (const SolidCylinder& part : parts) {
        load.mass_kg += part.mass;
        moment += part.mass * part.middle;
    }
    const double centre = moment / load.mass_kg;
    for (const SolidCylinder& part : parts) {
        const double r2 = 1e-6 * part.radius * part.radius;
        const double away = 1e-3 * (part.middle - centre);
        const double across = part.mass * (r2 / 4 + 1e-6 * part.length * part.length / 12 + away * away);
        load.inertia_kg_m2 = load.inertia_kg_m2 + Vec3{across, across, part.mass * r2 / 2};
    }
    const Pose tip_in_flange = tool_arm(Robot{}, spindle, tool).tip_in_flange;
    load.centre_in_flange = tip_in_flange * Pose{Pose{}.row, {0, 0, centre - gauge}};
    return load;
}

}  // namespace qchopper
