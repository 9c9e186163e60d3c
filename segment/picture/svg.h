// Formats colours and text for an SVG file, as valid XML for any input (tests/segment/picture/plot_test.cpp).

#pragma once

#include <string>

#include "segment/picture/colour.h"

namespace qchopper {

// "#5590e2"
std::string svg_colour(Rgb colour);

// With &, <, > and quotes escaped; bytes that are no UTF-8, and characters that XML does not allow, become "?".
std::string svg_text(const std::string& text);

}  // namespace qchopper
