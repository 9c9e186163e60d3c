// Tables of values.

#include "cam/job/sheet/program_section.h"

#include <set>

#include "base/text.h"
#include "cam/cell/job_tools.h"
#include "cam/job/job_program.h"
#include "cam/job/sheet/sheet_html.h"

namespace qchopper {
namespace {

using namespace sheet;

std::string chunks_of(const JobProgram& program) {
    Rows rows{{right("chunk"), word("file"), right("tool"), right("orientation"), right("moves"), right("length, m")}};
    for (const JobChunk& chunk : program.chunks) {
        rows.push_back({right(std::to_string(rows.size())), word(chunk.file), right(std::to_string(chunk.tool)),
                        right(std::to_string(chunk.orientation + 1)), right(with_commas(chunk.moves)),
                        number(chunk.length_mm / 1000, 1)});
    }
    return table(rows);
}

std::string left_out_of(const JobProgram& program, const std::vector<std::uint16_t>& allowed) {
    std::string html;
    if (!allowed.empty()) {
        html += paragraph("Of the cell's tools it is carved with " + describe_tools(allowed) + " alone.");
    }
    const std::string moves = describe(program.moves_left_out);
    if (!moves.empty()) html += paragraph("Left out: " + moves + ".");
    if (program.left_out.empty()) return html;
    Rows rows{{right("tool left out"), right("orientation"), word("because")}};
    for (const ToolLeftOut& tool : program.left_out) {
        rows.push_back({right(tool.tool ? std::to_string(*tool.tool) : "all"),
                        right(tool.orientation ? std::to_string(*tool.orientation + 1) : "all"), word(tool.because)});
    }
    return html + table(rows) + paragraph("The proof says how much of the surface is given up for that.");
}

// Tools that bend and chatter more than others, and where they are used.
std::string slender_tools_of(const JobProgram& program, const Cell& cell) {
    constexpr double slender = 10;  // diameters
    std::string html;
    if (!cell.machine) return html;
    for (const CuttingTool& tool : cell.machine->tools) {
        if (is_drill(tool) || tool.stick_out <= slender * tool.diameter) continue;
        std::set<std::size_t> orientations;
        for (const JobChunk& chunk : program.chunks) {
            if (chunk.tool == tool.number) orientations.insert(chunk.orientation + 1);
        }
        if (orientations.empty()) continue;
        std::string where;
        for (const std::size_t orientation : orientations) {
            where += (where.empty() ? " " : ", ") + std::to_string(orientation);
        }
        html += paragraph("Tool " + std::to_string(tool.number) + " sticks out by " +
                          fixed(tool.stick_out / tool.diameter, 1) + " diameters, in orientation" +
                          (orientations.size() > 1 ? "s" : "") + where + ": watch for chatter.");
    }
    return html;
}

std::string proof_of(const ProgramInput& input) {
    std::string html;
    if (!input.proof.is_proven()) {
        html += stop("DO NOT START: the replay of the program found faults.");
        for (const ProofFinding& finding : input.proof.findings) html += paragraph(describe(finding));
    }
    html += paragraph(
        "Proof: the files of the program were read back and replayed in a block of foam by a part of qchopper that "
        "does not know how they were made.");
    Rows rows{{word("figure"), right("value"), word("unit")}};
    for (const ProofFigure& figure : input.proof.figures) {
        rows.push_back({word(figure.name), number(figure.value, figure.decimals), word(figure.unit)});
    }
    html += table(rows);
    if (input.deviation_picture.empty()) return html;
    return html +
           figure({"deviation.png", deviation_picture_width, deviation_picture_height},
                  "The piece as the replay left it, coloured by its deviation from the piece as ordered: of each "
                  "triangle the mean of the foam left, or the deepest gouge; yellow is given up.");
}

// Where the machine time goes: one row for each kind of operation and tool.
std::string time_of(const ProofResult& proof) {
    if (proof.time.empty()) return {};
    const auto minutes = [](double seconds) { return number(seconds / 60, 1); };
    Rows rows{{word("time, min"), right("tool"), right("cutting"), right("air"), right("links"),
               right("acceleration, stops"), right("joint moves"), right("tool changes"), right("all"), right("litres"),
               right("cm3/s"), right("tool may")}};
    for (const MachineTime& time : proof.time) {
        const double rate = time.line_s() > 0 ? time.removed_mm3 / time.line_s() : 0;
        rows.push_back({word(time.operation), right(std::to_string(time.tool)), minutes(time.cutting_s),
                        minutes(time.air_s), minutes(time.link_s), minutes(time.acceleration_s),
                        minutes(time.joint_move_s), minutes(time.tool_change_s), minutes(time.seconds()),
                        number(time.removed_mm3 * 1e-6, 2), number(rate * 1e-3, 1),
                        number(time.tool_mm3_per_s * 1e-3, 1)});
    }
    return table(rows) + paragraph(
                             "Air: at feed where nothing is removed. The rate is that of lines, without joint "
                             "moves and tool changes.");
}

}  // namespace

std::string program_section(const JobInput& input) {
    constexpr const char* title = "Program and proof";
    if (!input.program) {
        return section(title, paragraph("This job holds no robot program: " + input.no_program_because + "."));
    }
    return section(title, left_out_of(input.program->program, input.setup.tools) + proof_of(*input.program) +
                              time_of(input.program->proof) + slender_tools_of(input.program->program, input.cell) +
                              chunks_of(input.program->program));
}

}  // namespace qchopper
