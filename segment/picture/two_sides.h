// Meshes from two opposite sides, side by side, with a legend of their colours below, as PNG.
//
// Drawn without ambient light on white, so that shade is not taken for a colour. Same input, same bytes, whatever the
// number of threads.

#pragma once

#include <span>
#include <string>

#include "base/context.h"
#include "base/files/file.h"
#include "segment/picture/camera.h"

namespace qchopper {

struct LegendEntry {
    Rgb colour;
    std::string name;
};

// Pixels.
struct TwoSidesLayout {
    int view_width = 0;  // of one side
    int view_height = 0;
    int legend_height = 0;  // below both
    int square = 0;         // of a colour in the legend
    double letter_height = 0;
    double letter_width = 0;    // at that height, about
    double left_of_legend = 0;  // before the first square
    double after_square = 0;    // between a square and its name
    double after_name = 0;      // between a name and the next square
};

// Throws InputError (use) if there is no triangle to draw, and Cancelled.
Bytes draw_two_sides(std::span<const ColouredMesh> meshes, std::span<const LegendEntry> legend,
                     const TwoSidesLayout& layout, const Context& context = {});

}  // namespace qchopper
