// A tool of a cell file, with its shape, its holder and what it may do. Lengths in mm.
//
// In what read_cell returns, the diameter is above zero, 0 < flute_length <= stick_out, no step of the holder is
// narrower than the tool, and both windows have their least value below the largest.

#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace qchopper {

// bull: flat with rounded edge. cone: pointed, with straight flanks up to the diameter. drill: the same shape, and it
// goes only along its axis: it makes the holes of the job and mills nothing else.
enum class ToolShape { ball, flat, bull, cone, drill };

// A cylinder of the holder. The first step begins at stick_out above the tip, each next one where the last ends; the
// last one ends at the spindle nose.
struct HolderStep {
    double diameter = 0;
    double length = 0;
    bool operator==(const HolderStep&) const = default;
};

struct CuttingTool {
    std::uint16_t number = 1;  // no other tool of the cell has it
    std::string name;
    ToolShape shape = ToolShape::ball;
    double diameter = 0;
    double corner_radius = 0;  // ball: half the diameter; flat: 0; cone: of its tip
    double tip_angle = 0;      // of a cone or drill, from flank to flank, radians, below pi; else 0
    double flute_length = 0;   // of the cutting edges
    double stick_out = 0;      // from the tip to the holder
    std::vector<HolderStep> holder;
    double feed_min_mm_per_s = 0;
    double feed_max_mm_per_s = 0;
    std::uint16_t rpm_min = 0;
    std::uint16_t rpm_max = 0;
    double mass_kg = 0;  // with its holder
    double removal_mm3_per_s = 0;
    bool is_length_measured = false;
    bool is_centre_cutting = true;  // false, of flat and bull tools only: it may not go straight down into foam
    bool operator==(const CuttingTool&) const = default;
};

inline bool is_drill(const CuttingTool& tool) {
    return tool.shape == ToolShape::drill;
}

// "ball", "flat", "bull", "cone", "drill"
const char* to_word(ToolShape shape);

// From the tip of a cone or drill to where it has its diameter.
double point_height(const CuttingTool& tool);

// From the tip to the spindle nose. O(steps).
double gauge_length(const CuttingTool& tool);

}  // namespace qchopper
