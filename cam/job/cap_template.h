// The template of a cap for print, in true size: outline, holes, names, and a bar of 100 mm to check the print.
//
// mm. Drawn as one sees the cap who looks at it. The same cap gives the same bytes
// (tests/cam/job/job_caps_test.cpp).

#pragma once

#include <string>
#include <vector>

#include "base/file.h"
#include "cam/job/job_cap.h"

namespace qchopper {

struct TemplateCircle {
    Point2 middle;
    double radius = 0;
};

struct TemplateText {
    Point2 at;          // where it begins, or its middle
    double height = 0;  // of the font
    bool is_centred = false;
    std::string text;
};

// What is drawn, from the lower left corner of the sheet, y upwards.
struct CapTemplate {
    Point2 sheet;  // its size
    std::vector<std::vector<Point2>> outlines;
    std::vector<std::vector<Point2>> lines;
    std::vector<TemplateCircle> circles;
    std::vector<TemplateText> texts;
};

CapTemplate cap_template(const DrawnCap& cap, const std::string& piece);

std::string template_svg(const CapTemplate& drawing);
// Throws InputError (io) if the PDF library fails; (use) for a sheet larger than a PDF page can be, 5 m.
Bytes template_pdf(const CapTemplate& drawing);

}  // namespace qchopper
