// Volumes between what is left of the foam and the target, on vertical lines through the centres of square cells.
//
// mm3. Along each line both are intervals, exact but for rounding. O(lines * (crossings + maps))
// (tests/sim/replay/stock/stock_model_test.cpp).

#pragma once

#include "base/context.h"
#include "sim/replay/scene.h"
#include "sim/replay/stock/stock_model.h"

namespace qchopper {

struct VolumeOptions {
    double cell = 0.5;
    double around = 12;             // foam so far from the piece's projection counts: two radii of the largest tool
    double gouge_tolerance = 0.25;  // what is cut out less deep than this is not counted in beyond_mm3
    double standing = 1.25;         // foam so far from the piece, and reachable, stands there by mistake
    double floor = 2;               // foam lower than this is left on the floor: roughing leaves its allowance there
    double oblique_floor = 16;      // the same where no upright tool comes: levels over an oblique floor leave steps
    double floor_clearance = 6;     // that holder and spindle of an upright tool keep from the piece where it comes to
                                    // steps of the floor: less is not planned with, beside foam that others leave
};

struct VolumeFigures {
    double leftover_mm3 = 0;  // of foam outside of the target, above z = 0, within `around` of its projection
    double gouge_mm3 = 0;     // of the target that was removed
    double beyond_mm3 = 0;    // of it, what lies deeper in the target than the tolerance
    double standing_mm3 = 0;  // of leftover_mm3, what lies farther from the target than `standing` where the tools
                              // of the program come to: upright ones higher than `floor`, others than `oblique_floor`
    Vec3 standing_at;         // a point of it
};

// Throws Cancelled.
VolumeFigures measure_volumes(const StockModel& stock_model, const ReplayScene& scene, const VolumeOptions& options,
                              const Context& context);

}  // namespace qchopper
