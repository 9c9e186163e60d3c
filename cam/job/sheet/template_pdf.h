// The template of a cap as a PDF of A4 pages, on as many tiles as it takes: they overlap, and marks tell how they are
// laid on each other.
//
// mm, y upwards. The same template gives the same bytes (tests/cam/job/job_caps_test.cpp).

#pragma once

#include <cstddef>
#include <vector>

#include "base/files/file.h"
#include "cam/job/sheet/cap_template.h"

namespace qchopper {

constexpr double tile_overlap = 20;  // a hole of a dowel with its cross lies whole on one tile

// How a drawing is divided: row by row from above, each from the left. A tile shows a window of the drawing.
struct TemplateTiles {
    Point2 paper;   // A4, upright or lying
    Point2 window;  // its size, of all tiles
    std::size_t columns = 1;
    std::size_t rows = 1;
    std::vector<Point2> corners;  // lower left corner of each window in the drawing
};

// As few tiles as possible; upright where that takes no more. Together their windows cover the drawing.
TemplateTiles tiles_of(Point2 sheet);

// Every page says which tile it is and has the title and the bar of 100 mm. Throws InputError: (io) if the PDF library
// fails, (use) for a drawing of more than 5 m.
Bytes template_pdf(const CapTemplate& drawing);

}  // namespace qchopper
