// Tables of values.

#include "cam/job/program_section.h"

#include "base/text.h"
#include "cam/job/sheet_html.h"
#include "segment/picture/svg.h"

namespace qchopper {
namespace {

using namespace sheet;

constexpr const char* title = "13. Program and time";

std::string without_program(const JobInput& input, std::uint32_t seconds) {
    return section(
        title, paragraph("This job holds no robot program: " + input.no_program_because + ".") +
                   paragraph("About " + duration(seconds) + ". Crude: foam to remove over " +
                             fixed(input.cell.tool.removal_mm3_per_s / 1000, 1) + " cm3/s, no finishing, no travel."));
}

std::string part_of(const JobPart& part) {
    if (part.count <= 1) return {};
    std::string text = "This is part " + std::to_string(part.number) + " of " + std::to_string(part.count) +
                       " of this piece: the program exceeds the controller's memory, and its parts are carved one "
                       "after the other from the same block, which must not be moved between them.";
    return paragraph(text);
}

std::string chunks_of(const JobProgram& program) {
    Rows rows{{right("chunk"), word("file"), right("tool"), right("direction"), right("moves"), right("length, m")}};
    for (const JobChunk& chunk : program.chunks) {
        rows.push_back({right(std::to_string(rows.size())), word(chunk.file), right(std::to_string(chunk.tool)),
                        right(std::to_string(chunk.direction + 1)), right(with_commas(chunk.moves)),
                        number(chunk.length_mm / 1000, 1)});
    }
    return table(rows);
}

std::string tools_of(const ProgramInput& input) {
    std::string text = "Tools, in the order in which the program takes them: ";
    for (std::size_t i = 0; i < input.tools.size(); ++i) {
        text += (i == 0 ? "" : ", ") + std::to_string(input.tools[i]);
    }
    return paragraph(text + ". Section 5 describes them.");
}

std::string proof_of(const ProgramInput& input) {
    std::string html;
    if (!input.is_proven) {
        html += "<p class=\"stop\">" + svg_text("DO NOT START: the replay of the program found faults.") + "</p>\n";
        for (const std::string& finding : input.findings) html += paragraph(finding);
    }
    html += paragraph(
        "Proof: the files of the program were read back and replayed in a block of foam by a part of qchopper that "
        "does not know how they were made.");
    Rows rows{{word("figure"), right("value"), word("unit")}};
    for (const ProofFigure& figure : input.figures) {
        rows.push_back({word(figure.name), number(figure.value, figure.decimals), word(figure.unit)});
    }
    html += table(rows);
    if (input.deviation_picture.empty()) return html;
    const std::string caption = "The piece as the replay left it, coloured by its deviation from the piece as ordered.";
    return html + "<figure><img src=\"deviation.png\" width=\"" + std::to_string(deviation_picture_width) +
           "\" height=\"" + std::to_string(deviation_picture_height) + "\" style=\"width:100%;height:auto\" alt=\"" +
           svg_text(caption) + "\"><figcaption>" + svg_text(caption) + "</figcaption></figure>\n";
}

}  // namespace

std::string program_section(const JobInput& input, std::uint32_t estimated_time_s) {
    if (!input.program) return without_program(input, estimated_time_s);
    const JobProgram& program = input.program->program;
    double length_mm = 0;
    for (const JobChunk& chunk : program.chunks) length_mm += chunk.length_mm;
    return section(title,
                   part_of(program.part) +
                       paragraph("About " + duration(estimated_time_s) + ", path of " + fixed(length_mm / 1000, 0) +
                                 " m, started as " + program.entry + " (" + to_word(program.dialect) + ").") +
                       tools_of(*input.program) + proof_of(*input.program) + chunks_of(program));
}

}  // namespace qchopper
