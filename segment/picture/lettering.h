// Text and a scale bar drawn into the pixels of a picture, in strokes with a light border.

#pragma once

#include <string>

#include "segment/picture/png.h"

namespace qchopper {

// Throws InputError (missing) unless the font is installed (package hershey-fonts-data): for programs that work long
// before they draw. Both functions below throw it as well.
void check_font();

// A text of one line with its middle at (x, y) in pixels, moved into the picture where it would reach beyond; capital
// letters are `height` pixels high. Characters that the font lacks are left out.
void draw_text(Pixels& pixels, double x, double y, const std::string& text, double height);

// A bar of 1, 2 or 5 times a power of ten mm, about a sixth of the picture long, in the lower left corner, with its
// length above.
void draw_scale_bar(Pixels& pixels, double mm_per_pixel);

// "20 cm": mm below 1 cm, m from 1 m.
std::string describe_length(double mm);

}  // namespace qchopper
