// One function per step of the sheet.

#include "cam/job/setup_sheet.h"

#include <algorithm>

#include "base/hex.h"
#include "base/text.h"

namespace qchopper {
namespace {

std::string title(const JobInput& input) {
    std::string text = "SETUP SHEET   piece " + input.piece.name + " (" + std::to_string(input.piece_no) + " of " +
                       std::to_string(input.piece_count) + ")   cell " + input.cell.name + "\n";
    text += std::string(text.size() - 1, '=') + "\n";
    if (!input.envelope.fits()) {
        text += "\nDO NOT START: " + describe_envelope(input.piece.name, input.envelope) + ".\n";
    }
    return text;
}

std::string block_step(const JobInput& input) {
    const Stock& stock = input.cell.stock[input.setup.block.stock];
    const Vec3 block = input.setup.block.size;
    return "\n1. Block\n   Take block \"" + stock.name + "\" (" + to_word(stock.material) + "), " + fixed(block.x, 0) +
           " x " + fixed(block.y, 0) + " x " + fixed(block.z, 0) + " mm.\n   Stand it in the middle of the table, " +
           fixed(block.x, 0) + " mm along x, " + fixed(block.y, 0) + " mm along y, " + fixed(block.z, 0) +
           " mm high, and fasten it.\n";
}

std::string piece_step(const JobInput& input) {
    const Setup& setup = input.setup;
    const Vec3 size = setup.box.size();
    std::string text = "\n2. Piece\n   It lies in the middle of the block, " + fixed(size.x, 1) + " mm along x, " +
                       fixed(size.y, 1) + " mm along y, " + fixed(size.z, 1) +
                       " mm high,\n   with its underside on the table. preview.glb shows it as it lies.\n";
    text += "   Base: " + setup.base_description;
    if (setup.base) text += ", " + fixed(setup.base_mm2 / 100, 1) + " cm2";
    text += ".\n   Up is (" + fixed(setup.up.x, 4) + ", " + fixed(setup.up.y, 4) + ", " + fixed(setup.up.z, 4) +
            ") of the scan.\n";
    return text + "   Undercut " + fixed(100 * setup.undercut, 1) + " %.\n";
}

std::string tool_step(const JobInput& input, std::uint32_t seconds) {
    const Tool& tool = input.cell.tool;
    return "\n3. Tool\n   Number " + std::to_string(tool.number) + ", " + tool.name + ", diameter " +
           fixed(tool.diameter, 1) + " mm, at most " + std::to_string(tool.spindle_max_rpm) + " rpm and " +
           std::to_string(tool.feed_max_mm_per_min) + " mm/min.\n" + "\n4. Time\n   About " + duration(seconds) +
           ". Crude: foam to remove over " + fixed(tool.removal_mm3_per_s / 1000, 1) +
           " cm3/s, no finishing, no travel.\n";
}

std::string margin_step(const JobInput& input) {
    std::string text = "\n5. Margins (mm; negative does not fit)\n";
    for (const Margin& margin : input.envelope.margins) {
        const std::string number = fixed(margin.mm, 1);
        const std::size_t gap = 44 - std::min<std::size_t>(43, margin.name.size() + number.size());
        text += "   " + margin.name + std::string(gap, ' ') + number + "\n";
    }
    return text;
}

std::string warning_step(const JobInput& input) {
    std::string text = "\n6. Warnings\n";
    for (const std::string& warning : input.setup.warnings) text += "   - " + warning + "\n";
    for (const std::string& warning : input.warnings) text += "   - " + warning + "\n";
    if (input.setup.warnings.empty() && input.warnings.empty()) text += "   none\n";
    return text;
}

}  // namespace

std::string setup_sheet(const JobInput& input, std::uint32_t estimated_time_s) {
    return title(input) + block_step(input) + piece_step(input) + tool_step(input, estimated_time_s) +
           margin_step(input) + warning_step(input) + "\nproject " + to_hex(input.project_id) + "\nscan    " +
           to_hex(input.scan_sha256) + "\nqchopper " + input.program_version + "\n";
}

}  // namespace qchopper
