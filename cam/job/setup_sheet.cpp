// One function per section of the sheet, on helpers that escape every text. O(size of the sheet).

#include "cam/job/setup_sheet.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "base/hex.h"
#include "base/text.h"
#include "cam/job/cap_section.h"
#include "cam/job/envelope_picture.h"
#include "cam/job/envelope_section.h"
#include "cam/job/manifest.h"
#include "cam/job/program_section.h"
#include "cam/job/setup_picture.h"
#include "cam/job/sheet_html.h"
#include "segment/picture/svg.h"

namespace qchopper {
namespace {

using namespace sheet;

constexpr const char* style = R"(
  body { font: 10.5pt/1.35 sans-serif; color: #111; max-width: 190mm; margin: 8mm auto; padding: 0 4mm; }
  h1 { font-size: 17pt; margin: 0 0 2mm; }
  h2 { font-size: 12pt; margin: 5mm 0 1.5mm; border-bottom: 0.3mm solid #999; break-after: avoid; }
  p { margin: 1mm 0; }
  ul { margin: 1mm 0; padding-left: 6mm; }
  table { border-collapse: collapse; margin: 1.5mm 0; break-inside: avoid; }
  th, td { text-align: left; vertical-align: top; padding: 0.4mm 3mm 0.4mm 0; border-bottom: 0.1mm solid #ccc; }
  th { font-weight: 600; }
  .n { text-align: right; font-variant-numeric: tabular-nums; }
  .stop { border: 0.8mm solid #a00; padding: 2mm; margin: 2mm 0; font-weight: 700; }
  .key { display: inline-block; width: 4mm; height: 3mm; border: 0.2mm solid #333; }
  .sides { display: flex; gap: 2%; break-inside: avoid; }
  .sides figure { margin: 1mm 0; width: 49%; }
  .sides img { width: 100%; }
  figcaption, footer { font-size: 8.5pt; color: #444; }
  footer { margin-top: 5mm; overflow-wrap: anywhere; }
  @page { size: A4; margin: 13mm; }
  @media print {
    body { max-width: none; margin: 0; padding: 0; font-size: 9.5pt; }
    .key { print-color-adjust: exact; -webkit-print-color-adjust: exact; }
    section { break-inside: avoid; }
  }
)";

// "100 x 60.5 x 50": to tenths.
std::string size_text(Vec3 size) {
    const auto length = [](double mm) { return significant(std::round(10 * mm) / 10, 8); };
    return length(size.x) + " x " + length(size.y) + " x " + length(size.z);
}

std::string percent(double share, int decimals = 2) {
    return fixed(100 * share, decimals) + " %";
}

double degrees(double radians) {
    return radians * 180 / std::numbers::pi;
}

std::string title_of(const JobInput& input) {
    return "piece " + input.piece.name + " (" + std::to_string(input.piece_no) + " of " +
           std::to_string(input.piece_count) + ")";
}

std::string head(const JobInput& input) {
    std::string html = "<h1>" + svg_text("Setup sheet: " + title_of(input)) + "</h1>\n" +
                       paragraph("Cell " + input.cell.name + ". Lengths are in mm where nothing else is stated.");
    const auto stop = [&](const std::string& text) { html += "<p class=\"stop\">" + svg_text(text) + "</p>\n"; };
    if (!input.envelope.fits()) stop("DO NOT START: " + describe_envelope(input.piece.name, input.envelope) + ".");
    if (!input.work_envelope.holds()) {
        stop("DO NOT START: " + describe_work_envelope(input.piece.name, input.work_envelope) + ".");
    }
    if (is_unreachable(input.setup, input.max_unreachable)) {
        stop("The state of this job is \"unreachable\": the tool does not reach " +
             percent(input.setup.reach.unreachable_share()) + " of the surface, and the limit is " +
             percent(input.max_unreachable) +
             ". Foam stays there. qchopper dispatch sends the job only with --accept-unreachable.");
    }
    return html;
}

std::string figure(const std::string& file, const std::string& caption) {
    return "<figure><img src=\"" + file + "\" width=\"" + std::to_string(setup_picture_width) + "\" height=\"" +
           std::to_string(setup_picture_height) + "\" alt=\"" + svg_text(caption) + "\"><figcaption>" +
           svg_text(caption) + "</figcaption></figure>\n";
}

Entry key(Rgb colour, const std::string& text) {
    return {"<span class=\"key\" style=\"background:" + svg_colour(colour) + "\"></span> " + svg_text(text)};
}

// The colours of the pictures; none where they show the piece in one colour.
std::string keys_of(const JobInput& input) {
    std::string html;
    const auto add = [&](Rgb colour, const char* name) { html += (html.empty() ? "" : ", ") + key(colour, name).html; };
    if (!input.states.empty()) {
        add(surface_colour(SurfaceState::reached), "reached");
        add(surface_colour(SurfaceState::hidden), "hidden");
        add(surface_colour(SurfaceState::steep), "steep");
        add(surface_colour(SurfaceState::holder), "holder");
        add(surface_colour(SurfaceState::too_narrow), "too narrow");
        if (input.setup.reach.ignored_mm2 > 0) add(surface_colour(SurfaceState::ignored), "ignored");
    }
    if (input.setup.base) add(base_colour, "base");
    if (html.empty()) return {};
    return "<p>" + html + (input.states.empty() ? "" : "; what the words mean is said under 7") + ".</p>\n";
}

std::string pictures(const JobInput& input) {
    return "<div class=\"sides\">\n" +
           figure("setup-1.png",
                  "From the side of -y, a little from above. Numbered arrows: the directions of the tool.") +
           figure("setup-2.png", "From the side of +y, a little from below. P1, P2, P3: the points to touch off.") +
           "</div>\n" + keys_of(input);
}

std::string block_section(const JobInput& input) {
    const Stock& stock = input.cell.stock[input.setup.block.stock];
    const CarvingBlock& block = input.setup.block;
    std::string html = paragraph("Take block \"" + stock.name + "\" (" + to_word(stock.material) + "), " +
                                 size_text(stock.size) + " mm.");
    if (block.is_sawn && block.offcuts.empty()) {
        html += paragraph("Not sawn: what could be sawn off is no wider than the saw cut. It stands as " +
                          size_text(block.size) + " mm along x, y and z.");
    } else if (block.is_sawn) {
        html += paragraph("Saw it down to " + size_text(block.size) + " mm; a saw cut takes " +
                          significant(stock.kerf, 6) + " mm of foam.");
        Rows rows{{word("offcut that is left"), right("x"), right("y"), right("z")}};
        for (const Vec3& offcut : block.offcuts) {
            rows.push_back(
                {right(std::to_string(rows.size())), number(offcut.x, 1), number(offcut.y, 1), number(offcut.z, 1)});
        }
        html += table(rows);
    } else if (block.is_turned) {
        html += paragraph("Not sawn. It stands turned by a quarter about the vertical from how the list gives it.");
    } else {
        html += paragraph("Not sawn. It stands as the list gives it.");
    }
    return section("1. Block", html);
}

// The sides of the block lie along the axes of the cell where it is not turned.
std::string where_it_stands(const Cell& cell, const Setup& setup) {
    const BlockPlacement& place = setup.placement;
    const std::string size = size_text(setup.block.size) + " mm along x, y and z";
    const bool is_rotary = cell.machine && cell.machine->rotary_table;
    const std::string axes = is_rotary ? "the rotary table at 0 degrees" : "the cell";
    if (place.x == 0 && place.y == 0 && place.turn == 0) {
        return "Stand the block in the middle of the table, its sides along the axes of " + axes + ": " + size + ".";
    }
    std::string text = "Stand the block, " + size + ", with its middle " + fixed(place.x, 1) + " mm along x and " +
                       fixed(place.y, 1) + " mm along y from the middle of the table";
    if (place.turn == 0) return text + ", its sides along the axes of " + axes + ".";
    return text + ", its x turned by " + fixed(degrees(place.turn), 1) + " degrees from that of " + axes +
           ", counted from x towards y.";
}

std::string place_section(const JobInput& input) {
    const Setup& setup = input.setup;
    const Vec3 block = setup.block.size;
    const Vec3 piece = setup.box.size();
    const double beside_x = (block.x - piece.x) / 2;
    const double beside_y = (block.y - piece.y) / 2;
    std::string html = paragraph(where_it_stands(input.cell, setup));
    html += paragraph("How exactly it must lie: the foam around the piece is what the block may be off, " +
                      fixed(beside_x, 1) + " mm along x and " + fixed(beside_y, 1) +
                      " mm along y. Further off, the piece sticks out of the block. A turn by 1 degree moves the "
                      "corners of the block by " +
                      fixed(std::hypot(block.x, block.y) / 2 * std::sin(std::numbers::pi / 180), 1) +
                      " mm. The underside must lie flat on the table.");
    const Pose in_cell =
        setup_in_cell(input.cell, setup.spoil, {setup.placement.x, setup.placement.y, setup.placement.turn, {}}, 0);
    const bool is_rotary = input.cell.machine && input.cell.machine->rotary_table;
    html += paragraph(
        "Base frame of the program: its origin lies on the vertical through the middle of the block, at the height of "
        "the piece's base, " +
        fixed(setup.spoil, 1) +
        " mm above the table, its axes along the sides of the block, z up. In the cell it is at (" +
        fixed(in_cell.shift.x, 1) + ", " + fixed(in_cell.shift.y, 1) + ", " + fixed(in_cell.shift.z, 1) + ")" +
        (is_rotary ? " with the rotary table at 0 degrees." : "."));
    html += paragraph(
        "Touch off three corners with the tool tip: P1 and P2 give the direction of x, P3 the side of y. If one is "
        "off its place, move the block, or correct the base frame by as much.");
    Rows rows{{word("point"), word("where"), right("x"), right("y"), right("z"), right("x in the cell"),
               right("y in the cell"), right("z in the cell")}};
    for (const TouchPoint& point : touch_points(setup)) {
        const Vec3 at = apply(in_cell, point.at);
        rows.push_back({word(point.name), word(point.where), number(point.at.x, 1), number(point.at.y, 1),
                        number(point.at.z, 1), number(at.x, 1), number(at.y, 1), number(at.z, 1)});
    }
    return section("2. Place of the block and base frame", html + table(rows));
}

std::string holding_section(const Setup& setup) {
    std::string html;
    if (setup.spoil > 0) {
        html += paragraph(
            "Glue or clamp the underside of the spoil layer, which is the underside of the block, to the "
            "table. Clamps must stay within the lowest " +
            fixed(setup.spoil, 1) + " mm: above that the tool works.");
    } else {
        html += paragraph(
            "There is no spoil layer. Glue the base of the piece, which is the underside of the block, to "
            "the table: the tool works down to the table, so no clamp may hold the sides.");
    }
    return section("3. Holding", html);
}

std::string piece_section(const Setup& setup) {
    const Vec3 size = setup.box.size();
    std::string base = "Base " + std::to_string(setup.base_number) + ": " + setup.base_description;
    if (setup.base) base += ", " + fixed(setup.base_mm2 / 100, 1) + " cm2";
    return section("4. Piece", paragraph("It lies in the middle of the block, " + fixed(size.x, 1) + " mm along x, " +
                                         fixed(size.y, 1) + " mm along y, " + fixed(size.z, 1) +
                                         " mm high, its base at z = 0. preview.glb shows it as it lies.") +
                                   paragraph(base + ". Up is (" + fixed(setup.up.x, 4) + ", " + fixed(setup.up.y, 4) +
                                             ", " + fixed(setup.up.z, 4) + ") of the scan.") +
                                   paragraph("Undercut: " + percent(setup.undercut, 1) + " of the projected area, " +
                                             percent(setup.undercut_by_count, 1) + " of the triangles."));
}

std::string tool_section(const Cell& cell) {
    if (!cell.machine) {
        const Tool& tool = cell.tool;
        return section(
            "5. Tools",
            table({{right("number"), word("name"), right("diameter"), right("rpm, at most"), right("mm/min, at most")},
                   {right(std::to_string(tool.number)), word(tool.name), number(tool.diameter, 1),
                    right(std::to_string(tool.spindle_max_rpm)), right(std::to_string(tool.feed_max_mm_per_min))}}));
    }
    Rows rows{{right("number"), word("name"), word("shape"), right("diameter"), right("stick-out"),
               right("rpm, at most"), right("mm/s, at most"), word("length")}};
    for (const CarvingTool& tool : cell.machine->tools) {
        rows.push_back({right(std::to_string(tool.number)), word(tool.name), word(to_word(tool.shape)),
                        number(tool.diameter, 1), number(tool.stick_out, 1), right(std::to_string(tool.rpm_max)),
                        number(tool.feed_max_mm_per_s, 1),
                        word(tool.is_length_measured ? "measured" : "NOT MEASURED: measure it first")});
    }
    return section("5. Tools", table(rows));
}

std::vector<Entry> direction_row(const Setup& setup, const std::string& name, const SetupDirection& direction) {
    const Vec3 out = rotate(setup.piece_in_setup, direction.out);
    const bool is_vertical = std::hypot(out.x, out.y) < 1e-6;
    const double azimuth = degrees(std::atan2(out.y, out.x));
    return {word(name), number(direction.tilt_deg, 1),
            is_vertical ? right("any") : number(azimuth < -0.05 ? azimuth + 360 : azimuth, 1),
            number(100 * direction.gained_share, 1), number(direction.depth_mm, 1)};
}

std::string direction_section(const JobInput& input) {
    const SurfaceReach& reach = input.setup.reach;
    const std::string arm = paragraph(reach.is_arm_checked ? "Arm checked: it holds the tool in all these directions."
                                                           : "Arm not checked: whether it holds the tool in these "
                                                             "directions is not known.");
    if (reach.directions.empty()) return section("6. Directions", paragraph("None was chosen.") + arm);
    Rows rows{{word("direction"), right("tilt, degrees"), right("azimuth, degrees"), right("surface gained, %"),
               right("depth")}};
    for (std::size_t i = 0; i < reach.directions.size(); ++i) {
        rows.push_back(direction_row(input.setup, std::to_string(i + 1), reach.directions[i]));
    }
    if (reach.further) rows.push_back(direction_row(input.setup, "worth adding", *reach.further));
    return section(
        "6. Directions",
        table(rows) +
            paragraph("Tilt: of the tool from the vertical. Azimuth: towards which the upper end of the tool "
                      "then leans, from x towards y. Gained: reached by this direction and by none before "
                      "it. Depth: from where the tool enters the block to the deepest surface.") +
            arm);
}

std::string reach_section(const JobInput& input) {
    const SurfaceReach& reach = input.setup.reach;
    if (reach.area_mm2 <= 0) {
        return section("7. What the tool reaches", paragraph("Not judged: the pictures show the piece in one colour."));
    }
    Rows rows{{word("surface"), right("cm2"), right("% of the surface"), word("unreachable"), word("because")}};
    const auto add = [&](SurfaceState state, const char* name, double mm2, bool counts, const char* why) {
        rows.push_back({key(surface_colour(state), name), number(mm2 / 100, 1), number(100 * mm2 / reach.area_mm2, 2),
                        word(state == SurfaceState::reached ? ""
                             : counts                       ? "yes"
                                                            : "does not count"),
                        word(why)});
    };
    const double not_reached = reach.hidden_mm2 + reach.steep_mm2 + reach.holder_mm2 + reach.too_narrow_mm2;
    add(SurfaceState::reached, "reached", std::max(0.0, reach.area_mm2 - not_reached), false, "");
    add(SurfaceState::hidden, "hidden", reach.hidden_mm2, true, "in sight of no direction");
    add(SurfaceState::steep, "steep", reach.steep_mm2, reach.steep_counts, "within 3 degrees of a direction");
    add(SurfaceState::holder, "holder", reach.holder_mm2, true, "the tool is too short: its holder would touch");
    add(SurfaceState::too_narrow, "too narrow", reach.too_narrow_mm2, reach.narrow_counts,
        "the smallest tool does not fit in");
    rows.push_back({word("unreachable together"), number(reach.unreachable_mm2() / 100, 1),
                    number(100 * reach.unreachable_share(), 2), word(""), word("")});
    rows.push_back({word("limit"), word(""),
                    input.max_unreachable < 1 ? number(100 * input.max_unreachable, 2) : right("none"), word(""),
                    word("")});
    std::string html = table(rows);
    html += "<p>" + key(base_colour, "the base, which is left out of all shares").html + "</p>\n";
    if (reach.ignored_mm2 > 0) {
        html += "<p>" + key(surface_colour(SurfaceState::ignored), "ignored").html + ": " +
                fixed(reach.ignored_mm2 / 100, 1) +
                " cm2 that may stay as they are by the operator's choice; left out of all shares</p>\n";
    }
    if (input.states.empty()) {
        html += paragraph("The pictures show the piece in one colour: which triangles are reached was not computed.");
    }
    if (reach.method == ReachMethod::mapped) {
        html += table(
            {{word("foam that stays"), right("cm3"), right("depth, at most")},
             {word("where no tool of these directions reaches"), number(reach.foam_mm3 / 1000, 1),
              number(reach.foam_depth_mm, 1)},
             {word("residue of the smallest tool's radius, besides"), number(reach.residue_mm3 / 1000, 1), word("")}});
        html += paragraph("Take it off by hand.");
    } else {
        html +=
            paragraph("Judged by samples of the surface: volume and depth of the foam that stays are not computed.");
    }
    html += paragraph("With all directions that can be held, " + percent(reach.all_directions_share) +
                      " of the surface would stay out of reach.");
    return section("7. What the tool reaches", html);
}

std::string parting_section(const Setup& setup) {
    if (setup.spoil <= 0) {
        return section("8. Parting", paragraph("There is no spoil layer: loosen the piece from the table."));
    }
    const std::string area = setup.base ? ", " + fixed(setup.base_mm2 / 100, 1) + " cm2" : "";
    return section(
        "8. Parting",
        paragraph("When the program has ended, the piece stands on the spoil layer, joined to it by its base" + area +
                  ". Saw it off in the plane of its base, z = 0, " + fixed(setup.spoil, 1) +
                  " mm above the table and parallel to it. The spoil layer stays on the table and is "
                  "waste.") +
            (setup.base ? std::string()
                        : paragraph("The piece has no flat base: it touches that plane at "
                                    "its lowest point only, so finish there by hand.")));
}

std::string alternative_section(const JobInput& input) {
    if (input.alternatives.empty()) return section("9. Other bases", paragraph("None."));
    Rows rows{{right("base"), word("what it is"), word("judged by"), right("unreachable, %"), right("foam, cm3"),
               right("residue, cm3"), word("block"), right("directions")}};
    for (const Alternative& other : alternatives_of(input)) {
        const bool is_mapped = other.method == ReachMethod::mapped;
        rows.push_back({right(std::to_string(other.base_number)), word(other.base_description),
                        word(is_mapped ? "height maps" : "samples"), number(100 * other.unreachable_share, 2),
                        is_mapped ? number(other.foam_mm3 / 1000, 1) : right("-"),
                        is_mapped ? number(other.residue_mm3 / 1000, 1) : right("-"), word(size_text(other.block)),
                        right(std::to_string(other.directions))});
    }
    return section("9. Other bases", table(rows) + paragraph("qchopper setup --base takes the number of a base."));
}

std::string margin_section(const EnvelopeReport& envelope) {
    Rows rows{{word("margin"), right("mm")}};
    for (const Margin& margin : envelope.margins) rows.push_back({word(margin.name), number(margin.mm, 1)});
    return section("10. Margins", table(rows) + paragraph("What is negative does not fit."));
}

std::string warning_section(const JobInput& input) {
    std::string list;
    for (const std::vector<std::string>& warnings : {input.setup.warnings, input.warnings}) {
        for (const std::string& warning : warnings) list += "<li>" + svg_text(warning) + "</li>\n";
    }
    return section("12. Warnings", list.empty() ? paragraph("None.") : "<ul>\n" + list + "</ul>\n");
}

}  // namespace

std::string setup_sheet(const JobInput& input, std::uint32_t estimated_time_s) {
    return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<title>" +
           svg_text("Setup sheet: " + title_of(input)) + "</title>\n<style>" + style + "</style>\n</head>\n<body>\n" +
           head(input) + pictures(input) + block_section(input) + place_section(input) + holding_section(input.setup) +
           piece_section(input.setup) + tool_section(input.cell) + direction_section(input) + reach_section(input) +
           parting_section(input.setup) + alternative_section(input) + margin_section(input.envelope) +
           envelope_section(input) + warning_section(input) + program_section(input, estimated_time_s) +
           cap_section(input) + "<footer>" +
           svg_text("Project " + to_hex(input.project_id) + ". Scan " + to_hex(input.scan_sha256) +
                    ". Written by qchopper " + input.program_version + ".") +
           "</footer>\n</body>\n</html>\n";
}

}  // namespace qchopper
