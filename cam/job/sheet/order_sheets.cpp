// A setup sheet is cut out of its document by the marks that sheet_html.h sets. O(bytes of the sheets and pictures).

#include "cam/job/sheet/order_sheets.h"

#include <algorithm>
#include <map>
#include <set>

#include "base/base64.h"
#include "base/text.h"
#include "cam/job/glue_faces.h"
#include "cam/job/sheet/sheet_html.h"
#include "segment/picture/svg.h"

namespace qchopper {
namespace {

using namespace sheet;

// What stands between the marks of a page, or nothing. The marks are part of the format of a job file, which keeps of
// its sheet the document and not all of which that was made.
std::string page_in(const Bytes& html) {
    const std::string text(html.begin(), html.end());
    const std::size_t begin = text.find(page_begin);
    const std::size_t end = text.rfind(page_end);
    if (begin == std::string::npos || end == std::string::npos || end < begin) return {};
    const std::size_t from = begin + std::string(page_begin).size();
    return text.substr(from, end - from);
}

// In place of the names of the pictures the pictures.
std::string with_pictures(std::string html, const std::map<std::string, Bytes>& files) {
    for (const auto& [name, bytes] : files) {
        if (!name.ends_with(".png")) continue;
        const std::string source = "src=\"" + name + "\"";
        const std::size_t at = html.find(source);
        if (at == std::string::npos) continue;
        html.replace(at, source.size(), "src=\"data:image/png;base64," + to_base64(bytes) + "\"");
    }
    return html;
}

std::string tools_word(const std::vector<std::uint16_t>& tools) {
    std::string text;
    for (const std::uint16_t tool : tools) text += (text.empty() ? "" : ", ") + std::to_string(tool);
    return text.empty() ? "-" : text;
}

std::string id_of(std::size_t index) {
    return "sheet-" + std::to_string(index + 1);
}

std::string index_of(std::span<const SheetOfOrder> sheets) {
    Rows rows{{word("piece"), word("job"), word("state"), word("block"), word("stands as"), word("tools"),
               right("time"), right("out of reach, %"), right("foam by hand, cm3"), right("holes by hand")}};
    for (std::size_t i = 0; i < sheets.size(); ++i) {
        const SheetOfOrder& s = sheets[i];
        const std::string part =
            s.part.count > 1 ? ", part " + std::to_string(s.part.number) + " of " + std::to_string(s.part.count) : "";
        rows.push_back({{"<a href=\"#" + id_of(i) + "\">" + svg_text(s.piece + part) + "</a>"},
                        word(s.file),
                        word(s.state),
                        word(s.block_name),
                        word(size_text(s.block) + (s.is_sawn ? ", sawn" : "")),
                        word(tools_word(s.tools)),
                        right(duration(s.time_s)),
                        number(100 * s.unreachable_share, 2),
                        number(s.foam_mm3 / 1000, 1),
                        right(std::to_string(s.holes_by_hand))});
    }
    return table(rows);
}

// Foam and holes belong to the piece and not to its parts.
std::string totals_of(std::span<const SheetOfOrder> sheets) {
    std::uint64_t seconds = 0;
    std::size_t pieces = 0;
    std::size_t holes = 0;
    double foam_mm3 = 0;
    std::map<std::string, std::size_t> blocks;
    std::set<std::uint16_t> tools;
    for (const SheetOfOrder& s : sheets) {
        seconds += s.time_s;
        tools.insert(s.tools.begin(), s.tools.end());
        if (s.part.number > 1) continue;
        ++pieces;
        ++blocks[s.block_name];
        foam_mm3 += s.foam_mm3;
        holes += s.holes_by_hand;
    }
    Rows rows{{word("total"), word("")}};
    rows.push_back({word("pieces with a job"), word(std::to_string(pieces))});
    rows.push_back({word("jobs"), word(std::to_string(sheets.size()))});
    rows.push_back({word("time, without setting up"), word(duration(static_cast<std::uint32_t>(seconds)))});
    for (const auto& [name, count] : blocks) {
        rows.push_back({word("blocks \"" + name + "\""), word(std::to_string(count))});
    }
    rows.push_back({word("tools"), word(tools_word({tools.begin(), tools.end()}))});
    rows.push_back({word("foam to take off by hand"), word(fixed(foam_mm3 / 1000, 1) + " cm3")});
    rows.push_back({word("holes to drill by hand"), word(std::to_string(holes))});
    return table(rows);
}

}  // namespace

SheetOfOrder sheet_of(const ReadJob& job, const std::string& file, const std::string& state) {
    SheetOfOrder sheet;
    sheet.file = file;
    sheet.state = state;
    sheet.piece = job.piece;
    if (job.program) {
        sheet.part = job.program->part;
        std::set<std::uint16_t> tools;
        for (const JobChunk& chunk : job.program->chunks) tools.insert(chunk.tool);
        sheet.tools.assign(tools.begin(), tools.end());
    }
    sheet.block_name = job.block_name;
    sheet.block = job.setup.block.size;
    sheet.is_sawn = job.setup.block.is_sawn;
    sheet.time_s = job.ticket.estimated_time_s;
    sheet.unreachable_share = job.setup.access.unreachable_share();
    if (job.setup.access.method == AccessMethod::mapped) sheet.foam_mm3 = job.setup.access.foam_mm3;
    for (const JobHole& hole : holes_of(job.caps)) sheet.holes_by_hand += hole.by_robot ? 0 : 1;
    sheet.page = with_pictures(page_in(job.files.at("setup.html")), job.files);
    return sheet;
}

std::string order_sheets(const std::string& order, std::span<const SheetOfOrder> sheets,
                         const PiecesWithoutJob& without_job) {
    std::string body = page_begin + ("<h1>" + svg_text("Setup sheets: " + order) + "</h1>\n") + index_of(sheets);
    if (!without_job.others.empty()) body += stop("Without a job: " + list_of_pieces(without_job.others) + ".");
    if (!without_job.only_sawn.empty()) {
        body += paragraph("Sawn only, without a job: " + list_of_pieces(without_job.only_sawn) +
                          ". The saw list, saw-list.html, has them.");
    }
    body += totals_of(sheets) + page_end;
    for (std::size_t i = 0; i < sheets.size(); ++i) {
        if (sheets[i].page.empty()) continue;
        std::string begin = page_begin;
        begin.insert(begin.find('>'), " id=\"" + id_of(i) + "\"");
        body += begin + sheets[i].page + page_end;
    }
    return document("Setup sheets: " + order, body);
}

}  // namespace qchopper
