// The template of a cap for print, in true size: outline, holes with the numbers that they have in the job, names, and
// a bar of 100 mm to check the print.
//
// mm. Drawn as one sees the cap who looks at it. The same cap gives the same bytes
// (tests/cam/job/job_caps_test.cpp).

#pragma once

#include <string>
#include <vector>

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
    std::string title;  // stands on every sheet
};

CapTemplate cap_template(const DrawnCap& cap, const std::string& piece);

// Draws a bar of 100 mm from there along x, divided into ten, and below it what it is for.
void add_scale_bar(CapTemplate& drawing, Point2 at);

// On one sheet, with title and bar.
std::string template_svg(const CapTemplate& drawing);

}  // namespace qchopper
