// O(directions).

#include "cam/setup/drill_direction.h"

namespace qchopper {

Setup with_drill_directions(Setup setup, std::span<const DrillDirection> drilling) {
    for (const DrillDirection& own : drilling) {
        SetupDirection direction;
        direction.out = rotate_inverse(setup.piece_in_setup, own.out);
        setup.reach.directions.push_back(direction);
        if (!setup.placement.table_angles.empty()) setup.placement.table_angles.push_back(own.table_angle);
    }
    return setup;
}

}  // namespace qchopper
