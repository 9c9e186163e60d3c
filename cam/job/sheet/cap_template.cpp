// One drawing for both files. O(corners).

#include "cam/job/sheet/cap_template.h"

#include <algorithm>

#include "base/text.h"
#include "segment/picture/svg.h"

namespace qchopper {
namespace {

constexpr double margin = 6;
constexpr double foot = 26;        // below the cap, for scale bar and title
constexpr double min_width = 150;  // so that bar and title have room
constexpr double mark = 4;         // beyond the rim of a hole

std::string hole_text(const JobHole& hole) {
    return significant(hole.diameter, 4) + " mm, " + significant(hole.depth, 4) + " deep" +
           (hole.by_robot ? " (robot)" : "");
}

void add_hole(CapTemplate& drawing, const JobHole& hole, Point2 at) {
    const double reach = hole.diameter / 2 + mark;
    drawing.circles.push_back({at, hole.diameter / 2});
    drawing.lines.push_back({{at.x - reach, at.y}, {at.x + reach, at.y}});
    drawing.lines.push_back({{at.x, at.y - reach}, {at.x, at.y + reach}});
    drawing.texts.push_back({{at.x + reach, at.y + 1}, 5, false, std::to_string(hole.number)});
    drawing.texts.push_back({{at.x, at.y - reach - 3}, 2.5, true, hole_text(hole)});
}

// With a foot below it that holds title and scale bar.
CapTemplate with_foot(const CapTemplate& drawing) {
    CapTemplate all = drawing;
    all.sheet = {std::max(min_width, drawing.sheet.x), drawing.sheet.y + foot};
    const auto raise = [](Point2& p) { p.y += foot; };
    for (std::vector<Point2>& outline : all.outlines) std::for_each(outline.begin(), outline.end(), raise);
    for (std::vector<Point2>& line : all.lines) std::for_each(line.begin(), line.end(), raise);
    for (TemplateCircle& circle : all.circles) raise(circle.middle);
    for (TemplateText& text : all.texts) raise(text.at);
    add_scale_bar(all, {margin, margin + 8});
    all.texts.push_back({{margin, margin - 4}, 3.5, false, drawing.title});
    return all;
}

std::string points_text(const std::vector<Point2>& line, double sheet_height) {
    std::string text;
    for (const Point2& p : line) text += fixed(p.x, 3) + "," + fixed(sheet_height - p.y, 3) + " ";
    return text;
}

}  // namespace

void add_scale_bar(CapTemplate& drawing, Point2 at) {
    constexpr double bar = 100;
    drawing.lines.push_back({at, {at.x + bar, at.y}});
    for (int i = 0; i <= 10; ++i) {
        const double x = at.x + bar * i / 10;
        drawing.lines.push_back({{x, at.y}, {x, at.y + (i % 5 == 0 ? 3.0 : 1.5)}});
    }
    drawing.texts.push_back(
        {{at.x, at.y - 4}, 3, false, "100 mm: measure this bar; if it is not, print without scaling"});
}

CapTemplate cap_template(const DrawnCap& cap, const std::string& piece) {
    CapTemplate drawing;
    Rectangle2 drawn;
    drawn.include({0, 0});
    drawn.include(cap.size);
    for (const Point2& corner : cap.block_side) drawn.include(corner);
    drawing.sheet = {drawn.max.x - drawn.min.x + 2 * margin, drawn.max.y - drawn.min.y + 2 * margin};
    const auto moved = [&](Point2 p) { return Point2{p.x - drawn.min.x + margin, p.y - drawn.min.y + margin}; };
    std::vector<std::vector<Point2>> outlines = cap.outline;
    if (!cap.block_side.empty()) outlines.push_back(cap.block_side);
    for (const std::vector<Point2>& outline : outlines) {
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
    drawing.title =
        "Piece " + piece + ", cut " + std::to_string(cap.cap.cut) + ", seen from outside; towards " + neighbours;
    if (!cap.block_side.empty()) drawing.title += "; outside: the edges of the block";
    return drawing;
}

std::string template_svg(const CapTemplate& cap) {
    const CapTemplate drawing = with_foot(cap);
    const std::string width = fixed(drawing.sheet.x, 3);
    const std::string height = fixed(drawing.sheet.y, 3);
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
        svg += "<circle cx=\"" + fixed(circle.middle.x, 3) + "\" cy=\"" + fixed(up - circle.middle.y, 3) + "\" r=\"" +
               fixed(circle.radius, 3) + "\"/>\n";
    }
    svg += "</g>\n<g font-family=\"sans-serif\" fill=\"#000\">\n";
    for (const TemplateText& text : drawing.texts) {
        svg += "<text x=\"" + fixed(text.at.x, 3) + "\" y=\"" + fixed(up - text.at.y, 3) + "\" font-size=\"" +
               fixed(text.height, 2) + "\"" + (text.is_centred ? " text-anchor=\"middle\"" : "") + ">" +
               svg_text(text.text) + "</text>\n";
    }
    return svg + "</g>\n</svg>\n";
}

}  // namespace qchopper
