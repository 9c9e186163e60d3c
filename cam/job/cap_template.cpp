// One drawing for both files; the PDF is written by libharu. O(corners).

#include "cam/job/cap_template.h"

#include <hpdf.h>

#include <algorithm>
#include <array>
#include <memory>

#include "base/error.h"
#include "base/text.h"
#include "segment/picture/svg.h"

namespace qchopper {
namespace {

constexpr double margin = 12;
constexpr double foot = 26;          // below the cap, for scale bar and title
constexpr double bar = 100;          // the scale bar
constexpr double least_width = 150;  // so that bar and title have room
constexpr double mark = 4;           // beyond the rim of a hole

std::string hole_text(const JobHole& hole) {
    return significant(hole.diameter, 4) + " mm, " + significant(hole.depth, 4) + " deep" +
           (hole.by_robot ? " (robot)" : "");
}

void add_hole(CapTemplate& drawing, const JobHole& hole, Point2 at) {
    const double reach = hole.diameter / 2 + mark;
    drawing.circles.push_back({at, hole.diameter / 2});
    drawing.lines.push_back({{at.x - reach, at.y}, {at.x + reach, at.y}});
    drawing.lines.push_back({{at.x, at.y - reach}, {at.x, at.y + reach}});
    drawing.texts.push_back({{at.x, at.y - reach - 3}, 2.5, true, hole_text(hole)});
}

void add_foot(CapTemplate& drawing, const std::string& title) {
    const double y = margin + 8;
    drawing.lines.push_back({{margin, y}, {margin + bar, y}});
    for (int i = 0; i <= 10; ++i) {
        const double x = margin + bar * i / 10;
        drawing.lines.push_back({{x, y}, {x, y + (i % 5 == 0 ? 3.0 : 1.5)}});
    }
    drawing.texts.push_back(
        {{margin, y - 4}, 3, false, "100 mm: measure this bar; if it is not, print without scaling"});
    drawing.texts.push_back({{margin, margin - 4}, 3.5, false, title});
}

// The page of a PDF counts in points.
constexpr double points_per_mm = 72 / 25.4;

HPDF_REAL to_points(double mm) {
    return static_cast<HPDF_REAL>(mm * points_per_mm);
}

struct FreePdf {
    void operator()(HPDF_Doc document) const { HPDF_Free(document); }
};
using Pdf = std::unique_ptr<_HPDF_Doc_Rec, FreePdf>;

void draw_line(HPDF_Page page, const std::vector<Point2>& line, bool is_closed) {
    for (std::size_t i = 0; i < line.size(); ++i) {
        const auto to = i == 0 ? HPDF_Page_MoveTo : HPDF_Page_LineTo;
        to(page, to_points(line[i].x), to_points(line[i].y));
    }
    if (is_closed) HPDF_Page_ClosePath(page);
    HPDF_Page_Stroke(page);
}

void draw_text(HPDF_Page page, HPDF_Font font, const TemplateText& text) {
    HPDF_Page_SetFontAndSize(page, font, to_points(text.height));
    const double width =
        text.is_centred ? static_cast<double>(HPDF_Page_TextWidth(page, text.text.c_str())) / points_per_mm : 0.0;
    HPDF_Page_BeginText(page);
    HPDF_Page_TextOut(page, to_points(text.at.x - width / 2), to_points(text.at.y), text.text.c_str());
    HPDF_Page_EndText(page);
}

void draw(HPDF_Doc document, const CapTemplate& drawing) {
    HPDF_Page page = HPDF_AddPage(document);
    HPDF_Page_SetWidth(page, to_points(drawing.sheet.x));
    HPDF_Page_SetHeight(page, to_points(drawing.sheet.y));
    HPDF_Page_SetLineWidth(page, to_points(0.3));
    for (const std::vector<Point2>& outline : drawing.outlines) draw_line(page, outline, true);
    HPDF_Page_SetLineWidth(page, to_points(0.15));
    for (const std::vector<Point2>& line : drawing.lines) draw_line(page, line, false);
    for (const TemplateCircle& circle : drawing.circles) {
        HPDF_Page_Circle(page, to_points(circle.middle.x), to_points(circle.middle.y), to_points(circle.radius));
        HPDF_Page_Stroke(page);
    }
    HPDF_Font font = HPDF_GetFont(document, "Helvetica", nullptr);
    for (const TemplateText& text : drawing.texts) draw_text(page, font, text);
}

Bytes bytes_of(HPDF_Doc document) {
    Bytes bytes;
    HPDF_SaveToStream(document);
    HPDF_ResetStream(document);
    for (;;) {
        std::array<HPDF_BYTE, 4096> block;
        HPDF_UINT32 size = block.size();
        const HPDF_STATUS status = HPDF_ReadFromStream(document, block.data(), &size);
        bytes.insert(bytes.end(), block.begin(), block.begin() + size);
        if (status != HPDF_OK || size == 0) return bytes;
    }
}

std::string points_text(const std::vector<Point2>& line, double sheet_height) {
    std::string text;
    for (const Point2& p : line) text += svg_number(p.x, 3) + "," + svg_number(sheet_height - p.y, 3) + " ";
    return text;
}

}  // namespace

CapTemplate cap_template(const DrawnCap& cap, const std::string& piece) {
    CapTemplate drawing;
    drawing.sheet = {std::max(least_width, cap.size.x + 2 * margin), cap.size.y + 2 * margin + foot};
    const auto moved = [](Point2 p) { return Point2{p.x + margin, p.y + margin + foot}; };
    for (const std::vector<Point2>& outline : cap.outline) {
        drawing.outlines.emplace_back();
        for (const Point2& p : outline) drawing.outlines.back().push_back(moved(p));
    }
    std::string neighbours;
    for (std::size_t j = 0; j < cap.cap.joints.size(); ++j) {
        const CapJoint& joint = cap.cap.joints[j];
        neighbours += (j == 0 ? "" : ", ") + joint.neighbour;
        drawing.texts.push_back({moved(cap.names_at[j]), 6, true, joint.neighbour});
        for (const JobHole& hole : joint.holes) add_hole(drawing, hole, moved(hole.on_cap));
    }
    add_foot(drawing,
             "Piece " + piece + ", cut " + std::to_string(cap.cap.cut) + ", seen from outside; towards " + neighbours);
    return drawing;
}

std::string template_svg(const CapTemplate& drawing) {
    const std::string width = svg_number(drawing.sheet.x, 3);
    const std::string height = svg_number(drawing.sheet.y, 3);
    const double up = drawing.sheet.y;
    std::string svg = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" + width + "mm\" height=\"" + height +
                      "mm\" viewBox=\"0 0 " + width + " " + height +
                      "\">\n<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n<g fill=\"none\" stroke=\"#000\" "
                      "stroke-width=\"0.15\">\n";
    for (const std::vector<Point2>& outline : drawing.outlines) {
        svg += "<polygon stroke-width=\"0.3\" points=\"" + points_text(outline, up) + "\"/>\n";
    }
    for (const std::vector<Point2>& line : drawing.lines) {
        svg += "<polyline points=\"" + points_text(line, up) + "\"/>\n";
    }
    for (const TemplateCircle& circle : drawing.circles) {
        svg += "<circle cx=\"" + svg_number(circle.middle.x, 3) + "\" cy=\"" + svg_number(up - circle.middle.y, 3) +
               "\" r=\"" + svg_number(circle.radius, 3) + "\"/>\n";
    }
    svg += "</g>\n<g font-family=\"sans-serif\" fill=\"#000\">\n";
    for (const TemplateText& text : drawing.texts) {
        svg += "<text x=\"" + svg_number(text.at.x, 3) + "\" y=\"" + svg_number(up - text.at.y, 3) + "\" font-size=\"" +
               svg_number(text.height, 2) + "\"" + (text.is_centred ? " text-anchor=\"middle\"" : "") + ">" +
               svg_text(text.text) + "</text>\n";
    }
    return svg + "</g>\n</svg>\n";
}

Bytes template_pdf(const CapTemplate& drawing) {
    constexpr double largest = 5'080;  // mm, 14400 points
    if (drawing.sheet.x > largest || drawing.sheet.y > largest) {
        throw InputError(InputFault::use, "a cap is larger than a page of a PDF can be, 5 m", "cut the piece further");
    }
    const Pdf document(HPDF_New(nullptr, nullptr));
    if (!document) throw InputError(InputFault::io, "the PDF library has no memory for a template");
    draw(document.get(), drawing);
    Bytes bytes = bytes_of(document.get());
    if (bytes.empty()) throw InputError(InputFault::io, "the PDF library made no template");
    return bytes;
}

}  // namespace qchopper
