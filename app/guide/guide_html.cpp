// O(bytes of the pictures).

#include "app/guide/guide_html.h"

#include "base/base64.h"
#include "cam/job/sheet/sheet_html.h"
#include "segment/picture/svg.h"

namespace qchopper {
namespace {

std::string html_of(const GuideText& text) {
    return text.is_warning ? sheet::stop(text.text) : sheet::paragraph(text.text);
}

std::string html_of(const GuideTable& table) {
    sheet::Rows rows;
    for (const std::vector<std::string>& row : table.rows) {
        rows.emplace_back();
        for (std::size_t c = 0; c < row.size(); ++c) {
            rows.back().push_back(table.is_number[c] ? sheet::right(row[c]) : sheet::word(row[c]));
        }
    }
    return sheet::table(rows);
}

// As wide as fits beside the others, and never stretched.
std::string html_of(const GuidePictures& pictures) {
    std::string html = "<div style=\"display:flex;gap:2%\">\n";
    for (const GuidePicture& picture : pictures.pictures) {
        html += "<figure style=\"flex:1\"><img width=\"" + std::to_string(picture.width) + "\" height=\"" +
                std::to_string(picture.height) + "\" alt=\"" + svg_text(picture.caption) +
                "\" src=\"data:image/png;base64," + to_base64(picture.png) + "\"><figcaption>" +
                svg_text(picture.caption) + "</figcaption></figure>\n";
    }
    return html + "</div>\n";
}

}  // namespace

std::string guide_html(const AssemblyGuide& guide) {
    std::string body = sheet::page_begin + ("<h1>" + svg_text(guide.title) + "</h1>\n");
    bool is_first = true;
    for (const GuideSection& section : guide.sections) {
        if (section.begins_page && !is_first) {
            body += sheet::page_end;
            body += sheet::page_begin;
        }
        std::string html;
        for (const GuideBlock& block : section.blocks) {
            html += std::visit([](const auto& one) { return html_of(one); }, block);
        }
        body += is_first ? html : sheet::section(section.title, html);
        is_first = false;
    }
    return sheet::document(guide.title, body + sheet::page_end);
}

}  // namespace qchopper
