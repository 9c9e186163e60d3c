// What repair() does, and which of it an operator chooses; lengths are mm.

#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "segment/repair/fill_holes.h"
#include "segment/repair/pen_grooves/pen_grooves.h"

namespace qchopper {

struct RepairOptions {
    double mm_per_unit = 1;            // length of one unit of the mesh, above 0
    double snap_borders_mm = 0;        // border points nearer than this are merged; 0: off
    bool drop_repeated = true;         // faces that coincide with another one
    bool split = true;                 // edges of more than two faces, points where surfaces only touch
    bool orient = true;                // turn faces so that neighbours agree
    bool stitch = true;                // borders that coincide exactly
    bool remove_degenerate = true;     // faces whose corners lie on one line
    FillOptions fill;                  // holes
    bool drop_open_components = true;  // open surfaces beside the solid, of at most 1 % of its surface together
    bool orient_outward = true;        // turn shells that are inside out
    bool drop_fragments = false;       // solids smaller than 1/100,000 of the volume; else they are counted
    bool resolve_self_intersections = false;
    bool smooth_pen_grooves = false;
    PenGrooveOptions pen_grooves;    // used with smooth_pen_grooves
    double alpha_wrap_mm = 0;        // last resort: wrap the scan with a ball of this radius; 0: off
    bool measure_deviation = false;  // of a result that is a solid, or of any result with Fill::none
};

// The options that an operator chooses and a project file stores: with them the same scan gives the same solid.
struct RepairChoices {
    double snap_borders_mm = 0;  // border points nearer than this are merged; 0: off
    Fill fill = Fill::by_size;
    bool resolve_self_intersections = false;
    bool smooth_pen_grooves = false;
    double alpha_wrap_mm = 0;  // 0: off
    bool operator==(const RepairChoices&) const = default;
};

// The default options with these choices.
RepairOptions options_of(const RepairChoices& choices);

// "auto", "flat", "fair" or "none".
std::string name_of(Fill fill);
// Nothing for any other name.
std::optional<Fill> fill_named(std::string_view name);

}  // namespace qchopper
