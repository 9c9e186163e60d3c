// One function per section, on helpers that escape every text. O(size of the details).

#include "cam/job/sheet/sheet_details.h"

#include <algorithm>
#include <cmath>

#include "base/hex.h"
#include "base/text.h"
#include "base/units.h"
#include "cam/job/manifest.h"
#include "cam/job/sheet/envelope_section.h"
#include "cam/job/sheet/glue_section.h"
#include "cam/job/sheet/holding_section.h"
#include "cam/job/sheet/program_section.h"
#include "cam/job/sheet/setup_picture.h"
#include "cam/job/sheet/sheet_html.h"
#include "segment/picture/svg.h"

namespace qchopper {
namespace {

using namespace sheet;

std::string piece_section(const Setup& setup) {
    const Vec3 size = setup.box.size();
    std::string base = "Base " + std::to_string(setup.base_number) + ": " + setup.base_description;
    if (setup.base) base += ", " + fixed(setup.base_mm2 / 100, 1) + " cm2";
    const std::string where = setup.flush_caps.empty() ? "It lies in the middle of the block, "
                                                       : "Its caps lie in the glue faces of the block, it is ";
    return section("Piece",
                   paragraph(where + fixed(size.x, 1) + " mm along x, " + fixed(size.y, 1) + " mm along y, " +
                             fixed(size.z, 1) + " mm high, its base at z = 0. preview.glb shows it as it lies.") +
                       paragraph(base + ". Up is (" + fixed(setup.up.x, 4) + ", " + fixed(setup.up.y, 4) + ", " +
                                 fixed(setup.up.z, 4) + ") of the scan.") +
                       paragraph("Undercut: " + percent(setup.undercut, 1) + " of the projected area, " +
                                 percent(setup.undercut_by_count, 1) + " of the triangles."));
}

std::vector<Entry> direction_row(const Setup& setup, const std::string& name, const ToolOrientation& orientation) {
    const Vec3 tool_axis = setup.tool_axis(orientation);
    const bool is_vertical = std::hypot(tool_axis.x, tool_axis.y) < 1e-6;
    const double azimuth = degrees(std::atan2(tool_axis.y, tool_axis.x));
    return {word(name), number(orientation.tilt_deg, 1),
            is_vertical ? right("any") : number(azimuth < -0.05 ? azimuth + 360 : azimuth, 1),
            number(100 * orientation.gained_share, 1), number(orientation.depth_mm, 1)};
}

std::string direction_section(const JobInput& input) {
    const SurfaceAccess& access = input.setup.access;
    const std::string arm =
        paragraph(access.is_arm_checked ? "Arm checked: it holds the tool in all these orientations."
                                        : "Arm not checked: whether it holds the tool in these "
                                          "orientations is not known.");
    if (access.orientations.empty()) return section("Tool orientations", paragraph("None was chosen.") + arm);
    Rows rows{{word("orientation"), right("tilt, degrees"), right("azimuth, degrees"), right("surface gained, %"),
               right("depth")}};
    for (std::size_t i = 0; i < access.orientations.size(); ++i) {
        rows.push_back(direction_row(input.setup, std::to_string(i + 1), access.orientations[i]));
    }
    if (access.further) rows.push_back(direction_row(input.setup, "worth adding", *access.further));
    return section(
        "Tool orientations",
        table(rows) +
            paragraph("Tilt: of the tool from the vertical. Azimuth: towards which the upper end of the tool "
                      "then leans, from x towards y. Gained: reached in this orientation and in none before "
                      "it. Depth: from where the tool enters the block to the deepest surface.") +
            arm);
}

std::string access_section(const JobInput& input) {
    constexpr const char* title = "What the tool does not reach";
    const SurfaceAccess& access = input.setup.access;
    if (access.area_mm2 <= 0)
        return section(title, paragraph("Not judged: the pictures show the piece in one colour."));
    Rows rows{{word("surface"), right("cm2"), right("% of the surface"), word("because")}};
    std::string besides;
    const auto add = [&](SurfaceState state, const char* name, double mm2, bool counts, const char* why) {
        const Entry in_colour = key(svg_colour(surface_colour(state, access.narrow_counts)), name);
        if (counts) {
            rows.push_back({in_colour, number(mm2 / 100, 1), number(100 * mm2 / access.area_mm2, 2), word(why)});
        } else if (mm2 > 0) {
            besides += "<p>" + in_colour.html + svg_text(": " + fixed(mm2 / 100, 1) + " cm2, " + why) +
                       "; does not count</p>\n";
        }
    };
    add(SurfaceState::hidden, "hidden", access.hidden_mm2, true, "in sight of no direction");
    add(SurfaceState::steep, "steep", access.steep_mm2, access.steep_counts, "within 3 degrees of a direction");
    add(SurfaceState::holder, "holder", access.holder_mm2, true, "the tool is too short: its holder would touch");
    add(SurfaceState::too_narrow, "too narrow", access.too_narrow_mm2, access.narrow_counts,
        "the smallest tool does not fit in");
    add(SurfaceState::ignored, "ignored", access.ignored_mm2, false, "may stay as it is by the operator's choice");
    rows.push_back({word("unreachable together"), number(access.unreachable_mm2() / 100, 1),
                    number(100 * access.unreachable_share(), 2), word("")});
    rows.push_back({word("limit"), word(""),
                    input.max_unreachable < 1 ? number(100 * input.max_unreachable, 2) : right("none"), word("")});
    std::string html = table(rows) + besides + "<p>" +
                       key(svg_colour(base_colour), "the base, which is left out of all shares").html + "</p>\n";
    if (const std::string glued = glue_keys(input); !glued.empty()) {
        html += "<p>" + glued + svg_text(": sawn, and left out of all shares") + "</p>\n";
    }
    if (input.states.empty()) {
        html += paragraph("The pictures show the piece in one colour: which triangles are reached was not computed.");
    }
    if (access.method == AccessMethod::mapped) {
        html += table({{word("foam that stays"), right("cm3"), right("depth, at most")},
                       {word("where no tool in these orientations reaches"), number(access.foam_mm3 / 1000, 1),
                        number(access.foam_depth_mm, 1)},
                       {word("rest material of the smallest tool's radius, besides"),
                        number(access.rest_material_mm3 / 1000, 1), word("")}});
    } else {
        html +=
            paragraph("Judged by samples of the surface: volume and depth of the foam that stays are not computed.");
    }
    return section(title, html);
}

std::string alternative_section(const JobInput& input) {
    if (input.alternatives.empty()) return section("Other bases", paragraph("None."));
    Rows rows{{right("base"), word("what it is"), word("judged by"), right("unreachable, %"), right("foam, cm3"),
               right("rest material, cm3"), word("block"), right("orientations")}};
    for (const Alternative& other : alternatives_of(input)) {
        const bool is_mapped = other.method == AccessMethod::mapped;
        rows.push_back({right(std::to_string(other.base_number)), word(other.base_description),
                        word(is_mapped ? "height maps" : "samples"), number(100 * other.unreachable_share, 2),
                        is_mapped ? number(other.foam_mm3 / 1000, 1) : right("-"),
                        is_mapped ? number(other.rest_material_mm3 / 1000, 1) : right("-"),
                        word(size_text(other.block)), right(std::to_string(other.directions))});
    }
    return section("Other bases",
                   table(rows) + paragraph("The setup of a piece can be decided by the number of a base."));
}

std::string margin_section(const StockFit& stock_fit) {
    Rows rows{{word("margin"), right("mm")}};
    for (const Margin& margin : stock_fit.margins) rows.push_back({word(margin.name), number(margin.mm, 1)});
    return section("Margins", table(rows) + paragraph("What is negative does not fit."));
}

std::string warning_section(const JobInput& input) {
    std::string list;
    for (const std::string& warning : warnings_of(input)) list += "<li>" + svg_text(warning) + "</li>\n";
    return section("Warnings", list.empty() ? paragraph("None.") : "<ul>\n" + list + "</ul>\n");
}

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

// A table per cap, and its template as a picture; a sentence if the piece has no joint.
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

}  // namespace

std::string title_of(const JobInput& input) {
    return "piece " + input.piece.name + " (" + std::to_string(input.piece_no) + " of " +
           std::to_string(input.piece_count) + ")";
}

std::vector<std::string> warnings_of(const JobInput& input) {
    std::vector<std::string> all = input.setup.warnings;
    all.insert(all.end(), input.warnings.begin(), input.warnings.end());
    return all;
}

std::string sheet_footer(const JobInput& input) {
    return "<footer>" +
           svg_text("Project " + to_hex(input.project_id) + ". Scan " + to_hex(input.scan_sha256) +
                    ". Written by qchopper " + input.program_version + ".") +
           "</footer>\n";
}

std::string sheet_details(const JobInput& input) {
    return document("Details: " + title_of(input),
                    page_begin + ("<h1>" + svg_text("Details: " + title_of(input)) + "</h1>\n") +
                        paragraph("Behind the setup sheet, setup.html: why the piece lies as it lies, and what was "
                                  "checked. Lengths are in mm where nothing else is stated.") +
                        warning_section(input) + piece_section(input.setup) + direction_section(input) +
                        access_section(input) + cap_section(input) + program_section(input) + envelope_section(input) +
                        margin_section(input.stock_fit) + formula_section(input.setup) + alternative_section(input) +
                        sheet_footer(input) + page_end);
}

}  // namespace qchopper
