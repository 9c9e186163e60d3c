// O(directions).

#include "cam/setup/drill_orientation.h"

namespace qchopper {

Setup with_drill_orientations(Setup setup, std::span<const DrillOrientation> drilling) {
    for (const DrillOrientation& own : drilling) {
        ToolOrientation orientation;
        orientation.tool_axis = rotate_inverse(setup.piece_in_setup, own.tool_axis);
        setup.access.orientations.push_back(orientation);
        if (!setup.placement.table_angles.empty()) setup.placement.table_angles.push_back(own.table_angle);
    }
    return setup;
}

}  // namespace qchopper
