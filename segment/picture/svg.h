// The words of an SVG file: numbers, colours, and text that is valid XML whatever it holds
// (tests/segment/picture/plot_test.cpp).

#pragma once

#include <string>

#include "segment/picture/colour.h"

namespace qchopper {

// Fixed decimals, a point whatever the locale, never "-0".
std::string svg_number(double value, int decimals);

// "#5590e2"
std::string svg_colour(Rgb colour);

// With &, <, > and quotes escaped; bytes that are no UTF-8, and characters that XML does not allow, become "?".
std::string svg_text(const std::string& text);

}  // namespace qchopper
