// Both bodies have the tool axis in common: the tensor is J across it, and K along it.

#include "sim/replay/carried_load.h"

#include <algorithm>
#include <cmath>

#include "sim/replay/turn.h"

namespace qchopper {
namespace {

constexpr double metre = 1e-3;  // per mm

}  // namespace

CarriedLoad carried_load(const Spindle& spindle, const CuttingTool& tool) {
    const Vec3 tool_axis = column(spindle.spindle_in_flange, spindle.tool_axis == ToolAxis::z ? 2 : 0);
    double widest = tool.diameter;
    for (const HolderStep& step : tool.holder) widest = std::max(widest, step.diameter);
    CarriedLoad load;
    double first = 0;   // moments of mass along the axis, from the nose
    double second = 0;  // with the own inertia of the bodies across the axis
    double along = 0;
    const auto add = [&](double mass, double from, double to, double radius) {
        const double a = metre * from;
        const double b = metre * to;
        const double r = metre * radius;
        load.mass_kg += mass;
        first += mass * (a + b) / 2;
        second += mass * ((a * a + a * b + b * b) / 3 + r * r / 4);
        along += mass * r * r / 2;
    };
    add(spindle.mass_kg, -spindle.body_offset - spindle.body_length, -spindle.body_offset, spindle.body_radius);
    add(tool.mass_kg, 0, gauge_length(tool), widest / 2);
    const double middle = first / load.mass_kg;
    const double across = second - load.mass_kg * middle * middle;
    load.centre = spindle.spindle_in_flange.shift + (middle / metre) * tool_axis;
    for (int i = 0; i < 3; ++i) {
        load.inertia[static_cast<std::size_t>(i)] = ((along - across) * tool_axis[i]) * tool_axis;
        load.inertia[static_cast<std::size_t>(i)][i] += across;
    }
    return load;
}

CarriedLoad carried_load(const ProgramLoad& stated) {
    const Pose frame = pose_of(stated.centre);
    CarriedLoad load{stated.mass_kg, stated.centre.shift, {}};
    for (int axis = 0; axis < 3; ++axis) {
        const Vec3 along = column(frame, axis);
        for (int i = 0; i < 3; ++i) {
            Vec3& row = load.inertia[static_cast<std::size_t>(i)];
            row = row + (stated.inertia[axis] * along[i]) * along;
        }
    }
    return load;
}

double inertia_off(const CarriedLoad& a, const CarriedLoad& b) {
    double most = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec3 off = a.inertia[i] - b.inertia[i];
        most = std::max({most, std::abs(off.x), std::abs(off.y), std::abs(off.z)});
    }
    return most;
}

}  // namespace qchopper
