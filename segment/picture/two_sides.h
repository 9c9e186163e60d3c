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

// Of pictures of a whole scan or all its pieces: 2000 x 960.
inline constexpr TwoSidesLayout whole_scan_layout{.view_width = 1000,
                                                  .view_height = 900,
                                                  .legend_height = 60,
                                                  .square = 24,
                                                  .letter_height = 15,
                                                  .letter_width = 11.8,
                                                  .left_of_legend = 30,
                                                  .after_square = 10,
                                                  .after_name = 30};

// Throws InputError (use) if there is no triangle to draw, and Cancelled.
Bytes draw_two_sides(std::span<const ColouredMesh> meshes, std::span<const LegendEntry> legend,
                     const TwoSidesLayout& layout, const Context& context = {});

}  // namespace qchopper
