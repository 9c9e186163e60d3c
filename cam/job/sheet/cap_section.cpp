// A table per cap, and its template as a picture.

#include "cam/job/sheet/cap_section.h"

#include "base/text.h"
#include "cam/job/sheet/sheet_html.h"
#include "segment/picture/svg.h"

namespace qchopper {
namespace {

using namespace sheet;

std::string holes_of(const JobCap& cap) {
    Rows rows{{right("hole"), word("towards"), right("diameter"), right("depth"), right("x on the cap"),
               right("y on the cap"), right("x"), right("y"), right("z"), word("drilled")}};
    for (const CapJoint& joint : cap.joints) {
        for (const JobHole& hole : joint.holes) {
            rows.push_back({right(std::to_string(hole.number)), word(joint.neighbour), number(hole.diameter, 1),
                            number(hole.depth, 1), number(hole.on_cap.x, 1), number(hole.on_cap.y, 1),
                            number(hole.point.x, 1), number(hole.point.y, 1), number(hole.point.z, 1),
                            word(hole.by_robot ? "by the robot" : "by hand: " + hole.by_hand)});
        }
    }
    return rows.size() > 1 ? table(rows) : paragraph("No dowel.");
}

std::string drawing_of(const JobCap& cap) {
    const std::string svg = template_name(cap.cut, "svg");
    const std::string caption = "Cap of cut " + std::to_string(cap.cut) + " seen from outside, not in true size. " +
                                template_name(cap.cut, "pdf") + " and " + svg +
                                " are the template in true size, the PDF on pages of A4.";
    return "<figure><img src=\"" + svg + "\" style=\"max-height:120mm;width:auto\" alt=\"" + svg_text(caption) +
           "\"><figcaption>" + svg_text(caption) + "</figcaption></figure>\n";
}

}  // namespace

std::string cap_section(const JobInput& input) {
    std::string html;
    for (const DrawnCap& drawn : input.caps) {
        html += paragraph("Cap of cut " + std::to_string(drawn.cap.cut) + ":");
        for (const CapJoint& joint : drawn.cap.joints) {
            if (!joint.note.empty()) html += paragraph(joint.note + ".");
        }
        html += holes_of(drawn.cap) + drawing_of(drawn.cap);
    }
    if (html.empty()) return section("Joints", paragraph("The piece is joined to no other one."));
    return section(
        "Joints",
        paragraph("Holes for dowels are perpendicular to their cap. x, y and z are those of the setup. What is "
                  "drilled by the robot is part of the program; drill the others by hand with the template.") +
            html);
}

}  // namespace qchopper
