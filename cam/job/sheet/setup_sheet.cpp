// One function per section of the page. What may be long, names and reasons, is cut short: the page is one page of A4,
// and the details have the whole. O(size of the sheet).

#include "cam/job/sheet/setup_sheet.h"

#include <algorithm>
#include <vector>

#include "base/text.h"
#include "cam/job/glue_faces.h"
#include "cam/job/job_program.h"
#include "cam/job/sheet/glue_section.h"
#include "cam/job/sheet/holding_section.h"
#include "cam/job/sheet/place_section.h"
#include "cam/job/sheet/setup_picture.h"
#include "cam/job/sheet/sheet_details.h"
#include "cam/job/sheet/sheet_html.h"
#include "segment/picture/svg.h"

namespace qchopper {
namespace {

using namespace sheet;

constexpr std::size_t longest_line = 150;  // bytes of a warning
constexpr std::size_t longest_stop = 300;
constexpr std::size_t max_warnings = 4;

std::string head(const JobInput& input) {
    const JobPart part = input.program ? input.program->program.part : JobPart{};
    std::string html = "<h1>" + svg_text("Setup sheet: " + title_of(input)) + "</h1>\n" +
                       paragraph("Cell " + input.cell.name + ". Lengths are in mm where nothing else is stated.");
    const auto refuse = [&](const std::string& why) { html += stop(clipped("DO NOT START: " + why, longest_stop)); };
    if (part.count > 1) {
        html += stop("Part " + std::to_string(part.number) + " of " + std::to_string(part.count) +
                     ": carved one after the other from the same block, which must not be moved between them.");
    }
    if (!input.stock_fit.fits()) refuse(describe_stock_fit(input.piece.name, input.stock_fit) + ".");
    if (!input.machine_reachability.holds())
        refuse(describe_reachability(input.piece.name, input.machine_reachability) + ".");
    if (input.program && !input.program->proof.is_proven()) {
        const std::vector<ProofFinding>& findings = input.program->proof.findings;
        const std::string first = findings.empty() ? std::string() : ": " + describe(findings.front());
        refuse("the replay of the program found faults" + first + ".");
    }
    if (input.setup.workholding && !input.setup.workholding->passes()) {
        html += stop("The piece is not held safely: " + workholding_problem(*input.setup.workholding) +
                     ". See 3. Holding.");
    }
    if (is_unreachable(input.setup, input.max_unreachable)) {
        html += stop(
            "The state of this job is \"unreachable\": it is sent only if the foam that stays is accepted "
            "(section 6).");
    }
    return html;
}

// The colours of the pictures; none where they show the piece in one colour.
std::string keys_of(const JobInput& input) {
    std::string html;
    const auto add = [&](Rgb colour, const char* name) {
        html += (html.empty() ? "" : ", ") + key(svg_colour(colour), name).html;
    };
    const SurfaceAccess& access = input.setup.access;
    const auto add_state = [&](SurfaceState state, const char* name) {
        add(surface_colour(state, access.narrow_counts), name);
    };
    if (!input.states.empty()) {
        add_state(SurfaceState::reached, "reached");
        add_state(SurfaceState::hidden, "hidden");
        add_state(SurfaceState::steep, "steep");
        add_state(SurfaceState::holder, "holder");
        add_state(SurfaceState::too_narrow, access.narrow_counts ? "too narrow" : "too narrow (does not count)");
        if (access.ignored_mm2 > 0) add_state(SurfaceState::ignored, "ignored");
    }
    if (input.setup.base) add(base_colour, "base");
    if (const std::string glued = glue_keys(input); !glued.empty()) html += (html.empty() ? "" : ", ") + glued;
    if (html.empty()) return {};
    return "<p>" + html + (input.states.empty() ? "" : "; what the words mean is said in details.html") + ".</p>\n";
}

std::string pictures(const JobInput& input) {
    const auto side = [](const char* file, const char* caption) {
        return figure({file, setup_picture_width, setup_picture_height}, caption);
    };
    return "<div class=\"sides\">\n" +
           side("setup-1.png", "From the side of -y, a little from above. Arrows: the tool orientations.") +
           side("setup-2.png", "From the side of +y, a little from below. P1, P2, P3: the points to touch off.") +
           "</div>\n" + keys_of(input);
}

std::string block_section(const JobInput& input) {
    const Stock& stock = input.cell.stock[input.setup.block.stock];
    const StockBlock& block = input.setup.block;
    std::string html = paragraph("Take block \"" + stock.name + "\" (" + to_word(stock.material) + "), " +
                                 size_text(stock.size) + " mm.");
    if (block.is_sawn && !is_sawn_down(input.setup)) {
        html += paragraph("Not sawn: what could be sawn off is no wider than the saw cut. It stands as " +
                          size_text(block.size) + " mm along x, y and z.");
    } else if (block.is_sawn) {
        html += paragraph("Saw it down to " + size_text(block.size, input.setup.flush_faces()) +
                          " mm; a saw cut takes " + significant(stock.kerf, 6) + " mm of foam.");
        std::string offcuts;
        for (const Vec3& offcut : block.offcuts) offcuts += (offcuts.empty() ? "" : ", ") + size_text(offcut);
        html += paragraph("Offcuts that are left: " + (offcuts.empty() ? "none." : offcuts + " mm."));
    } else if (block.is_turned) {
        html += paragraph("Not sawn. It stands turned by a quarter about the vertical from how the list gives it.");
    } else {
        html += paragraph("Not sawn. It stands as the list gives it.");
    }
    return section("1. Block", html + glue_face_section(input));
}

// Of the cell's tools those that the program takes, in its order; without a program the one that the ticket names.
std::vector<std::uint16_t> used_tools(const JobInput& input) {
    if (!input.program) return {input.cell.tool.number};
    std::vector<std::uint16_t> numbers;
    for (const std::uint16_t number : input.program->tools) {
        if (std::find(numbers.begin(), numbers.end(), number) == numbers.end()) numbers.push_back(number);
    }
    return numbers;
}

std::string tool_section(const JobInput& input) {
    const Cell& cell = input.cell;
    Rows rows;
    if (!cell.machine) {
        const Tool& tool = cell.tool;
        rows = {{right("number"), word("name"), right("diameter"), right("rpm, at most"), right("mm/min, at most")},
                {right(std::to_string(tool.number)), word(tool.name), number(tool.diameter, 1),
                 right(std::to_string(tool.spindle_max_rpm)), right(std::to_string(tool.feed_max_mm_per_min))}};
        return section("4. Tools", table(rows));
    }
    rows = {{right("number"), word("name"), word("shape"), right("diameter"), right("stick-out"), right("rpm, at most"),
             right("mm/s, at most"), word("length")}};
    const std::vector<std::uint16_t> used = used_tools(input);
    for (const std::uint16_t wanted : used) {
        for (const CuttingTool& tool : cell.machine->tools) {
            if (tool.number != wanted) continue;
            rows.push_back({right(std::to_string(tool.number)), word(tool.name), word(to_word(tool.shape)),
                            number(tool.diameter, 1), number(tool.stick_out, 1), right(std::to_string(tool.rpm_max)),
                            number(tool.feed_max_mm_per_s, 1),
                            word(tool.is_length_measured ? "measured" : "NOT MEASURED: measure it first")});
        }
    }
    std::string html = table(rows);
    if (input.program && input.program->tools.size() > used.size()) {
        html += paragraph("A tool is taken more than once: the program says when.");
    }
    return section("4. Tools", html);
}

std::string start_section(const JobInput& input, std::uint32_t seconds) {
    if (!input.program) {
        return section(
            "5. Program and time",
            paragraph(clipped("This job holds no robot program: " + input.no_program_because, longest_stop) + ".") +
                paragraph("About " + duration(seconds) + ". Crude: foam to remove over " +
                          fixed(input.cell.tool.removal_mm3_per_s / 1000, 1) + " cm3/s, no finishing, no travel."));
    }
    const JobProgram& program = input.program->program;
    double length_mm = 0;
    for (const JobChunk& chunk : program.chunks) length_mm += chunk.length_mm;
    return section("5. Program and time",
                   paragraph("About " + duration(seconds) + ", path of " + fixed(length_mm / 1000, 0) +
                             " m, started as " + program.entry + " (" + to_word(program.dialect) + "), " +
                             counted(program.chunks.size(), "chunk") + "."));
}

// The only figure of the sheet for what stays out of reach: that by which the job is judged.
std::string foam_that_stays(const JobInput& input) {
    const SurfaceAccess& access = input.setup.access;
    if (access.area_mm2 <= 0) return paragraph("What the tool reaches was not judged.");
    std::string text = "Out of reach of the tool: " + percent(access.unreachable_share()) + " of the surface" +
                       (input.max_unreachable < 1 ? ", limit " + percent(input.max_unreachable) : std::string()) + ".";
    if (access.method == AccessMethod::mapped) {
        text += " " + fixed(access.foam_mm3 / 1000, 1) + " cm3 of foam stay there, up to " +
                fixed(access.foam_depth_mm, 1) + " mm deep: take it off by hand.";
    }
    return paragraph(text);
}

// What the program does not mill; the details say of tools and directions why.
std::string left_out(const JobInput& input) {
    if (!input.program) return {};
    const JobProgram& program = input.program->program;
    std::string html;
    const std::string moves = describe(program.moves_left_out);
    if (!moves.empty()) html += paragraph(clipped("Foam stays: " + moves, longest_line) + ".");
    if (!program.left_out.empty()) {
        html += paragraph("Tools or orientations left out: " + std::to_string(program.left_out.size()) +
                          ", details.html says why.");
    }
    return html;
}

std::string parting(const Setup& setup) {
    if (setup.spoil <= 0) return paragraph("There is no spoil layer: loosen the piece from the table.");
    const std::string area = setup.base ? ", " + fixed(setup.base_mm2 / 100, 1) + " cm2" : "";
    return paragraph("The piece stands on the spoil layer, joined to it by its base" + area +
                     ". Saw it off in the plane of its base, z = 0, " + fixed(setup.spoil, 1) +
                     " mm above the table and parallel to it. The spoil layer stays on the table and is waste." +
                     (setup.base ? "" : " The piece has no flat base: finish there by hand."));
}

// Those that are left: of sawn sides the block has its holes already (glue_face_section).
std::string dowel_holes(const JobInput& input) {
    std::size_t robot = 0;
    std::string by_hand;  // numbers and templates
    for (const DrawnCap& drawn : input.caps) {
        if (is_drilled_before(input.setup, drawn.cap)) continue;
        std::string numbers;
        for (const JobHole& hole : holes_of({drawn.cap})) {
            if (hole.by_robot) ++robot;
            if (!hole.by_robot) numbers += (numbers.empty() ? "" : ", ") + std::to_string(hole.number);
        }
        if (numbers.empty()) continue;
        by_hand += (by_hand.empty() ? "" : "; ") + numbers + " by " + template_name(drawn.cap.cut, "pdf");
    }
    std::string text;
    if (robot > 0) text += "The robot drills " + counted(robot, "hole") + " for dowels. ";
    if (!by_hand.empty()) text += clipped("Drill by hand: " + by_hand, longest_line) + ". ";
    return text.empty() ? text : paragraph(text + "details.html lists all holes.");
}

std::string end_section(const JobInput& input) {
    return section("6. When the program has ended",
                   parting(input.setup) + foam_that_stays(input) + left_out(input) + dowel_holes(input));
}

std::string warning_section(const JobInput& input) {
    const std::vector<std::string> all = warnings_of(input);
    std::string list;
    for (std::size_t i = 0; i < std::min(all.size(), max_warnings); ++i) {
        list += "<li>" + svg_text(clipped(all[i], longest_line)) + "</li>\n";
    }
    if (all.size() > max_warnings) {
        list += "<li>" + std::to_string(all.size() - max_warnings) + " more in details.html</li>\n";
    }
    return section("7. Warnings", list.empty() ? paragraph("None.") : "<ul>\n" + list + "</ul>\n");
}

}  // namespace

std::string setup_sheet(const JobInput& input, std::uint32_t estimated_time_s) {
    return document("Setup sheet: " + title_of(input),
                    page_begin + head(input) + pictures(input) + block_section(input) + place_section(input) +
                        holding_section(input.setup) + tool_section(input) + start_section(input, estimated_time_s) +
                        end_section(input) + warning_section(input) + sheet_footer(input) + page_end);
}

}  // namespace qchopper
