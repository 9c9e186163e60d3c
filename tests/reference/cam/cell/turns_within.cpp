// Axis by axis, from the lowest turn upwards. O(results).

#include "tests/reference/cam/cell/turns_within.h"

#include <cmath>
#include <numbers>
#include <utility>

namespace qchopper {

std::vector<Joints> turns_within(const JointRanges& ranges, double margin, const Joints& joints) {
    constexpr double full_turn = 2 * std::numbers::pi;
    std::vector<Joints> found{joints};
    for (std::size_t axis = 0; axis < axes_of_arm; ++axis) {
        const double min = ranges[axis].min + margin;
        const double max = ranges[axis].max - margin;
        if (!std::isfinite(min) || !std::isfinite(max) || !std::isfinite(joints[axis])) return {};
        const double lowest = joints[axis] + full_turn * std::ceil((min - joints[axis]) / full_turn);
        std::vector<Joints> turned;
        for (const Joints& before : found) {
            for (int turns = 0; lowest + turns * full_turn <= max; ++turns) {
                turned.push_back(before);
                turned.back()[axis] = lowest + turns * full_turn;
            }
        }
        found = std::move(turned);
    }
    return found;
}

}  // namespace qchopper
